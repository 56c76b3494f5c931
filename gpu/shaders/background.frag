#version 430 core
// From one colour to another, in steps that are even to the eye.
in float above;
uniform vec3 colour_above, colour_below;
out vec4 fragment;

void main() {
    vec3 code = vec3(1.0 / 2.2);
    fragment = vec4(mix(pow(colour_below, code), pow(colour_above, code), above), 1.0);
}
