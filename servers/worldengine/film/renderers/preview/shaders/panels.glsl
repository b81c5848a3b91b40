// Panels of light: what a shining rectangle gives to a matt surface, and how a glossy one mirrors it.
uniform vec4 panels[64];  // by fours: the middle, half the width, half the height, the radiance
uniform int panel_count;

// The angle between two unit vectors, about their normal; the arc cosine after Abramowitz and Stegun, 4.4.45.
vec3 edge_of(vec3 a, vec3 b) {
    float x = dot(a, b), y = abs(x);
    float over_sine = (1.5707288 + (-0.2121144 + (0.0742610 - 0.0187293 * y) * y) * y) * inversesqrt(1.0 + y);
    return cross(a, b) * (x > 0.0 ? over_sine : 3.1415927 * inversesqrt(max(1.0 - x * x, 1e-7)) - over_sine);
}

// Light over pi that a surface facing `n` gets of a panel, by the sum over its edges (Lambert, "Photometria", 1760); of what
// lies below the surface's own horizon only a soft part is taken off.
float panel_form(vec3 middle, vec3 u, vec3 w, vec3 n) {
    vec3 a = normalize(middle - u - w), b = normalize(middle + u - w), c = normalize(middle + u + w), d = normalize(middle - u + w);
    return max(dot(edge_of(a, d) + edge_of(d, c) + edge_of(c, b) + edge_of(b, a), n), 0.0) / 6.2831853;
}

// The share of a mirror image of this roughness that a panel fills: `r` is the way that the eye's ray goes on.
float panel_image(vec3 middle, vec3 u, vec3 w, vec3 way, vec3 r, float roughness) {
    float down = dot(r, way), t = dot(middle, way) / min(down, -1e-4);
    vec3 off = r * t - middle;
    float lobe = max(roughness * roughness, 0.004);
    vec2 size = vec2(length(u), length(w));
    vec2 past = abs(vec2(dot(off, u), dot(off, w)) / size) - size;
    float soft = max(t, 0.0) * lobe * 1.6 + 1e-4;
    vec2 inside = 1.0 - smoothstep(-soft, soft, past);
    vec2 fill = min(size / (0.8 * soft), 1.0);
    return down < 0.0 && t > 0.0 ? inside.x * inside.y * fill.x * fill.y : 0.0;
}
