// Smooths stair-steps along edges of brightness, then dithers against banding.
// After Lottes, "FXAA" (2009): blends each pixel along the direction across which brightness changes most.
in vec2 at;
uniform sampler2D picture;  // display colours, brightness in the fourth channel
uniform vec2 texel;
out vec4 colour;

float bright(ivec2 p, ivec2 last) { return texelFetch(picture, clamp(p, ivec2(0), last), 0).a; }

void main() {
    ivec2 p = ivec2(gl_FragCoord.xy), last = textureSize(picture, 0) - 1;
    vec4 m = texelFetch(picture, p, 0);
    float nw = bright(p + ivec2(-1, 1), last), ne = bright(p + ivec2(1, 1), last);
    float sw = bright(p + ivec2(-1, -1), last), se = bright(p + ivec2(1, -1), last);
    float low = min(m.a, min(min(nw, ne), min(sw, se))), high = max(m.a, max(max(nw, ne), max(sw, se)));
    vec3 c = m.rgb;
    // Few pixels lie at an edge; drivers that run on processors skip loops, but not branches.
    int turns = high - low >= max(0.035, 0.10 * high) ? 1 : 0;
    for (int i = 0; i < turns; i++) {
        vec2 way = vec2(-((nw + ne) - (sw + se)), (nw + sw) - (ne + se));
        float damp = max((nw + ne + sw + se) * 0.03, 1.0 / 256.0);
        way = clamp(way / (min(abs(way.x), abs(way.y)) + damp), -7.0, 7.0) * texel;
        vec3 a = 0.5 * (textureLod(picture, at - way / 6.0, 0.0).rgb + textureLod(picture, at + way / 6.0, 0.0).rgb);
        vec3 b = 0.5 * a + 0.25 * (textureLod(picture, at - 0.5 * way, 0.0).rgb + textureLod(picture, at + 0.5 * way, 0.0).rgb);
        float level = dot(b, vec3(0.299, 0.587, 0.114));
        c = level < low || level > high ? a : b;
    }
    float grain = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
    colour = vec4(c + (grain - 0.5) / 255.0, 1.0);
}
