// Bounds of the blocks within `reach` of each block: what a soft shadow, or a blurred pixel, there can depend on.
uniform sampler2D blocks;
uniform int reach;
out vec2 bounds;
void main() {
    ivec2 at = ivec2(gl_FragCoord.xy), last = textureSize(blocks, 0) - 1;
    vec2 b = vec2(1.0, 0.0);
    for (int y = -reach; y <= reach; y++)
        for (int x = -reach; x <= reach; x++) {
            vec2 v = texelFetch(blocks, clamp(at + ivec2(x, y), ivec2(0), last), 0).rg;
            b = vec2(min(b.x, v.x), max(b.y, v.y));
        }
    bounds = b;
}
