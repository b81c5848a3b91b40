// Draws the surroundings: behind everything (BAKE 0), the upper half of all directions, folded out to a square, for lighting
// (BAKE 1), all directions by longitude and latitude, for other renderers (BAKE 2; LAMP: with what only mirrors show), or behind
// what is around metal, with what only metal shows (BAKE 3).
#include "sky.glsl"
#include "fog.glsl"
in vec2 at;
uniform vec3 eye;
uniform mat4 rays;  // columns: right and up scaled by the lens, forward
out vec4 colour;
void main() {
#if BAKE == 2
    float turn = at.x * TAU, down = (1.0 - at.y) * 0.5 * TAU;
    colour = vec4(sky(vec3(sin(down) * sin(turn), sin(down) * cos(turn), cos(down)), LAMP == 1), 1.0);
#elif BAKE == 1
    vec2 q = at * 2.0 - 1.0, p = vec2(q.x + q.y, q.x - q.y) * 0.5;
    vec3 d = normalize(vec3(p, max(1.0 - abs(p.x) - abs(p.y), 1e-4)));
    colour = vec4(sky(d, true), 1.0);
#else
    vec2 p = at * 2.0 - 1.0;
    vec3 d = normalize(rays[0].xyz * p.x + rays[1].xyz * p.y + rays[2].xyz);
#if BAKE == 3
    colour = vec4(fogged_sky(before_metal(d), eye, d), 1.0);
#else
    colour = vec4(fogged_sky(sky(d, false), eye, d), 1.0);
#endif
#endif
}
