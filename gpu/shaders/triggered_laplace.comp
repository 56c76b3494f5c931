#version 430 core
// An iteration of curvature-triggered smoothing (smoothing/filters/curvature_triggered.h),
// factors.x lambda. Vertices join one iteration after their neighbours: a value that a neighbour
// writes in this iteration is not yet below `iteration`, so the order does not matter.
// 0 source, 1 target, 2 start, 3 offsets and 4 neighbours, 5 umbrellas of the anchors, 7 first
// iterations
#include "filter_pass.glsl"
#include "umbrella.glsl"

layout(std430, binding = 7) coherent buffer First { int first[]; };

bool joins(uint v) {
    if (first[v] <= iteration) return true;
    uint end = offsets[v + 1u];
    for (uint i = offsets[v]; i < end; ++i)
        if (first[neighbour(i)] < iteration) {
            first[v] = iteration;
            return true;
        }
    return false;
}

void main() {
    uint v = element();
    if (v >= element_count) return;
    vec4 own = shifts[v];
    target[v] = own;
    if (own.w <= 0.0 || !joins(v)) return;
    vec3 moved = own.xyz + own.w * factors.x * umbrella_of_positions(v, own.xyz);
    if (cell != 0) moved = inside_cell(start[v].xyz, moved);
    target[v].xyz = moved;
}
