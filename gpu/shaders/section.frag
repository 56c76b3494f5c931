#version 430 core
// A plain area: the section of a solid by the clip plane. Lit evenly, so that its colour can be recognised.
uniform vec3 section_colour;
out vec4 fragment;

void main() { fragment = vec4(pow(section_colour, vec3(1.0 / 2.2)), 1.0); }
