// The surroundings of each setting, as radiance along a direction. `lamp` adds what only reflections should see.
uniform sampler2D noise_map;
uniform vec3 key_direction;
uniform vec3 key_colour;
uniform vec3 room_low;
uniform vec3 room_high;

const float TAU = 6.2831853;

float cloud(vec2 p) {
    return 0.5 * textureLod(noise_map, p, 0.0).r + 0.25 * textureLod(noise_map, p * 2.13 + 0.37, 0.0).r
        + 0.15 * textureLod(noise_map, p * 4.31 + 0.71, 0.0).r + 0.10 * textureLod(noise_map, p * 8.7 + 0.13, 0.0).r;
}

float panel(vec3 d, vec3 centre, vec2 extent, float soft) {
    vec3 across = normalize(cross(centre, vec3(0.0, 0.0, 1.0)));
    vec3 up = cross(across, centre);
    float f = dot(d, centre);
    if (f <= 0.0) return 0.0;
    vec2 q = abs(vec2(dot(d, across), dot(d, up)) / f) - extent;
    float outside = length(max(q, 0.0)) + min(max(q.x, q.y), 0.0);
    return 1.0 - smoothstep(-soft, soft, outside);
}

vec3 studio(vec3 d, bool lamp) {
    float h = max(d.z, 0.0);
    vec3 c = mix(vec3(0.44, 0.425, 0.41), vec3(0.13, 0.135, 0.15), smoothstep(0.0, 0.55, h));
    c *= 0.88 + 0.12 * cos(atan(d.y, d.x) - 1.3);
    if (lamp) {
        c = c * 0.9 + vec3(0.30, 0.30, 0.31);
        c += vec3(6.5, 6.2, 5.8) * panel(d, key_direction, vec2(0.42, 0.30), 0.03);
        c += vec3(2.1, 2.2, 2.4) * panel(d, normalize(vec3(0.80, -0.10, 0.40)), vec2(0.16, 0.60), 0.04);
        c += vec3(2.4, 2.3, 2.2) * panel(d, normalize(vec3(-0.45, 0.80, 0.55)), vec2(0.75, 0.14), 0.04);
    }
    return c;
}

float ridge(float azimuth, float seed) {
    vec2 p = vec2(azimuth / TAU, seed);
    return 0.55 * textureLod(noise_map, p, 0.0).r + 0.28 * textureLod(noise_map, p * vec2(3.0, 1.7), 0.0).r
        + 0.12 * textureLod(noise_map, p * vec2(9.0, 2.3), 0.0).r + 0.05 * textureLod(noise_map, p * vec2(31.0, 3.1), 0.0).r;
}

vec3 outdoor(vec3 d, bool lamp) {
    float h = d.z;
    vec3 zenith = vec3(0.12, 0.29, 0.70), middle = vec3(0.28, 0.52, 0.90), low = vec3(0.55, 0.73, 0.96);
    float up = max(h, 0.0);
    vec3 c = mix(low, middle, smoothstep(0.0, 0.20, up));
    c = mix(c, zenith, smoothstep(0.18, 0.95, up));
    float toward = max(dot(d, key_direction), 0.0);
    c += key_colour * (0.10 * pow(toward, 6.0) + 0.22 * pow(toward, 48.0)) * (1.0 - 0.5 * up);
    if (up > 0.0) {
        vec2 p = d.xy / (up + 0.22);
        float body = cloud(p * 0.085 + 0.21);
        float cover = smoothstep(0.47, 0.66, body) * smoothstep(0.01, 0.16, up);
        float thick = smoothstep(0.52, 0.80, cloud(p * 0.085 + 0.21 + key_direction.xy * 0.012));
        vec3 white = mix(vec3(1.12, 1.09, 1.05), vec3(0.70, 0.75, 0.83), 0.75 * thick);
        c = mix(c, white, 0.86 * cover);
    }
    float azimuth = atan(d.y, d.x);
    float far = 0.016 + 0.060 * ridge(azimuth, 0.21), near = 0.008 + 0.030 * ridge(azimuth + 1.0, 0.63);
    vec3 haze = vec3(0.60, 0.72, 0.86);
    float edge = lamp ? 0.02 : 0.0012;
    c = mix(c, mix(haze, vec3(0.22, 0.34, 0.46), 0.62), 1.0 - smoothstep(far - edge, far + edge, h));
    float leaf = textureLod(noise_map, vec2(azimuth * 9.0, h * 26.0), 0.0).r;
    vec3 trees = mix(vec3(0.10, 0.17, 0.085), vec3(0.20, 0.28, 0.12), leaf);
    c = mix(c, mix(haze, trees, 0.80), 1.0 - smoothstep(near - edge, near + edge, h));
    c = mix(c, vec3(0.36, 0.44, 0.30), 1.0 - smoothstep(-0.02, 0.0, h));
    return c;
}

