#version 430 core
// Two soft lights fixed to the eye and a faint rim; back sides (holes, inverted triangles) stand out in red.
in vec3 eye_normal;
in vec3 vertex_colour;
uniform vec3 back_colour;
out vec4 fragment;

void main() {
    vec3 n = normalize(eye_normal);
    if (!gl_FrontFacing) {
        fragment = vec4(back_colour * (0.4 + 0.6 * abs(n.z)), 1.0);
        return;
    }
    float key = max(dot(n, normalize(vec3(0.45, 0.6, 0.8))), 0.0);
    float fill = max(dot(n, normalize(vec3(-0.7, -0.1, 0.5))), 0.0);
    float shine = pow(max(dot(n, normalize(vec3(0.25, 0.35, 1.0))), 0.0), 40.0);
    float rim = pow(1.0 - abs(n.z), 3.0);
    vec3 lit = vertex_colour * (0.22 + 0.62 * key + 0.26 * fill) + vec3(0.12 * shine) - 0.10 * rim;
    fragment = vec4(pow(clamp(lit, 0.0, 1.0), vec3(1.0 / 2.2)), 1.0);
}
