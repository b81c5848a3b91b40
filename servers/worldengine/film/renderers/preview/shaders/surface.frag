// Light on a surface: one key light with a soft shadow, fill lights, the surroundings (diffuse and mirrored), the bounce
// from whatever the thing stands over, and what the material makes of them.
#include "sky.glsl"
#include "fog.glsl"
#include "texture.glsl"
#include "shadow.glsl"
#if LAMPS
#include "lamps.glsl"
#endif
#if GOBO
uniform sampler2D gobo;    // the share of the key light that goes through
uniform mat4 to_gobo;      // world to the slide, -1 to 1 across it
#endif
#if PANELS
#include "panels.glsl"
#endif

flat in vec4 row0, row1, row2;  // pose
flat in vec4 size;     // of the shape
flat in vec4 base;     // colour
flat in vec4 finish;   // roughness, metallic, coat, sheen
flat in vec4 weave;    // repeats per metre, relief, mode, seed
flat in vec4 misc;     // number, emission, rank, bevel
flat in vec4 support;  // colour and height of what lies below
flat in vec4 more;     // vary, clear, distance to the edge of what lies below
centroid in vec3 world;
centroid in vec3 local;
centroid in vec3 local_normal;
centroid in vec2 uv;
centroid in float within;       // m: how thick it is here, where a corner tells it
#if COLOURED
centroid in vec3 own_colour;
#endif
out vec4 colour;

uniform sampler2D around;        // the surroundings; coarser levels for rougher surfaces
uniform sampler2D shade;         // ambient occlusion and distance, at lower resolution
uniform sampler2D behind;        // the picture so far: behind glass, and around mirrors
uniform sampler2D guide;         // normal of what is seen, at lower resolution
uniform sampler2D behind_depth;  // depth that goes with `behind`
uniform float near_m;
uniform vec4 pool;               // centre x and y, start and end radius of the key light's pool on the floor
uniform sampler2D reflection;    // the world mirrored at the ground
uniform int march;
uniform float stride;
uniform vec3 eye;
uniform vec3 forward;
uniform vec2 pixels;
#if CLEAR
uniform vec3 absorbs;            // what light loses in what is clear, 1/m; nil: it is tinted instead
#endif
uniform vec3 harmonics[9];       // irradiance of the upper surroundings over pi
uniform vec3 ground_mean;        // mean colour of the ground
uniform vec3 ground_light;       // light that falls on level ground, over pi
uniform float key_sharp;         // 0 where the surroundings show the key light themselves
uniform float key_spread;
uniform vec4 lights[24];         // pairs: direction or place with kind (0 distant, 1 near), then colour and cutoff cosine
uniform vec3 light_aims[12];
uniform int light_count;
uniform vec4 fade;               // centre x and y, start and end radius of the ground's melting into the surroundings
uniform float haze_m;
uniform float mirror_z;
uniform mat4 to_clip;

vec3 irradiance(vec3 n) {
    vec3 e = harmonics[0] + harmonics[1] * n.y + harmonics[2] * n.z + harmonics[3] * n.x + harmonics[4] * n.x * n.y
        + harmonics[5] * n.y * n.z + harmonics[6] * (3.0 * n.z * n.z - 1.0) + harmonics[7] * n.x * n.z
        + harmonics[8] * (n.x * n.x - n.y * n.y);
    return max(e, 0.0);
}

// The upper half of all directions, folded out to a square.
vec3 surroundings(vec3 d, float roughness) {
    vec2 p = d.xy / (abs(d.x) + abs(d.y) + d.z);
    return textureLod(around, vec2(p.x + p.y, p.x - p.y) * 0.5 + 0.5, sqrt(roughness) * 6.0).rgb;
}

// The surroundings above, and below what the thing stands over (the ground beyond its edge), darker where the thing itself
// is in the way.
vec3 mirrored_light(vec3 d, float roughness, vec4 support, vec3 p, float size) {
    float t = max(p.z - support.w, 0.0) / max(-d.z, 0.02);
    float open = mix(0.25, 1.0, smoothstep(0.0, 2.5 * size, t));
    float down = 1.0 - smoothstep(-0.10 - 0.5 * roughness, 0.10 + 0.5 * roughness, d.z);
    vec3 below = mix(support.rgb, ground_mean, smoothstep(0.7, 1.3, t * length(d.xy) / more.z));
    return mix(surroundings(normalize(vec3(d.xy, max(d.z, 0.0))), roughness), below * ground_light * open, down);
}

