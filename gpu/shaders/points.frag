#version 430 core
// A disc with a light outline and a dark line around it; evaluated for every sample.
in vec3 colour;
flat in float radius;
sample noperspective in vec2 way;
uniform float opacity;
out vec4 fragment;

void main() {
    float inside = radius - length(way);
    if (inside < 0.0) discard;
    vec3 shown = inside < 0.8 ? vec3(0.02) : inside < 2.2 ? vec3(0.92) : colour;
    fragment = vec4(pow(shown, vec3(1.0 / 2.2)), opacity);
}
