// Smooths occlusion along one axis without crossing edges.
in vec2 at;
uniform sampler2D shade_in;
uniform sampler2D guide;
uniform vec2 step_uv;
uniform int wide;
out vec2 shade;
void main() {
    vec4 here = textureLod(guide, at, 0.0);
    if (here.w <= 0.0) { shade = vec2(1.0, 1e6); return; }
    vec2 sum = vec2(0.0);
    for (int i = -wide; i <= wide; i++) {
        vec2 uv = at + float(i) * step_uv;
        vec4 g = textureLod(guide, uv, 0.0);
        float facing = max(dot(g.xyz, here.xyz), 0.0);
        facing *= facing;
        float w = exp(-0.11 * float(i * i)) * max(0.0, 1.0 - abs(g.w - here.w) * 40.0 / here.w) * facing * facing;
        sum += w * vec2(textureLod(shade_in, uv, 0.0).r, 1.0);
    }
    shade = vec2(sum.x / max(sum.y, 1e-4), here.w);
}
