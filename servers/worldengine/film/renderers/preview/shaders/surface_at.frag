// What is seen, by its number, and how far away along the view axis: with these a point is found again in another picture.
flat in int thing;
centroid in vec3 world;
uniform vec3 eye;
uniform vec3 forward;
out vec2 surface;
void main() { surface = vec2(float(thing / 10), dot(world - eye, forward)); }