#if MIRROR || CLEAR

float distance_at(vec2 q) { return near_m / max(textureLod(behind_depth, q, 0.0).r, 1e-7); }

// What a mirror shows of the picture itself: the nearest thing that the ray passes behind, or else the place where it meets
// the surface below. Alpha says how far that can be trusted; a picture knows nothing of the far sides of things.
vec4 seen_along(vec3 p, vec3 d, vec4 support, float size) {
    float floor_t = d.z < -1e-4 ? max(p.z - support.w, 0.0) / -d.z : 1e6;
    float t = 0.30 * size, last = 0.22 * size, hit = 0.0;
    int turns = march;
    for (int i = 0; i < turns; i++) {
        vec4 clip = to_clip * vec4(p + d * t, 1.0);
        vec2 q = clip.xy / clip.w * 0.5 + 0.5;
        float behind_by = clip.w - distance_at(q);
        bool inside = clip.w > 0.0 && q == clamp(q, 0.0, 1.0) && t < 0.97 * floor_t;
        bool found = inside && dot(textureLod(guide, q, 0.0).xyz, d) < 0.0 && behind_by > 0.0 && behind_by < 1.3 * (t - last) + 0.10 * size;
        hit = found ? t : hit;
        turns = found || !inside ? 0 : turns;
        last = found ? last : t;
        t = t * stride + 0.035 * size;
    }
    float low = last, high = hit;
    int refine = hit > 0.0 ? 5 : 0;
    for (int i = 0; i < refine; i++) {
        float middle = 0.5 * (low + high);
        vec4 clip = to_clip * vec4(p + d * middle, 1.0);
        vec2 q = clip.xy / clip.w * 0.5 + 0.5;
        bool deep = clip.w > distance_at(q) && dot(textureLod(guide, q, 0.0).xyz, d) < 0.0;
        high = deep ? middle : high;
        low = deep ? low : middle;
    }
    bool on_thing = hit > 0.0;
    vec4 clip = to_clip * vec4(p + d * (on_thing ? high : min(floor_t, 1e3)), 1.0);
    vec2 q = clip.xy / clip.w * 0.5 + 0.5;
    vec2 margin = smoothstep(vec2(0.0), vec2(0.08), q) * smoothstep(vec2(0.0), vec2(0.08), 1.0 - q);
    float open = 1.0 - smoothstep(0.01, 0.03, abs(distance_at(q) / max(clip.w, 1e-6) - 1.0));
    float facing = smoothstep(-0.25, 0.25, dot(d, forward)) * smoothstep(0.0, 0.35, -dot(textureLod(guide, q, 0.0).xyz, d));
#if CLEAR
    // What is seen behind the surface of water lies under it, and is mirrored in nothing.
    vec4 met = to_clip * vec4(p + d * high, 1.0);
    float seen_z = eye.z + (p.z + d.z * high - eye.z) * distance_at(met.xy / met.w * 0.5 + 0.5) / max(met.w, 1e-6);
    facing *= smoothstep(-0.02, 0.02, (seen_z - p.z) / size);
#endif
    float trust = on_thing ? facing : floor_t < 1e5 && clip.w > 0.0 ? open : 0.0;
    return vec4(textureLod(behind, clamp(q, 0.0, 1.0), 0.0).rgb, margin.x * margin.y * trust);
}
#endif

// Split-sum reflectance of a rough surface, after Karis, "Physically Based Shading on Mobile" (2014).
vec3 reflectance(vec3 f0, float roughness, float nv) {
    vec4 r = roughness * vec4(-1.0, -0.0275, -0.572, 0.022) + vec4(1.0, 0.0425, 1.04, -0.04);
    float a004 = min(r.x * r.x, exp2(-9.28 * nv)) * r.x + r.y;
    vec2 ab = vec2(-1.04, 1.04) * a004 + r.zw;
    return f0 * ab.x + ab.y;
}

