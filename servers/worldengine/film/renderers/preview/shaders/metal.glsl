// What bare metal mirrors: the standing world in a cube around it, and before that the simple shapes that move beside it.
uniform samplerCube cube;   // light, and the distance from `cube_place`, m
uniform vec3 cube_place;
uniform vec4 beside[10];    // mean colour, and row
uniform int beside_count, searches;
uniform samplerBuffer things;
const float CUBE_TEXEL = 0.0123;  // radians

// Where a ray meets a moving shape before `t`: the distance, and the normal there in `out_normal`.
float meets(int row, vec3 p, vec3 d, float t, inout vec3 out_normal) {
    vec4 a = texelFetch(things, row * 10), b = texelFetch(things, row * 10 + 1), c = texelFetch(things, row * 10 + 2);
    vec3 s = abs(texelFetch(things, row * 10 + 3).xyz);
    float kind = texelFetch(things, row * 10 + 9).w;
    mat3 turn = mat3(a.xyz, b.xyz, c.xyz);  // of the world into the thing's own frame
    vec3 o = turn * (p - vec3(a.w, b.w, c.w)), w = turn * d, m;
    float found = 1e9;
    if (kind < 1.5) {
        vec3 q = o / s, u = w / s;
        float uu = dot(u, u), h = dot(q, u), root = h * h - uu * (dot(q, q) - 1.0);
        found = root > 0.0 ? (-h - sqrt(root)) / uu : 1e9;
        m = (o + w * found) / (s * s);
    } else {
        vec3 inverse = 1.0 / (w + vec3(1e-7)), one = (-s - o) * inverse, two = (s - o) * inverse;
        vec3 into = min(one, two), beyond = max(one, two);
        float enter = max(into.x, max(into.y, into.z)), leave = min(beyond.x, min(beyond.y, beyond.z));
        m = enter == into.x ? vec3(1, 0, 0) : enter == into.y ? vec3(0, 1, 0) : vec3(0, 0, 1);
        m *= -sign(w);
        if (kind > 2.5) {
            float ww = max(dot(w.xy, w.xy), 1e-9), h = dot(o.xy, w.xy), root = h * h - ww * (dot(o.xy, o.xy) - s.x * s.x);
            float wall = root > 0.0 ? (-h - sqrt(root)) / ww : 1e9, exits = root > 0.0 ? (-h + sqrt(root)) / ww : -1e9;
            m = wall > into.z ? vec3(o.xy + w.xy * wall, 0.0) : vec3(0.0, 0.0, -sign(w.z));
            enter = max(wall, into.z);
            leave = min(exits, beyond.z);
        }
        found = enter < leave ? enter : 1e9;
    }
    if (found < 1e-4 || found > t) return t;
    out_normal = normalize(m * turn);
    return found;
}

// Whether the key light reaches a point, by one look: what is mirrored is small.
float lit_at_once(vec3 p, vec3 n) {
    p += n * shadow_scale.x * 2.0 / float(textureSize(shadow_depth, 0).x);
    vec3 s = (to_shadow * vec4(p, 1.0)).xyz;
    bool outside = any(lessThan(s.xy, vec2(0.0))) || any(greaterThan(s.xy, vec2(1.0)));
    return outside ? 1.0 : texture(shadow_compare, vec3(s.xy, min(s.z, 0.999) - 0.0015 * shadow_scale.x / shadow_scale.y));
}

// Of the standing world along a ray: the cube, as it looks from here and not from its middle.
vec3 standing(vec3 p, vec3 d, float level, out float t) {
    vec3 from = p - cube_place;
    t = textureLod(cube, d, 1.0).a;
    for (int i = 0; i < 3; i++) {
        vec3 q = from + d * t;
        t = max(t + 0.8 * (textureLod(cube, q, 0.0).a - length(q)), 1e-3);
    }
    float low = (p.z - mirror_z) / max(-d.z, 1e-4);  // a level ground is found exactly
    vec3 q = from + d * low;
    if (d.z < 0.0 && abs(textureLod(cube, q, 0.0).a / length(q) - 1.0) < 0.08) t = low;
    return textureLod(cube, from + d * t, level).rgb;
}

vec3 metal_mirror(vec3 p, vec3 d, float roughness, float range, float own) {
    float wide = max(138.0 * roughness * roughness, 1.0);
    vec3 dx = dFdx(d), dy = dFdy(d);
    float level = max(log2(wide) - 1.4, 0.5 * log2(max(dot(dx, dx), dot(dy, dy)) / (CUBE_TEXEL * CUBE_TEXEL) + 1e-9) - 0.7);
    float t;
    vec3 c = standing(p, d, max(level, 0.0), t);
    vec3 n = vec3(0.0, 0.0, 1.0);
    // A shadow of what moves lies on the ground that the cube shows without.
    float level_key = max(key_direction.z, 0.0) * dot(key_colour, vec3(0.333));
    float all = dot(ground_light, vec3(0.333)) + 1e-4;
    vec3 place = p + d * t;
    if (d.z < 0.0 && abs(place.z - mirror_z) < 0.02 * t + 1e-3) {
        float shadowed = smoothstep(0.25, 0.55, dot(c, vec3(0.333)) / (all * max(dot(ground_mean, vec3(0.333)), 0.02)));
        c *= mix(1.0, mix(1.0 - level_key / all, 1.0, lit_at_once(place, n)), shadowed);
    }
    float nearest = t;
    int met = -1;
    for (int i = 0; i < beside_count; i++) {
        int row = int(beside[i].w + 0.5);
        if (abs(texelFetch(things, row * 10 + 7).x - own) < 0.5) continue;
        float before = nearest;
        nearest = meets(row, p, d, nearest, n);
        met = nearest < before ? i : met;
    }
    if (met >= 0) {
        vec3 there = p + d * nearest;
        vec4 traits = texelFetch(things, int(beside[met].w + 0.5) * 10 + 5);
        float facing = dot(n, key_direction), down = 0.5 - 0.5 * n.z;
        vec3 tint = beside[met].rgb;
        vec3 light = irradiance(n) + 0.85 * ground_mean * ground_light * down * down;
        if (facing > 0.0) light += key_colour * facing * lit_at_once(there, n);
        vec3 again = reflect(d, n);
        vec3 image = textureLod(cube, again, 1.0 + 4.0 * traits.x).rgb;
        float close = clamp((there.z - mirror_z) / max(0.35 * range, 1e-4), 0.25, 1.0);  // dark where it stands
        vec3 gloss = mix(vec3(0.04), tint, traits.y) + (1.0 - tint * traits.y) * 0.5 * fifth(1.0 - max(dot(again, n), 0.0)) * (1.0 - traits.x);
        vec3 seen = tint * (1.0 - traits.y) * light * close + image * gloss;
        c = mix(seen, c, smoothstep(0.35, 0.6, roughness));
    }
    return c;
}
