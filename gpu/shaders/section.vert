#version 430 core
// A rectangle in the clip plane.
#include "camera.glsl"
uniform vec3 corners[4];

void main() {
    set_place(corners[gl_VertexID]);
    gl_Position = clip_of(corners[gl_VertexID]);
}
