#version 430 core
// Draws a surface from the buffers that smoothing works on: attributes 0 anchor and 1 shift [mm],
// whose sum is the position relative to the centre of the start's bounding box, 2 unit normal, 3 a
// value mapped to the colour scale (linear RGB, 256 steps) from `range.x` to `range.y`.
layout(location = 0) in vec4 anchor;
layout(location = 1) in vec4 shift;
layout(location = 2) in vec4 normal;
layout(location = 3) in float value;
layout(std140, binding = 0) uniform Scale { vec4 scale[256]; };
uniform mat4 to_clip;
uniform mat3 to_eye;
uniform bool by_value;
uniform vec2 range;
out vec3 eye_normal;
out vec3 vertex_colour;

vec3 shown(float x) {
    float share = range.y > range.x ? (x - range.x) / (range.y - range.x) : 0.0;
    return scale[int(255.0 * clamp(share, 0.0, 1.0) + 0.5)].rgb;
}

void main() {
    eye_normal = to_eye * normal.xyz;
    vertex_colour = by_value ? shown(value) : vec3(0.72, 0.42, 0.34);
    gl_Position = to_clip * vec4(anchor.xyz + shift.xyz, 1.0);
}
