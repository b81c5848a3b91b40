// Depth of field: each pixel is the mean of what its circle of confusion, and those of its neighbours, spread over it.
// Where nothing near by is blurred so far, the loop ends early: the taps beyond would weigh nothing.
in vec2 at;
uniform sampler2D scene;
uniform sampler2D depths;  // near plane over distance
uniform sampler2D blocks;  // farthest and nearest of all that may spread over the pixels of each block
uniform int block;
uniform float near_m;
uniform vec4 lens;         // sharp distance, pixels of blur per share of distance, widest blur in pixels, taps
out vec4 colour;

float metres(float depth) { return near_m / max(depth, 1e-6); }
float metres(ivec2 p) { return metres(texelFetch(depths, p, 0).r); }

float blur(float d) { return clamp(abs(d - lens.x) / d * lens.y, 0.0, lens.z); }

void main() {
    ivec2 p = ivec2(gl_FragCoord.xy), last = textureSize(scene, 0) - 1;
    float own = metres(p), own_blur = blur(own);
    vec3 sum = texelFetch(scene, p, 0).rgb;
    float weight = 1.0, grain = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
    vec2 bounds = texelFetch(blocks, p / block, 0).rg;
    float most = max(blur(metres(bounds.x)), blur(metres(bounds.y))) + 1.52, share = most / max(lens.z, 1e-6);
    int turns = int(min(ceil(lens.w * share * share - 0.5), lens.w));
    for (int i = 0; i < turns; i++) {
        float radius = sqrt((float(i) + 0.5) / lens.w) * lens.z, turn = 2.3999632 * float(i) + 6.2831853 * grain;
        ivec2 q = clamp(p + ivec2(round(radius * vec2(cos(turn), sin(turn)))), ivec2(0), last);
        float other = metres(q), other_blur = blur(other);
        // What lies behind a pixel spreads over it no wider than the pixel itself is blurred.
        float reach = other > own ? min(other_blur, own_blur) : other_blur;
        float w = smoothstep(radius - 1.0, radius + 1.0, reach + 0.5) / (1.0 + 0.02 * reach * reach);
        sum += w * min(texelFetch(scene, q, 0).rgb, vec3(12.0));
        weight += w;
    }
    colour = vec4(sum / weight, 1.0);
}
