// How far a corner at p is from where it stands in calm air, as `film/swaying.py` says; w is its weight, m, and its phase.
vec3 swayed(vec3 p, vec2 w, vec2 wind, float t) {
    float speed = max(length(wind), 1e-9);
    vec2 along = wind / speed, across = vec2(-along.y, along.x);
    float u = dot(p.xy, along), v = dot(p.xy, across), far = w.x * min(speed / 8.0, 2.0);
    float gust = 0.55 + 0.30 * sin(1.9 * t - 0.9 * u + 0.4 * v + w.y) + 0.15 * sin(4.7 * t - 2.3 * u + 1.3 * v + 2.0 * w.y);
    float flutter = 0.22 * sin(9.0 * t - 3.0 * u + 4.0 * w.y);
    return vec3(far * (gust * along + flutter * across), -0.4 * far * gust * gust);
}
