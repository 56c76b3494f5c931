#version 430 core
// Sets other weights at the start of a run; fixed vertices stay fixed.
// 0 start, w the weight or -1, 1 weights
#include "elements.glsl"

layout(std430, binding = 0) buffer Start { vec4 start[]; };
layout(std430, binding = 1) readonly buffer Weights { float weights[]; };

void main() {
    uint v = element();
    if (v < element_count && start[v].w >= 0.0) start[v].w = weights[v];
}