vec3 room(vec3 d, bool lamp) {
    vec3 wall = vec3(0.62, 0.60, 0.565);
    vec3 c = mix(wall, vec3(0.80, 0.79, 0.77), smoothstep(0.5, 0.75, d.z));
    if (lamp) {
        // The wall with the window is the darkest, the one across from it the brightest.
        float across_room = dot(normalize(d.xy + 1e-5), normalize(key_direction.xy));
        c *= 0.74 - 0.42 * across_room * (1.0 - smoothstep(0.5, 0.9, d.z));
        c *= mix(0.62, 1.0, smoothstep(0.02, 0.10, d.z));
        vec3 window = normalize(vec3(key_direction.xy, 0.42));
        float pane = panel(d, window, vec2(0.46, 0.40), 0.012);
        vec3 across = normalize(cross(window, vec3(0.0, 0.0, 1.0)));
        vec2 q = vec2(dot(d, across), dot(d, cross(across, window))) / max(dot(d, window), 0.1);
        pane *= smoothstep(0.018, 0.03, abs(q.x)) * smoothstep(0.018, 0.03, abs(q.y - 0.05));
        c += vec3(5.2, 5.6, 6.2) * pane;
    }
    return c;
}

float random(vec3 p) { return fract(sin(dot(p, vec3(12.9898, 78.233, 37.719))) * 43758.5453); }

vec3 night(vec3 d, bool lamp) {
    vec3 c = mix(vec3(0.040, 0.048, 0.075), vec3(0.009, 0.012, 0.026), smoothstep(0.0, 0.6, d.z));
    float band = exp(-pow(dot(d, normalize(vec3(0.45, 0.30, -0.62))) * 3.2, 2.0));
    c += band * vec3(0.030, 0.031, 0.044) * (0.35 + 1.3 * cloud(d.xy * 0.23 + d.z * 0.31));
    if (lamp) {
        c += vec3(3.6, 3.9, 4.4) * panel(d, key_direction, vec2(0.26, 0.26), 0.03);
        c += vec3(1.6, 1.1, 0.7) * panel(d, normalize(vec3(-0.3, 0.85, 0.42)), vec2(0.6, 0.10), 0.04);
        return c;
    }
    vec3 grid = d * 150.0, cell = floor(grid);
    float chance = random(cell);
    if (chance > 0.9925 - 0.008 * band) {
        vec3 centre = cell + 0.3 + 0.4 * vec3(random(cell + 1.7), random(cell + 2.9), random(cell + 4.3));
        float spot = 1.0 - smoothstep(0.0, 0.22, length(cross(d, centre - grid)));
        vec3 tint = mix(vec3(1.0, 0.82, 0.66), vec3(0.72, 0.84, 1.0), random(cell + 5.1));
        c += spot * tint * (0.25 + 1.6 * pow(random(cell + 6.7), 6.0)) * smoothstep(0.0, 0.12, d.z);
    }
    return c;
}

uniform vec3 sky_zenith;
uniform vec3 sky_horizon;
uniform vec3 sky_ground;
uniform vec4 sky_traits;  // glow, clouds, stars, cosine of half the light's width

