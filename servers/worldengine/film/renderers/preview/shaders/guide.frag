// What ambient occlusion needs: world normal and distance along the view axis.
flat in vec4 row0, row1, row2;
centroid in vec3 world;
centroid in vec3 local;
centroid in vec3 local_normal;
uniform vec3 eye;
uniform vec3 forward;
out vec4 guide;
void main() {
    mat3 rotation = transpose(mat3(row0.xyz, row1.xyz, row2.xyz));
    vec3 n = normalize(rotation * local_normal);
    if (dot(n, world - eye) > 0.0) n = -n;
    guide = vec4(n, dot(world - eye, forward));
}
