#version 430 core
// One colour for all edges, of sources whose corners have no colours.
uniform vec4 edge_colour;
out vec4 fragment;

void main() { fragment = edge_colour; }
