// How paint lies on a thing: along its sides (PAINT 1), around its centre (2), by the mesh's own coordinates (3), or not at
// all (0). Variants are compiled apart, since processors that emulate graphics run both sides of every branch.
#if PAINT == 2
uniform samplerCube paint;
#elif PAINT
uniform sampler2D paint;
#endif

struct Paint { vec4 value; vec3 slope; };  // colour and height; how much the relief tilts the normal, local frame

#if PAINT == 1
vec3 permute(vec3 v, int axis) { return axis == 3 ? v.yzx : axis == 4 ? v.zxy : v; }
vec3 unpermute(vec3 v, int axis) { return axis == 3 ? v.zxy : axis == 4 ? v.yzx : v; }

Paint paint_sides(vec3 p, vec3 n, int mode, float per_metre, float relief, float seed) {
    vec3 q = permute(p, mode), m = permute(n, mode);
    vec3 dx = dFdx(q) * per_metre, dy = dFdy(q) * per_metre;
    q = q * per_metre + seed * vec3(0.31, 0.57, 0.83);
    vec3 a = abs(m);
    int major = a.x > a.y && a.x > a.z ? 0 : a.y > a.z ? 1 : 2;
    Paint result = Paint(vec4(0.0), vec3(0.0));
    vec2 t = major == 0 ? q.yz : major == 1 ? q.xz : q.xy;
    vec2 gx = major == 0 ? dx.yz : major == 1 ? dx.xz : dx.xy, gy = major == 0 ? dy.yz : major == 1 ? dy.xz : dy.xy;
    float level = log2(max(max(dot(gx, gx), dot(gy, gy)), 1e-12)) * 0.5 + log2(float(textureSize(paint, 0).x)) - 0.5;
    // Stretched footprints keep some sharpness along the short axis.
    float least = log2(max(min(dot(gx, gx), dot(gy, gy)), 1e-12)) * 0.5 + log2(float(textureSize(paint, 0).x)) - 0.5;
    level = max(mix(level, least, 0.35), 0.0);
#if CURVED
    vec3 w = a * a;
    w *= w;
    w *= w;
    w /= w.x + w.y + w.z;
    result.value = w.x * textureLod(paint, q.yz, level) + w.y * textureLod(paint, q.xz, level) + w.z * textureLod(paint, q.xy, level);
#else
    result.value = textureLod(paint, t, level);
#endif
#if VARY == 2
    // A second, turned copy hides the repetition of natural ground.
    mat2 turn = mat2(0.81, -0.59, 0.59, 0.81) * 0.43;
    vec4 other = textureLod(paint, turn * t + 0.31, max(level - 1.2, 0.0));
    float blend = smoothstep(0.35, 0.65, textureLod(noise_map, t * 0.061, 0.0).r);
    result.value = mix(result.value, other, blend * 0.75);
    // Far away only the repetition would be left of the pattern: there its mean stands for it.
    result.value = mix(result.value, textureLod(paint, t, 20.0), 0.85 * smoothstep(1.5, 4.5, level));
#endif
#if RELIEF
    float reach = exp2(level) / float(textureSize(paint, 0).x);
    float fade = clamp(1.4 - 28.0 * reach, 0.0, 1.0);
    float here = textureLod(paint, t, level).a;
    vec2 s = vec2(textureLod(paint, t + vec2(reach, 0.0), level).a, textureLod(paint, t + vec2(0.0, reach), level).a) - here;
    s *= relief * per_metre / reach * fade;
    vec3 tilt = major == 0 ? vec3(0.0, s) : major == 1 ? vec3(s.x, 0.0, s.y) : vec3(s, 0.0);
    result.slope = unpermute(tilt, mode);
#endif
    return result;
}
#endif

#if PAINT == 2
Paint paint_ball(vec3 p, float relief, float radius) {
    vec3 d = normalize(p);
    float span = max(length(dFdx(d)), length(dFdy(d)));
    float level = max(log2(max(span, 1e-6) * float(textureSize(paint, 0).x) * 0.6), 0.0);
    Paint result;
    result.value = textureLod(paint, d, level);
    result.slope = vec3(0.0);
#if RELIEF
    float reach = max(0.006, 0.7 * span);
    float fade = clamp(1.4 - 22.0 * reach, 0.0, 1.0);
    vec3 t = normalize(cross(d, abs(d.z) < 0.9 ? vec3(0.0, 0.0, 1.0) : vec3(1.0, 0.0, 0.0)));
    vec3 b = cross(d, t);
    float h = result.value.a;
    float ht = textureLod(paint, d + reach * t, level).a, hb = textureLod(paint, d + reach * b, level).a;
    result.slope = (t * (ht - h) + b * (hb - h)) * (relief / (reach * radius)) * fade;
#endif
    return result;
}
#endif
