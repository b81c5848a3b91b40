// Nearest and farthest depth of each 16 x 16 block of the shadow map.
uniform sampler2D shadow_depth;
uniform int block;  // a uniform, so that compilers do not unroll the loops
out vec2 bounds;
void main() {
    ivec2 base = ivec2(gl_FragCoord.xy) * block;
    float low = 1.0, high = 0.0;
    for (int y = 0; y < block; y++)
        for (int x = 0; x < block; x++) {
            float d = texelFetch(shadow_depth, base + ivec2(x, y), 0).r;
            low = min(low, d);
            high = max(high, d);
        }
    bounds = vec2(low, high);
}
