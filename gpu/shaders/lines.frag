#version 430 core
// One colour for all edges.
uniform vec4 line_colour;
out vec4 fragment;

void main() {
    fragment = line_colour;
}
