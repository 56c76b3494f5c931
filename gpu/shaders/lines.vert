#version 430 core
// Draws the triangles' edges, pulled slightly towards the eye so that they win against their own
// surface.
layout(location = 0) in vec3 position;
uniform mat4 to_clip;
uniform float pull;  // relative to the depth of the model

void main() {
    gl_Position = to_clip * vec4(position, 1.0);
    gl_Position.z -= pull * gl_Position.w;
}