// Glint of a light on a rough surface: GGX with Smith's visibility.
float glint(float nl, float nv, float nh, float roughness) {
    float a = roughness * roughness, a2 = a * a;
    float d = nh * nh * (a2 - 1.0) + 1.0;
    float k = 0.5 * a;
    float visible = 1.0 / ((nl * (1.0 - k) + k) * (nv * (1.0 - k) + k));
    return 0.25 * a2 / (d * d) * visible;
}

#if WORN
#include "worn.glsl"
#endif

float fifth(float x) { float y = x * x; return y * y * x; }

#if METAL
#include "metal.glsl"
#endif

// The four nearest texels, each as far as it lies at the same distance: coarse shade without halos around things.
float occlusion(vec2 at, float distance_m) {
    vec2 f = fract(at * vec2(textureSize(shade, 0)) - 0.5);
    vec4 shades = textureGather(shade, at, 0), distances = textureGather(shade, at, 1);
    vec4 w = vec4((1.0 - f.x) * f.y, f.x * f.y, f.x * (1.0 - f.y), (1.0 - f.x) * (1.0 - f.y)) + 1e-3;
    w /= 1e-3 + abs(distances / distance_m - 1.0);
    return dot(w, shades) / dot(w, vec4(1.0));
}

#if CLEAR
#include "liquid.glsl"

// The axis across a pane, in its own frame; -1 of what is none. A mesh tells it, a box is measured.
int thin_way(float kind) {
    if (kind > PANE - 0.5 && kind < PANE + 2.5) return int(kind - PANE + 0.5);
    vec3 h = abs(size.xyz);
    float least = min(h.x, min(h.y, h.z)), second = max(min(h.x, h.y), min(max(h.x, h.y), h.z));
    if (abs(kind - 2.0) > 0.5 || least > SLIM * second) return -1;
    return least == h.x ? 0 : least == h.y ? 1 : 2;
}

// How far a ray goes on inside of a thing, m: from p along d, both in the thing's own frame; dip is how straight it goes in.
float way_within(vec3 p, vec3 d, float kind, float radius, float dip) {
    if (abs(kind - TOLD) < 0.5) return within;
    vec3 half_size = abs(size.xyz);
    vec3 inverse = 1.0 / (d + vec3(1e-6) * (step(0.0, d) * 2.0 - 1.0));
    vec3 walls = (sign(d) * half_size - p) * inverse;
    if (kind > 1.5 && kind < 2.5) return max(min(walls.x, min(walls.y, walls.z)), 0.0);
    if (kind > 2.5 && kind < 3.5) {
        float a = max(dot(d.xy, d.xy), 1e-6), b = dot(p.xy, d.xy);
        float round_wall = (-b + sqrt(max(b * b - a * (dot(p.xy, p.xy) - half_size.x * half_size.x), 0.0))) / a;
        return max(min(round_wall, walls.z), 0.0);
    }
    if (kind > 0.5 && kind < 1.5) {
        vec3 q = p / half_size, w = d / half_size;
        return 2.0 * max(-dot(q, w), 0.0) / dot(w, w);
    }
    return 2.0 * radius * dip;
}
#endif

