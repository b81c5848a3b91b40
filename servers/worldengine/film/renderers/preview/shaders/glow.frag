// Halves a picture with a soft kernel (13 taps, after Jimenez, "Next Generation Post Processing in Call of Duty" (2014)).
in vec2 at;
uniform sampler2D from;
uniform vec2 texel;
out vec4 colour;
vec3 tap(float x, float y) { return min(textureLod(from, at + texel * vec2(x, y), 0.0).rgb, vec3(12.0)); }
void main() {
    vec3 c = 0.125 * tap(0.0, 0.0) + 0.125 * (tap(-1.0, -1.0) + tap(1.0, -1.0) + tap(-1.0, 1.0) + tap(1.0, 1.0));
    c += 0.0625 * (tap(-2.0, 0.0) + tap(2.0, 0.0) + tap(0.0, -2.0) + tap(0.0, 2.0));
    c += 0.03125 * (tap(-2.0, -2.0) + tap(2.0, -2.0) + tap(-2.0, 2.0) + tap(2.0, 2.0));
    colour = vec4(c, 1.0);
}
