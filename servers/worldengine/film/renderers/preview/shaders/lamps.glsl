// Soft shadows of lamps: each looks through faces of a cube around it, which lie as tiles in one map. Depth is 1 - near / distance
// along the axis of a face, by which every plane is an even ramp, and a penumbra as wide as the difference of two depths.
#define TILE_TANGENT 1.3     // a face reaches beyond its edges, so that no filter does
#define WIDEST 0.15          // radius of the widest penumbra as the lamp sees it, radians
uniform sampler2D lamp_depth;
uniform sampler2DShadow lamp_compare;
uniform sampler2D lamp_blocks;
uniform vec3 lamp_places[4];
uniform vec4 lamp_radii;       // of what shines, m
uniform vec3 lamp_axes[12];    // by threes: the axes of its cube
uniform vec4 lamp_faces[24];   // by sixes, +x -x +y -y +z -z: the middle of the tile in u and v, and whether there is one
uniform vec4 lamp_masks[12];   // of each light, how much of which lamp's shadow it has
uniform vec2 lamp_scale;       // half a tile in u, and the near distance, m
uniform int lamp_count;
uniform float key_shade;       // how dark a shadow of the key light may be beside them

// The share of a lamp that reaches p; none reaches what faces away.
float lamp_lit(int lamp, vec3 p, vec3 n, vec2 pixel) {
    float texel = 1.0 / float(textureSize(lamp_depth, 0).x), tangent = lamp_scale.x / TILE_TANGENT, near = lamp_scale.y;
    mat3 axes = transpose(mat3(lamp_axes[3 * lamp], lamp_axes[3 * lamp + 1], lamp_axes[3 * lamp + 2]));
    vec3 way = p - lamp_places[lamp];
    vec3 d = axes * way, m = axes * n, a = abs(d);
    float slope = -dot(way, n) * inversesqrt(dot(way, way));
    int axis = a.x > max(a.y, a.z) ? 0 : a.y > a.z ? 1 : 2;
    d = axis == 0 ? d.yzx : axis == 1 ? d.zxy : d;
    m = axis == 0 ? m.yzx : axis == 1 ? m.zxy : m;
    float side = d.z < 0.0 ? -1.0 : 1.0;
    d.xz *= side;
    m.xz *= side;
    vec3 tile = lamp_faces[6 * lamp + 2 * axis + (side < 0.0 ? 1 : 0)].xyz;
    float grain = d.z * texel / tangent;  // a texel here, m
    d += m * grain * 1.5;
    d.z = max(d.z, near);
    vec2 at = d.xy / d.z;
    vec3 s = vec3(tile.xy + at * tangent, 1.0 - near / d.z);
    vec2 tilt = clamp(m.xy / min(dot(m, d) / d.z, -0.12), -6.0, 6.0);
    vec2 gradient = -tilt * near / d.z / tangent;
    float bias = (0.6 + 1.2 * length(tilt)) * grain * near / (d.z * d.z);
    ivec2 size = textureSize(lamp_blocks, 0);
    vec2 bounds = texelFetch(lamp_blocks, clamp(ivec2(s.xy * vec2(size)), ivec2(0), size - 1), 0).rg;
    bool all_lit = tile.z < 0.5 || bounds.x >= s.z - bias;
    // A disc before the lamp, seen askew by the face: along its own slant it is as long as the way to it, by that to the face.
    float b = 1.0 + at.x * at.x, far = sqrt(b + at.y * at.y), root = inversesqrt(b);
    mat2 askew = mat2(b * root, at.x * at.y * root, 0.0, far * root);
    float most = min(WIDEST * far, (TILE_TANGENT - max(abs(at.x), abs(at.y))) / far) * tangent;
    float per_depth = lamp_radii[lamp] / near * tangent;
    float widest = min(most, per_depth * max(s.z - bounds.x, 0.0));
    bool all_dark = !all_lit && bounds.y < s.z - bias - length(gradient) * widest * far;
    int turns = all_lit || all_dark || slope <= 0.0 ? 0 : blockers;
    mat2 whirl = askew * WHIRL * inverse(askew);
    float share = softened(lamp_depth, lamp_compare, s, s.z, gradient, bias, 0.999999, turns,
                           per_depth, widest, 1.2 * texel, max(most, 1.2 * texel), askew * first_way(pixel), whirl);
    return all_dark ? 0.0 : share * smoothstep(0.0, 0.2, slope);
}
