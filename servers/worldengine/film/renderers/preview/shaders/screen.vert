// One triangle that covers the screen.
uniform float depth;
out vec2 at;
void main() {
    at = vec2((gl_VertexID << 1) & 2, gl_VertexID & 2);
    gl_Position = vec4(at * 2.0 - 1.0, depth, 1.0);
#if HALF_DEPTH
    gl_Position.z = 2.0 * gl_Position.z - gl_Position.w;
#endif
}
