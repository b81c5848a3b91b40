// From scene light to a picture: bloom, exposure, vignette, film curve. The brightness for edge smoothing goes with it.
in vec2 at;
uniform sampler2D scene;
uniform sampler2D glow;
uniform sampler2D curve;  // film curve and display encoding over the fourth root of scene light
uniform float exposure;
uniform float vignette;
uniform vec3 gains;       // white balance
uniform float glow_share;
uniform vec4 grading;     // contrast, saturation, brightness after all
out vec4 colour;

float film(float x) {
    int last = textureSize(curve, 0).x - 1;
    return texelFetch(curve, ivec2(min(int(sqrt(sqrt(x * (1.0 / 16.0))) * float(last) + 0.5), last), 0), 0).r;
}

#if ROUND
// A cubic B-spline of the glow, by four taps between texels: its few texels would show as squares around a lamp.
vec3 glowing() {
    vec2 size = vec2(textureSize(glow, 0)), p = at * size - 0.5, f = fract(p), g = 1.0 - f;
    vec2 low = (g * g * g + 4.0 + 3.0 * f * f * (f - 2.0)) / 6.0, high = 1.0 - low;
    vec2 a = (4.0 + 3.0 * f * f * (f - 2.0)) / 6.0 / low - 0.5, b = f * f * f / 6.0 / high + 1.5;
    a = (p - f + a) / size;
    b = (p - f + b) / size;
    return (textureLod(glow, a, 0.0).rgb * low.x + textureLod(glow, vec2(b.x, a.y), 0.0).rgb * high.x) * low.y
        + (textureLod(glow, vec2(a.x, b.y), 0.0).rgb * low.x + textureLod(glow, b, 0.0).rgb * high.x) * high.y;
}
#else
vec3 glowing() { return textureLod(glow, at, 0.0).rgb; }
#endif

void main() {
    vec3 c = mix(texelFetch(scene, ivec2(gl_FragCoord.xy), 0).rgb, glowing(), glow_share) * gains;
    vec2 q = (at - 0.5) * vec2(1.0, 0.85);
    c *= exposure * (1.0 - vignette * smoothstep(0.05, 0.62, dot(q, q) * 1.9));
    // Strong light loses some of its colour, as on film.
    float grey = dot(c, vec3(0.25, 0.6, 0.15));
    c = mix(c, vec3(grey), 0.35 * smoothstep(1.0, 9.0, max(c.r, max(c.g, c.b))));
    c = max(mix(vec3(grey), c, 1.07), 0.0);
    c = vec3(film(c.r), film(c.g), film(c.b));
    c = clamp((c - 0.42) * grading.x + 0.42, 0.0, 1.0);
    c = clamp(mix(vec3(dot(c, vec3(0.2126, 0.7152, 0.0722))), c, grading.y), 0.0, 1.0) * grading.z;
    colour = vec4(c, dot(c, vec3(0.299, 0.587, 0.114)));
}
