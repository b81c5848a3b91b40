// The number of the geom, for segmentation.
flat in int thing;
uniform samplerBuffer things;
out int number;
void main() { number = int(texelFetch(things, thing + 7).x); }
