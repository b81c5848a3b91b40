// Least and greatest depth of each block of a map of depths, 16 x 16 texels.
uniform sampler2D shadow_depth;
uniform int block;  // a uniform, so that compilers do not unroll the loops
out vec2 bounds;
void main() {
    vec2 texel = 1.0 / vec2(textureSize(shadow_depth, 0));
    ivec2 base = ivec2(gl_FragCoord.xy) * block;
    vec4 low = vec4(1.0), high = vec4(0.0);
    for (int y = 1; y < block; y += 2)
        for (int x = 1; x < block; x += 2) {
            vec4 d = textureGather(shadow_depth, vec2(base + ivec2(x, y)) * texel);  // the four around this corner
            low = min(low, d);
            high = max(high, d);
        }
    low.xy = min(low.xy, low.zw);
    high.xy = max(high.xy, high.zw);
    bounds = vec2(min(low.x, low.y), max(high.x, high.y));
}
