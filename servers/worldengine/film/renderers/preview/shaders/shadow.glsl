// Soft shadows: a blocker search gives the width of the penumbra, a filter of that width its shade.
// After Fernando, "Percentage-Closer Soft Shadows" (2005); blocks of the map that are wholly lit or dark are skipped.
uniform sampler2D shadow_depth;
uniform sampler2DShadow shadow_compare;
uniform sampler2D shadow_blocks;
uniform mat4 to_shadow;      // world to (u, v, depth), each in 0..1
uniform vec4 shadow_scale;   // metres per unit of u, metres per unit of depth, tangent of the light's radius, widest radius in u
uniform int blockers, filters;

// The first way in which a pixel looks around itself; `WHIRL` turns it by the golden angle.
const mat2 WHIRL = mat2(-0.7373689, 0.6754903, -0.6754903, -0.7373689);
vec2 first_way(vec2 pixel) {
    float turn_angle = fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715)))) * 6.2831853;
    return vec2(cos(turn_angle), sin(turn_angle));
}

// The share of a light that reaches `s` (u, v, depth) after so many `turns` of search. `depth_here` is its depth with no limit,
// `gradient` the depth of its own plane by u and v, `last` more than any depth but an empty texel's; radii are in u: `per_depth`
// by how far a blocker is before it, the `widest` searched, from `least` to `most`; `start` and `whirl` turn the taps.
float softened(sampler2D depths, sampler2DShadow compare, vec3 s, float depth_here, vec2 gradient, float bias, float last, int turns,
               float per_depth, float widest, float least, float most, vec2 start, mat2 whirl) {
    vec2 way = start;
    float found = 0.0, sum = 0.0;
    for (int i = 0; i < turns; i++) {
        vec2 o = sqrt((float(i) + 0.5) / float(blockers)) * widest * way;
        way = whirl * way;
        float d = textureLod(depths, s.xy + o, 0.0).r;
        float blocks = step(d, min(s.z + dot(gradient, o) - bias, last));
        found += blocks;
        sum += blocks * d;
    }
    turns = found < 0.5 ? 0 : filters;
    float radius = clamp(per_depth * max(depth_here - sum / max(found, 1.0), 0.0), least, most);
    float light_sum = 0.0;
    way = start;
    for (int i = 0; i < turns; i++) {
        vec2 o = sqrt((float(i) + 0.5) / float(filters)) * radius * way;
        way = whirl * way;
        light_sum += texture(compare, vec3(s.xy + o, min(s.z + dot(gradient, o) - bias, last)));
    }
    float share = turns == 0 ? 1.0 : light_sum / float(filters);
    return mix(share, share * share * (3.0 - 2.0 * share), 0.6);
}

// The share of the key light that reaches p.
float lit(vec3 p, vec3 n, vec3 light, vec2 pixel) {
    float texel = 1.0 / float(textureSize(shadow_depth, 0).x);
    float slope = dot(n, light);
    p += n * shadow_scale.x * texel * 1.5;
    vec3 s = (to_shadow * vec4(p, 1.0)).xyz;
    float depth_here = s.z;
    s.z = min(s.z, 0.999);  // receivers may lie beyond the map, whose empty texels hold 1
    // Depth of the receiver's own plane around the point, so that a wide filter does not shade it by itself.
    mat3 turn = mat3(to_shadow);
    vec3 u = vec3(turn[0].x, turn[1].x, turn[2].x), v = vec3(turn[0].y, turn[1].y, turn[2].y), w = vec3(turn[0].z, turn[1].z, turn[2].z);
    vec3 nl = vec3(dot(n, u) * shadow_scale.x, dot(n, v) * shadow_scale.x, dot(n, w) * shadow_scale.y);
    vec2 gradient = clamp(-nl.xy / min(nl.z, -0.12), -6.0, 6.0) * shadow_scale.x / shadow_scale.y;
    float bias = (0.6 + 1.2 * length(gradient) * shadow_scale.y / shadow_scale.x) * texel * shadow_scale.x / shadow_scale.y;
    ivec2 size = textureSize(shadow_blocks, 0);
    vec2 bounds = texelFetch(shadow_blocks, clamp(ivec2(s.xy * vec2(size)), ivec2(0), size - 1), 0).rg;
    bool outside = any(lessThan(s.xy, vec2(0.0))) || any(greaterThan(s.xy, vec2(1.0)));
    bool all_lit = outside || bounds.x >= s.z - bias;
    float per_depth = shadow_scale.z * shadow_scale.y / shadow_scale.x;  // radius in u per unit of depth
    float widest = min(shadow_scale.w, per_depth * max(depth_here - bounds.x, 0.0));
    bool all_dark = !all_lit && bounds.y < s.z - bias - length(gradient) * widest;
    // Drivers that run on processors skip loops, but not branches: a loop of no turns is how they skip work.
    int turns = all_lit || all_dark || slope <= 0.0 ? 0 : blockers;
    float share = softened(shadow_depth, shadow_compare, s, depth_here, gradient, bias, 0.9995, turns,
                           per_depth, widest, 1.2 * texel, shadow_scale.w, first_way(pixel), WHIRL);
    return slope <= 0.0 || all_dark ? 0.0 : share;
}
