// The mean of a pixel's places, weighed as they will look on film: else half a dark wire before a bright wall is no darker than the wall.
// After Karis, "Tone mapping" (2013).
uniform sampler2DMS scene;
uniform float exposure;
out vec4 colour;

void main() {
    vec4 sum = vec4(0.0);
    float whole = 0.0;
    for (int i = 0; i < PLACES; i++) {
        vec4 one = texelFetch(scene, ivec2(gl_FragCoord.xy), i);
        float weight = 1.0 / (1.0 + exposure * max(one.r, max(one.g, one.b)));
        sum += weight * one;
        whole += weight;
    }
    colour = sum / whole;
}
