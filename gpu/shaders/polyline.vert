#version 430 core
// A segment of a polyline, one an instance: a rectangle around it on the screen, longer by the width.
layout(location = 0) in vec3 from;
layout(location = 1) in vec3 to;
layout(location = 2) in vec3 segment_colour;
#include "camera.glsl"
uniform vec2 viewport;    // [pixels]
uniform float half_width; // [pixels]
uniform int highlighted;  // -1: none
out vec3 colour;
flat out uint element;
flat out float length_px;
sample noperspective out vec2 way;  // along and across the segment from its start [pixels]

void main() {
    vec4 a = clip_of(from), b = clip_of(to);
    float before_a = a.z + a.w, before_b = b.z + b.w;  // of the near plane
    if (before_a < 0.0 && before_b >= 0.0) a = mix(a, b, before_a / (before_a - before_b));
    if (before_b < 0.0 && before_a >= 0.0) b = mix(b, a, before_b / (before_b - before_a));
    vec2 start = 0.5 * viewport * a.xy / a.w, end = 0.5 * viewport * b.xy / b.w;
    length_px = length(end - start);
    vec2 along = length_px > 1e-4 ? (end - start) / length_px : vec2(1.0, 0.0);
    bool at_end = gl_VertexID >= 2;
    float side = (gl_VertexID & 1) == 0 ? -half_width : half_width;
    way = vec2(at_end ? length_px + half_width : -half_width, side);
    vec4 clip = at_end ? b : a;
    clip.xy += 2.0 / viewport * clip.w * (along * (at_end ? half_width : -half_width) + vec2(-along.y, along.x) * side);
    gl_Position = before_a < 0.0 && before_b < 0.0 ? vec4(2.0, 2.0, 2.0, 1.0) : clip;
    set_place(at_end ? to : from);
    element = uint(gl_InstanceID);
    colour = gl_InstanceID == highlighted ? vec3(1.0, 0.62, 0.10) : segment_colour;
}
