// Places one instance of a shape: the pose, size and appearance of each thing lie in a buffer texture, ten texels apiece.
#include "swaying.glsl"
layout(location = 0) in vec4 corner;
layout(location = 1) in vec3 corner_normal;
layout(location = 2) in vec2 corner_uv;
#if COLOURED
layout(location = 3) in vec3 corner_colour;
centroid out vec3 own_colour;
#endif

uniform samplerBuffer things;
uniform int first;
uniform mat4 view_projection;
uniform vec3 eye;
uniform float rank_step;  // nudges later things toward the eye, so that coplanar faces never flicker
uniform float mirror_z;   // draws the world mirrored at this height when mirrored is set
uniform int mirrored;

#if FULL
flat out vec4 size, base, finish, weave, misc, support, more;
flat out vec4 row0, row1, row2;
#endif
flat out int thing;
centroid out vec3 world;
centroid out vec3 local;
centroid out vec3 local_normal;
centroid out vec2 uv;
centroid out float within;         // m: how thick it is here, where a corner tells it

out gl_PerVertex { vec4 gl_Position; float gl_ClipDistance[1]; };
invariant gl_Position;

void main() {
    thing = (first + gl_InstanceID) * 10;
    vec4 r0 = texelFetch(things, thing), r1 = texelFetch(things, thing + 1), r2 = texelFetch(things, thing + 2);
    vec4 extent = texelFetch(things, thing + 3);
    vec4 facts = texelFetch(things, thing + 7);
#if FULL
    row0 = r0; row1 = r1; row2 = r2;
    size = extent; misc = facts;
    base = texelFetch(things, thing + 4);
    finish = texelFetch(things, thing + 5);
    weave = texelFetch(things, thing + 6);
    support = texelFetch(things, thing + 8);
    more = texelFetch(things, thing + 9);
#endif
    mat3 rotation = transpose(mat3(r0.xyz, r1.xyz, r2.xyz));
    vec3 origin = vec3(r0.w, r1.w, r2.w);
    local = corner.xyz * extent.xyz + vec3(0.0, 0.0, corner.w * extent.w);
    if (extent.z < 0.0) local = vec3(corner.xy * extent.xy + (transpose(rotation) * (eye - origin)).xy, 0.0);  // endless plane
    local_normal = corner_normal / max(abs(extent.xyz), 1e-9);
    world = rotation * local + origin;
    uv = corner_uv;
    within = corner.w;
#if COLOURED
    own_colour = corner_colour;
#endif
    float kind = texelFetch(things, thing + 9).w;
    if (kind >= 100.0) world += swayed(world, vec2(corner_uv.x, 1.0 - corner_uv.y), vec2(extent.w, facts.w), kind - 100.0);
    vec3 drawn = world;
    if (mirrored == 1) drawn.z = 2.0 * mirror_z - drawn.z;
    gl_ClipDistance[0] = mirrored == 1 ? world.z - mirror_z + 1e-4 : 1.0;
    gl_Position = view_projection * vec4(drawn, 1.0);
    gl_Position.z *= 1.0 + rank_step * facts.z;
#if HALF_DEPTH
    gl_Position.z = 2.0 * gl_Position.z - gl_Position.w;
#endif
}
