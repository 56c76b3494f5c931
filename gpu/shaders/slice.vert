#version 430 core
// A slice of an image: its corners.
layout(location = 0) in vec3 place;
#include "camera.glsl"
flat out uint element;
out vec2 pixel;

void main() {
    set_place(place);
    gl_Position = clip_of(place);
    element = 0u;
    pixel = vec2(gl_VertexID & 1, gl_VertexID >> 1);
}
