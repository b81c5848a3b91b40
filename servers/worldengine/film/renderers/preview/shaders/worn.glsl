// Edges of boxes (BEVEL 1) and cylinders (2) where hands and knocks wore off what is painted, in flakes that no two things share.
uniform vec4 worn;  // colour of what shows there, below 0 that of the thing itself, paler; how far from an edge, m

vec3 rubbed(vec3 own) {
    float reach = max(min(worn.w, 0.12 * min(size.x, min(size.y, size.z))), 2.0 * misc.w), pixel = length(fwidth(local));
#if BEVEL == 1
    vec3 away = size.xyz - abs(local);
    float low = min(away.x, min(away.y, away.z)), high = max(away.x, max(away.y, away.z));
    float from_edge = away.x + away.y + away.z - low - high;
#else
    float from_edge = max(size.x - length(local.xy), size.z - abs(local.z));
#endif
    if (from_edge > reach) return own;
    // Both sides of an edge see one pattern, which goes through the thing.
    vec2 at = vec2(dot(local, vec3(0.83, 0.41, -0.37)), dot(local, vec3(-0.29, 0.64, 0.71))) + 7.0 * weave.w;
    float flakes = 0.6 * textureLod(noise_map, at * 6.0, 0.0).r + 0.4 * textureLod(noise_map, at * 1.9 + 0.37, 0.0).r;
    float least = 0.88 - 0.5 * (1.0 - from_edge / reach);
    float gone = smoothstep(least - 0.03, least + 0.03, flakes) * clamp(reach / (1.5 * pixel), 0.0, 1.0);
    return mix(own, worn.x < 0.0 ? 1.22 * own + 0.025 : worn.rgb, 0.85 * gone);
}
