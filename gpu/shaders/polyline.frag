#version 430 core
// With round ends, which join segments; evaluated for every sample.
in vec3 colour;
flat in float length_px;
sample noperspective in vec2 way;
uniform float half_width;
uniform float opacity;
out vec4 fragment;

void main() {
    float beyond = max(max(-way.x, way.x - length_px), 0.0);
    if (beyond * beyond + way.y * way.y > half_width * half_width) discard;
    fragment = vec4(pow(colour, vec3(1.0 / 2.2)), opacity);
}
