#version 430 core
// Sets other weights at the start of a run; fixed vertices stay fixed.
// 0 start, w the weight or -1, 1 weights, 2 out: start
#include "elements.glsl"

layout(std430, binding = 0) restrict readonly buffer Before { vec4 before[]; };
layout(std430, binding = 1) restrict readonly buffer Weights { float weights[]; };
layout(std430, binding = 2) restrict writeonly buffer Start { vec4 start[]; };

void main() {
    uint v = element();
    if (v >= element_count) return;
    vec4 own = before[v];
    start[v] = vec4(own.xyz, own.w >= 0.0 ? weights[v] : own.w);
}
