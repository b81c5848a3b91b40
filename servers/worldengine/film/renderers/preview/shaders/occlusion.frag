// Ambient occlusion from the depth of the picture: how much of the hemisphere over a point is covered nearby.
// After McGuire et al., "The Alchemy Screen-Space Ambient Obscurance Algorithm" (2011).
in vec2 at;
uniform sampler2D guide;
uniform vec4 lens;       // tangent of half the field of view (x, y), and the picture's size in pixels
uniform mat4 to_view;    // world to view rotation
uniform int taps;
uniform float strength;
uniform float reach;     // radius as a share of the distance
out vec2 shade;

vec3 place(vec2 uv, float depth) { return vec3((uv * 2.0 - 1.0) * lens.xy * depth, -depth); }

void main() {
    vec4 here = textureLod(guide, at, 0.0);
    if (here.w <= 0.0) { shade = vec2(1.0, 1e6); return; }
    vec3 p = place(at, here.w);
    vec3 n = mat3(to_view) * here.xyz;
    float radius = reach * here.w;
    vec2 span = 0.5 * reach / lens.xy;
    ivec2 cell = ivec2(gl_FragCoord.xy) & 3;
    float turn = float((cell.x * 4 + cell.y * 7 + (cell.x ^ cell.y) * 5) & 15) * (6.2831853 / 16.0);
    float sum = 0.0;
    for (int i = 0; i < taps; i++) {
        float share = pow((float(i) + 0.5) / float(taps), 1.5);  // closest where things touch
        float angle = float(i) * 2.39996323 + turn;
        vec2 uv = at + vec2(cos(angle), sin(angle)) * share * span;
        float depth = textureLod(guide, uv, 0.0).w;
        if (depth <= 0.0 || uv != clamp(uv, 0.0, 1.0)) continue;
        vec3 v = place(uv, depth) - p;
        float d2 = dot(v, v), vn = dot(v, n) - 0.0015 * here.w;
        float fall = max(0.0, 1.0 - d2 / (radius * radius));
        sum += fall * fall * max(vn, 0.0) / (sqrt(d2) + 0.004 * radius);
    }
    shade = vec2(max(0.0, 1.0 - strength * sum / float(taps)), here.w);
}
