#version 430 core
// One colour for all edges, of sources whose corners have no colours.
uniform vec4 edge_colour;
uniform float opacity;
out vec4 fragment;

void main() { fragment = vec4(pow(edge_colour.rgb, vec3(1.0 / 2.2)), edge_colour.a * opacity); }
