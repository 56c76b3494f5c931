#version 430 core
// A mark of a place, one an instance: a square on the screen.
layout(location = 0) in vec3 place;
layout(location = 1) in vec3 mark_colour;
layout(location = 2) in float diameter;  // [pixels]
#include "camera.glsl"
uniform vec2 viewport;    // [pixels]
uniform int highlighted;  // -1: none
out vec3 colour;
flat out uint element;
flat out float radius;
sample noperspective out vec2 way;  // from the middle [pixels]

void main() {
    bool lit_up = gl_InstanceID == highlighted;
    radius = 0.5 * diameter * (lit_up ? 1.35 : 1.0);
    way = radius * vec2((gl_VertexID & 1) == 0 ? -1.0 : 1.0, gl_VertexID < 2 ? -1.0 : 1.0);
    set_place(place);
    vec4 clip = clip_of(place);
    clip.xy += 2.0 / viewport * clip.w * way;
    gl_Position = clip.w > 0.0 ? clip : vec4(2.0, 2.0, 2.0, 1.0);
    element = uint(gl_InstanceID);
    colour = lit_up ? vec3(1.0, 0.62, 0.10) : mark_colour;
}