void main() {
    mat3 rotation = transpose(mat3(row0.xyz, row1.xyz, row2.xyz));
    vec3 to_eye = eye - world;
    float range = length(to_eye);
    vec3 v = to_eye / range;
    vec3 nl = normalize(local_normal);

    // Paint and relief.
#if COLOURED
    vec3 own = own_colour;
#else
    vec3 own = base.rgb;
#endif
    vec3 albedo = own;
    vec3 slope = vec3(0.0);
    float height = 1.0;
    float extent = max(size.x, max(size.y, abs(size.z)));
#if CLEAR
    if (more.y > 0.0 && misc.w > 0.0) extent = misc.w;  // of a soft thing, which has no size of its own; else a bevel
#endif
#if PAINT == 1
    Paint coat_of_paint = paint_sides(local, nl, int(weave.z + 0.5), weave.x, weave.y, weave.w);
#elif PAINT == 2
    Paint coat_of_paint = paint_ball(local, weave.y, extent);
#elif PAINT == 3
    Paint coat_of_paint = Paint(texture(paint, weave.z < 6.5 ? uv * weave.x : local.xy * weave.xy + 0.5), vec3(0.0));
#endif
#if PAINT
#if !COLOURED
    albedo *= coat_of_paint.value.rgb;
#endif
    slope = coat_of_paint.slope;
    height = PAINT == 3 ? 1.0 : coat_of_paint.value.a;
#endif
#if VARY
    vec2 spot = (abs(nl.z) > 0.5 ? local.xy : abs(nl.x) > 0.5 ? local.yz : local.xz) + 7.0 * weave.w;
    float patches = textureLod(noise_map, spot * 0.031, 0.0).r + textureLod(noise_map, spot * 0.0067, 0.0).r - 1.0;
    // Far away, where the ground is seen at a glance, such patches would look as if haze lay on it.
    albedo *= 1.0 + more.x * 2.4 * patches * (1.0 - 0.8 * smoothstep(15.0, 90.0, range));
#endif
#if WORN
    albedo = rubbed(albedo);
#endif
#if MARK
    vec3 toward_pole = normalize(local);
    float width = fwidth(toward_pole.z) + 1e-4;
    float band = 1.0 - smoothstep(0.075 - width, 0.075 + width, abs(toward_pole.z));
    float cap = smoothstep(0.975 - width, 0.975 + width, abs(toward_pole.z));
    float bright = dot(albedo, vec3(0.3, 0.6, 0.1));
    albedo = mix(albedo, bright > 0.22 ? albedo * 0.30 : mix(albedo, vec3(0.85), 0.72), max(band, cap));
#endif

    // Rounded edges catch the light.
    vec3 shading = nl;
#if BEVEL
    float edge = max(misc.w, 0.6 * length(fwidth(local)));
    edge = min(edge, 0.45 * min(size.x, min(size.y, size.z)));
#if BEVEL == 1
    vec3 turned = smoothstep(size.xyz - edge, size.xyz, abs(local)) * sign(local);
    shading = normalize(nl + 0.85 * turned * (1.0 - abs(nl)));
#else
    float rim = smoothstep(size.x - edge, size.x, length(local.xy)), top = smoothstep(size.z - edge, size.z, abs(local.z));
    vec3 outward = abs(nl.z) > 0.5 ? vec3(normalize(local.xy + 1e-9) * rim, 0.0) : vec3(0.0, 0.0, sign(local.z) * top);
    shading = normalize(nl + 0.85 * outward);
#endif
#endif
    vec3 flat_normal = normalize(rotation * nl);
    vec3 n = normalize(rotation * (shading - slope + shading * dot(slope, shading)));
    if (dot(flat_normal, v) < 0.0) { flat_normal = -flat_normal; n = -n; }
    float nv = max(dot(n, v), 0.02);

    float roughness = clamp(finish.x + (1.0 - height) * 0.25 * float(RELIEF), 0.03, 1.0);
    // Relief too fine for the picture acts as roughness, which keeps highlights from sparkling.
    vec3 spread_x = dFdx(n), spread_y = dFdy(n);
    float squared = roughness * roughness;
    roughness = sqrt(sqrt(clamp(squared * squared + min(0.35 * (dot(spread_x, spread_x) + dot(spread_y, spread_y)), 0.12), 0.0, 1.0)));
    float metallic = finish.y, coat = finish.z * clamp(height * 2.0 - 0.6, 0.0, 1.0), sheen = finish.w;
    vec3 f0 = mix(vec3(0.04), albedo, metallic);
    vec3 diffuse = albedo * (1.0 - metallic);

    vec2 screen = gl_FragCoord.xy / pixels;
    float depth = dot(world - eye, forward);
#if SIMPLE || CLEAR
    float ao = 1.0;
#else
    float ao = occlusion(screen, depth);
#endif
    float tight = clamp(pow(ao + nv, exp2(-8.0 * roughness - 1.0)) - 1.0 + ao, 0.0, 1.0);

    // Key light. What is thin is lit from behind as well: the side that shows is then not the one that the light meets.
    float direct = max(dot(n, key_direction), 0.0);
#if THIN
    vec3 through = float(THIN) * 0.01 * diffuse * vec3(1.25, 1.2, 0.55), met = flat_normal;
    if (dot(met, key_direction) < 0.0) met = -met;
#else
    vec3 met = flat_normal;
#endif
    float visible = lit(world, met, key_direction, gl_FragCoord.xy);
#if GOBO
    visible *= texture(gobo, 0.5 + 0.5 * (to_gobo * vec4(world, 1.0)).xy).r;
#endif
#if LAMPS
    if (dot(met, key_direction) > 0.0) visible = mix(1.0, visible, key_shade);
    vec4 hidden = vec4(0.0);  // of each lamp with shadows, the share that does not come here
    for (int i = 0; i < lamp_count; i++) {
        vec3 side = flat_normal;
#if THIN
        if (dot(side, lamp_places[i] - world) < 0.0) side = -side;
#endif
        hidden[i] = 1.0 - lamp_lit(i, world, side, gl_FragCoord.xy);
    }
#endif
    visible *= mix(1.0, 0.30, smoothstep(pool.z, pool.w, length(world.xy - pool.xy)));
    vec3 h = normalize(v + key_direction);
    vec3 fresnel = f0 + (1.0 - f0) * fifth(1.0 - max(dot(v, h), 0.0));
    float wide = clamp(roughness + 0.35 * key_spread, 0.05, 1.0);
#if METAL
    wide = max(wide, 0.13);  // a sun in a mirror is less than a pixel: so much of it glares
#endif
    float sharp = mix(smoothstep(0.16, 0.45, roughness), 1.0, key_sharp);
    vec3 light = diffuse * key_colour * direct * visible;
#if THIN
    light += through * key_colour * max(-dot(n, key_direction), 0.0) * visible;
#endif
    vec3 shine = fresnel * key_colour * direct * visible * glint(direct, nv, max(dot(n, h), 0.0), wide) * sharp;
#if COAT
    float glance = coat * (0.04 + 0.96 * fifth(1.0 - max(dot(v, h), 0.0)));
    shine += glance * key_colour * direct * visible * glint(direct, nv, max(dot(flat_normal, h), 0.0), max(0.10, 0.35 * key_spread + 0.08)) * key_sharp;
#endif
    // Fill lights and the model's own.
    for (int i = 0; i < light_count; i++) {
        vec4 where = lights[2 * i], tint = lights[2 * i + 1];
        vec3 toward = where.xyz - where.w * world;
        float d2 = dot(toward, toward);
        toward *= inversesqrt(d2);
        float cone = smoothstep(tint.w, mix(tint.w, 1.0, 0.35), -dot(toward, light_aims[i]));
        float reach = mix(1.0, cone / (0.08 + d2), where.w);
#if LAMPS
        reach *= 1.0 - dot(lamp_masks[i], hidden);
#endif
        float facing = dot(n, toward);
        light += diffuse * tint.rgb * reach * max(0.25 + 0.75 * facing, 0.0) * mix(ao, 1.0, 0.3);
#if THIN
        light += through * tint.rgb * reach * max(-facing, 0.0);
#endif
#if LAMPS
        // What the ground below a lamp gives back, as from its middle: half of what the lamp gives goes there, and cosines twice.
        vec3 below = vec3(where.xy, mirror_z) - world;
        float high = where.z - mirror_z, b2 = dot(below, below) + 1e-6, from = -below.z * inversesqrt(b2);
        float down = tint.w < -0.999 ? 1.0 : max(-light_aims[i].z, 0.0) * (1.0 - tint.w);
        float back = where.w * 2.0 * down * max(from, 0.0) / (high * high + b2 + 0.01) * smoothstep(0.0, 0.05, high);
        light += diffuse * tint.rgb * ground_mean * back * max(0.35 + 0.65 * dot(n, below) * inversesqrt(b2), 0.0) * ao;
#endif
#if !SIMPLE
        facing = max(facing, 0.0);
        vec3 hf = normalize(v + toward);
        shine += (f0 + (1.0 - f0) * fifth(1.0 - max(dot(v, hf), 0.0))) * tint.rgb * reach * facing * ao
            * glint(facing, nv, max(dot(n, hf), 0.0), max(wide, 0.25)) * smoothstep(0.12, 0.4, roughness);
#endif
    }
#if PANELS
    for (int i = 0; i < panel_count; i++) {
        vec3 u = panels[4 * i + 1].xyz, w = panels[4 * i + 2].xyz, way = normalize(cross(u, w));
        vec3 middle = panels[4 * i].xyz - world;
        // Behind it is dark, and so is its own front, which lies in its plane but for rounding.
        if (dot(middle, way) > -1e-4 * (length(u) + length(w))) continue;
        vec3 glow = panels[4 * i + 3].rgb * mix(ao, 1.0, 0.3);
        light += diffuse * glow * panel_form(middle, u, w, n);
#if !SIMPLE
        vec3 onward = reflect(-v, n);
        shine += reflectance(f0, roughness, nv) * glow * panel_image(middle, u, w, way, onward, roughness);
#if COAT
        shine += coat * (0.04 + 0.96 * fifth(1.0 - nv)) * glow * panel_image(middle, u, w, way, reflect(-v, flat_normal), 0.12);
#endif
#endif
    }
#endif
    // Surroundings.
    float down = 0.5 - 0.5 * n.z;
    vec3 ambient = irradiance(n);
#if !GROUND
    ambient += support.rgb * ground_light * down * down * 0.85;
#endif
    // Light that bounced off the surface itself brightens its own crevices.
    light += diffuse * ambient * ao / (1.0 - 0.55 * albedo * (1.0 - ao));
#if THIN
    light += through * irradiance(-n) * ao;
#endif
#if SHEEN
    float edge_on = 1.0 - nv;
    light += sheen * albedo * edge_on * edge_on * edge_on * (ambient * ao + 0.5 * key_colour * visible * (0.3 + 0.7 * direct));
#endif
#if GROUND == 2
    vec3 mirror = textureLod(reflection, screen + n.xy * 0.10 * (1.0 - roughness), clamp(1.2 + roughness * 5.0, 0.0, 5.0)).rgb;
#else
    vec3 mirror = mirrored_light(reflect(-v, n), roughness, support, world, extent);
#endif
#if METAL
#if RELIEF
    vec3 even = normalize(mix(flat_normal, n, 0.3));  // the rest of its relief is in its roughness
#else
    vec3 even = n;
#endif
    mirror = metal_mirror(world, reflect(-v, even), roughness, extent, misc.x);
#endif
#if MIRROR
    vec4 seen = vec4(0.0);
#if METAL
    if (searches == 1)
#endif
    seen = seen_along(world, reflect(-v, n), support, extent);
    seen.a *= 1.0 - smoothstep(0.15, 0.40, roughness);
    mirror = mix(mirror, seen.rgb, seen.a);
#endif
    vec3 env = mirror * reflectance(f0, roughness, nv) * tight;
#if COAT
    float film = coat * (0.04 + 0.96 * fifth(1.0 - max(dot(v, flat_normal), 0.0)));
    light *= 1.0 - film;
#if GROUND == 2
    vec3 gloss = textureLod(reflection, screen, 1.6).rgb;
#else
    vec3 gloss = mirrored_light(reflect(-v, normalize(mix(flat_normal, n, 0.5))), 0.02, support, world, extent);
#endif
#if MIRROR
    gloss = mix(gloss, seen.rgb, seen.a);
#endif
    env = env * (1.0 - film) + film * gloss * tight;
#endif
    vec3 c = light + shine + env + albedo * misc.y;
    float alpha = base.a;

#if CLEAR
    {
        // Glass: the picture behind, displaced as through a lens, tinted, under the mirror image of the surroundings.
        float f = 0.04 + 0.96 * fifth(1.0 - nv);
        vec3 through = refract(-v, n, 1.0 / 1.45);
        vec3 centre = vec3(row0.w, row1.w, row2.w);
        float dip = max(-dot(n, through), 0.05);
        float thin = 2.0 * min(size.x, min(size.y, abs(size.z))) / dip;  // the way through a pane, however wide it is
        vec3 exit_point = world + through * (BALL == 1 ? 2.0 * extent * dip : min(0.35 * extent, thin));
        vec3 onward = BALL == 1 ? refract(through, normalize(centre - exit_point), 1.45) : -v;
        if (dot(onward, onward) < 0.5) onward = through;
        float t = onward.z < -0.02 ? min((exit_point.z - support.w) / -onward.z, 6.0 * extent) : 3.0 * extent;
        if (abs(more.w - TOLD) < 0.5) {  // it is small beside its surroundings, which are seen at once behind it
            exit_point = world + through * within;
            t = 0.0;
        }
        vec4 clip = to_clip * vec4(exit_point + onward * max(t, 0.0), 1.0);
        vec2 q = clamp(clip.xy / clip.w * 0.5 + 0.5, 0.002, 0.998);
        vec3 tint = pow(own, vec3(BALL == 1 ? 0.9 : 0.5 + 0.9 * (1.0 - nv)));
        if (dot(absorbs, vec3(1.0)) > 0.0)
            tint = exp(-absorbs * way_within(local, through * rotation, more.w, misc.w, dip));
        // A wall seen along itself turns light far aside: glass has dark outlines.
        if (BALL == 0) tint *= 1.0 - 0.6 * pow(1.0 - nv, 3.0);
        c = textureLod(behind, q, 0.0).rgb * tint * (1.0 - f) + mirror * f + shine;
        int across = thin_way(more.w);
        if (across >= 0 && abs(nl[across]) < 0.5) {
            // The cut edge of a pane shines by the light that runs along in it, and is not seen through.
            c = mix(c, 1.3 * light + mirror * f + shine, 0.75);
        } else if (across >= 0) {
            // Both faces of a pane mirror. What the picture shows before it they do not: so few steps of a ray break it to pieces.
            float both = 2.0 * f / (1.0 + f);
            c = textureLod(behind, q, 0.0).rgb * tint * (1.0 - both) + mirror * both + shine;
        }
        alpha = more.y > 0.0 ? 1.0 : base.a;
        if (more.y <= 0.0) c = light + shine + env + albedo * misc.y;
        if (abs(more.w - WALL) < 0.5) {
            // A thin wall, near and far: nothing behind is displaced; both mirror, most at the rim, where light goes far in them.
            float both = 2.0 * f / (1.0 + f);
            vec3 seen = textureLod(behind, gl_FragCoord.xy / pixels, 0.0).rgb * pow(own, vec3(min(0.5 / nv, 4.0) + 0.5));
            c = seen * (1.0 - both) * (1.0 - 0.5 * pow(1.0 - nv, 3.0)) + mirror * both + shine;
            alpha = 1.0;
        }
        if (abs(more.w - LIQUID) < 0.5) {
            vec3 up = reflect(-v, n);
            float gloss = 0.0204 + 0.9796 * fifth(1.0 - nv);  // ((1.333 - 1) / (1.333 + 1))^2 at right angles
            vec3 sky_light = mirrored_light(up, 0.02, support, world, extent);
            vec4 near_by = up.z > 0.0 ? seen_along(world, up, vec4(support.rgb, -1e3), 0.25 * extent) : vec4(0.0);
            sky_light = mix(sky_light, near_by.rgb, near_by.a);
            c = through_liquid(world, v, n, weave.xyz, misc.w) * (1.0 - gloss) + sky_light * gloss + shine;
            alpha = 1.0;
        }
    }
#endif

#if SETTING == 2
    c = mix(c, vec3(0.46, 0.57, 0.56), 0.9 * (1.0 - exp(-max(range - 4.0, 0.0) / haze_m)));
#endif
#if GROUND && (SETTING == 0 || SETTING == 3)
    c = mix(c, sky(normalize(vec3(-v.xy, 0.0)), false), smoothstep(fade.z, fade.w, length(world.xy - fade.xy)));
#endif
#if HAZED
    c = mix(c, sky(normalize(vec3(-v.xy, 0.02)), false), 0.95 * (1.0 - exp(-max(range - 12.0, 0.0) / haze_m)));
#endif
    c = fogged(c, eye, world);
#if FROM_METAL
    alpha = range;
#endif
    colour = vec4(min(c, vec3(24.0)), alpha);
}
