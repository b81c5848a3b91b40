// Air that hides what is far, denser near the ground; it glows around the light.
uniform vec4 fog;         // colour, and the share hidden per metre at the ground
uniform float fog_height; // metres in which it thins to 1/e
uniform float fog_over;   // how high it lies before the open sky, m
uniform float fog_floor;

vec3 fog_colour(vec3 d) { return fog.rgb + key_colour * 0.10 * pow(max(dot(d, key_direction), 0.0), 10.0); }

vec3 fogged(vec3 c, vec3 from, vec3 to) {
    vec3 way = to - from;
    float x = way.z / fog_height, range = length(way);
    float mean = abs(x) < 1e-3 ? 1.0 : (1.0 - exp(-x)) / x;
    float share = 1.0 - exp(-fog.a * range * exp(-max(from.z - fog_floor, 0.0) / fog_height) * mean);
    return mix(c, fog_colour(way / max(range, 1e-6)), share);
}

vec3 fogged_sky(vec3 c, vec3 from, vec3 d) {
    float high = fog_over;
    float through = exp(-max(from.z - fog_floor, 0.0) / high) * high / max(d.z, 0.002);
    return mix(c, fog_colour(d), 1.0 - exp(-fog.a * through));
}
