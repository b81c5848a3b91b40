const float LIQUID = 9.0, WALL = 10.0;
const float PANE = 11.0, SLIM = 0.25;  // a mesh that is a pane, x across; so thin, by its second side, is a pane
const float TOLD = 8.0;  // what is clear and tells at each corner how thick it is there
// What is seen through the surface of a body of liquid: along the bent ray to what the picture has behind it, fainter by the way.
// At an upright wall of it, as of a glass, light comes out again at the far side, bent there, too: a lens.
vec3 through_liquid(vec3 p, vec3 v, vec3 n, vec3 middle, float half_width) {
    const float index = 1.333;
    vec3 d = refract(-v, n, 1.0 / index);
    float most = 2.2 * half_width, t;
    vec4 clip = to_clip * vec4(p, 1.0);
    if (abs(n.z) < 0.5) {
        vec2 from = p.xy - middle.xy;
        float a = max(dot(d.xy, d.xy), 1e-6), b = dot(from, d.xy);
        t = clamp(-2.0 * b / a, 0.0, most);
        vec3 out_at = p + d * t;
        vec3 inward = vec3(-normalize(out_at.xy - middle.xy + 1e-9), 0.0);
        vec3 onward = refract(d, inward, index);
        if (dot(onward, onward) < 0.5) onward = reflect(d, inward);
        // What stands in it is met before the far side, where the ray goes in behind what the picture shows, not far behind it.
        const int steps = 20;
        float before = (to_clip * vec4(out_at, 1.0)).w;
        for (int i = 1; i <= steps; i++) {
            vec4 within = to_clip * vec4(p + d * (t * float(i) / float(steps)), 1.0);
            vec2 at = within.xy / within.w * 0.5 + 0.5;
            float met = distance_at(at);
            if (met > clip.w && met < within.w && within.w - met < 2.0 * t / float(steps))
                return textureLod(behind, clamp(at, 0.002, 0.998), 0.0).rgb * exp(-absorbs * t * float(i) / float(steps));
        }
        vec4 leaves = to_clip * vec4(out_at, 1.0);
        vec2 q = clip.xy / clip.w * 0.5 + 0.5;
        float behind_it = max(distance_at(leaves.xy / leaves.w * 0.5 + 0.5), distance_at(q));
        float far = clamp(behind_it - before, 0.3 * half_width, 12.0 * half_width);
        vec4 there = to_clip * vec4(out_at + onward * far, 1.0);
        vec2 wanted = there.xy / there.w * 0.5 + 0.5;
        if (distance_at(wanted) > before) q = wanted;  // else what it holds hides that place in the picture
        return textureLod(behind, clamp(q, 0.002, 0.998), 0.0).rgb * exp(-absorbs * t);
    }
    vec2 q = clip.xy / clip.w * 0.5 + 0.5;
    float ahead = max(dot(d, forward), 0.05);
    t = 0.0;
    for (int i = 0; i < 4; i++) {
        t = clamp(t + 0.8 * (distance_at(q) - clip.w) / ahead, 0.0, most);
        clip = to_clip * vec4(p + d * t, 1.0);
        q = clamp(clip.xy / clip.w * 0.5 + 0.5, 0.002, 0.998);
    }
    // Near the picture's edge what is bent beyond it is not known: there it is less bent.
    vec2 straight = gl_FragCoord.xy / pixels;
    vec2 wanted = (to_clip * vec4(p + d * t, 1.0)).xy / clip.w * 0.5 + 0.5;
    vec2 room = min(straight, 1.0 - straight), past = abs(wanted - straight);
    float kept = min(min(1.0, 0.9 * room.x / max(past.x, 1e-5)), min(1.0, 0.9 * room.y / max(past.y, 1e-5)));
    return textureLod(behind, mix(straight, wanted, kept), 0.0).rgb * exp(-absorbs * t);
}
