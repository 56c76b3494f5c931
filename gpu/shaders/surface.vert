#version 430 core
// Draws a surface: attribute 0 position [mm] relative to the bounding box's centre, 1 unit normal, 2 colour (linear RGB).
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 colour;
uniform mat4 to_clip;
uniform mat3 to_eye;
out vec3 eye_normal;
out vec3 vertex_colour;

void main() {
    eye_normal = to_eye * normal;
    vertex_colour = colour;
    gl_Position = to_clip * vec4(position, 1.0);
}