// What a film's author paints: two colours, a glow, clouds and stars.
vec3 told(vec3 d, bool lamp) {
    float up = max(d.z, 0.0);
    vec3 c = mix(sky_horizon, sky_zenith, (1.0 - exp(-3.4 * up)) / (1.0 - exp(-3.4)));
    float toward = max(dot(d, key_direction), 0.0);
    c += key_colour * sky_traits.x * (0.10 * pow(toward, 5.0) + 0.20 * pow(toward, 40.0) + 0.5 * pow(toward, 400.0));
    if (sky_traits.z > 0.0 && !lamp) {
        vec3 grid = d * 150.0, cell = floor(grid);
        float chance = random(cell);
        if (chance > 0.992) {
            vec3 centre = cell + 0.3 + 0.4 * vec3(random(cell + 1.7), random(cell + 2.9), random(cell + 4.3));
            float spot = 1.0 - smoothstep(0.0, 0.22, length(cross(d, centre - grid)));
            vec3 tint = mix(vec3(1.0, 0.82, 0.66), vec3(0.72, 0.84, 1.0), random(cell + 5.1));
            c += sky_traits.z * spot * tint * (0.25 + 1.6 * pow(random(cell + 6.7), 6.0)) * smoothstep(0.0, 0.12, d.z);
        }
    }
    if (sky_traits.y > 0.0 && up > 0.0) {
        vec2 p = d.xy / (up + 0.22);
        float body = cloud(p * 0.085 + 0.21), most = mix(0.70, 0.36, sky_traits.y);
        float cover = smoothstep(most, most + 0.18, body) * smoothstep(0.01, 0.16, up);
        float thick = smoothstep(most + 0.05, most + 0.32, cloud(p * 0.085 + 0.21 + key_direction.xy * 0.012));
        vec3 bright = 0.55 * sky_horizon + key_colour * (0.13 + 0.10 * pow(toward, 4.0));
        c = mix(c, mix(bright, 0.62 * (0.6 * sky_horizon + 0.4 * sky_zenith), 0.75 * thick), 0.86 * cover);
    }
    // The light itself, where it is small enough to be a sun.
    if (!lamp && sky_traits.w > 0.9986) c += key_colour * 6.0 * smoothstep(0.0, 1.0 - sky_traits.w, toward - sky_traits.w);
    return mix(c, sky_ground, 1.0 - smoothstep(-0.02, 0.0, d.z));
}

vec3 sky(vec3 d, bool lamp) {
#if SETTING == 0
    return studio(d, lamp);
#elif SETTING == 1
    return room(d, lamp);
#elif SETTING == 2
    return outdoor(d, lamp);
#elif SETTING == 4
    return told(d, lamp);
#else
    return night(d, lamp);
#endif
}

uniform float sky_indoors;

// What metal shows of the surroundings. A plain grey would make pearl of it: indoors a photographer's dark room is around it, with
// a window toward the light and a strip across from it.
vec3 before_metal(vec3 d) {
    vec3 c = sky(d, true);
#if SETTING == 4
    if (sky_indoors > 0.0) {
        vec3 plain = c;
        float bright = dot(c, vec3(0.333));
        c *= mix(0.42, 0.85, smoothstep(0.35, 0.95, d.z)) * mix(0.55, 1.0, smoothstep(0.0, 0.22, abs(d.z)));
        vec3 window = normalize(vec3(normalize(key_direction.xy + 1e-5), 0.55));
        float pane = panel(d, window, vec2(0.40, 0.34), 0.012);
        vec3 across = normalize(cross(window, vec3(0.0, 0.0, 1.0)));
        vec2 q = vec2(dot(d, across), dot(d, cross(across, window))) / max(dot(d, window), 0.1);
        pane *= smoothstep(0.016, 0.03, abs(q.x)) * smoothstep(0.016, 0.03, abs(q.y));
        c += (0.9 * key_colour + 1.2 * bright) * pane;
        vec3 aside = normalize(vec3(normalize(vec2(-key_direction.y, key_direction.x) + 1e-5), 0.30));
        c += 1.5 * bright * panel(d, aside, vec2(0.10, 0.55), 0.03);
        c = mix(plain, c, sky_indoors);
    }
#endif
    return c;
}
