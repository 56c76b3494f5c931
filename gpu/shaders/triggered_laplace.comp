#version 430 core
// An iteration of curvature-triggered smoothing (smoothing/curvature_triggered.h), factors.x lambda.
// Vertices join in one iteration after their neighbours: whatever a neighbour writes in this one is
// not yet below `iteration`, so that their order does not count.
// 0 source, 1 target, 2 start, 3 offsets and 4 neighbours, 5 first iterations
#include "filter_pass.glsl"

layout(std430, binding = 3) readonly buffer Offsets { uint offsets[]; };
layout(std430, binding = 4) readonly buffer Neighbours { uint neighbours[]; };
layout(std430, binding = 5) coherent buffer First { int first[]; };

void main() {
    uint v = element();
    if (v >= element_count) return;
    vec4 own = source[v];
    target[v] = own;
    uint begin = offsets[v], end = offsets[v + 1u];
    if (own.w <= 0.0 || begin == end) return;
    bool moves = first[v] <= iteration;
    vec3 sum = vec3(0.0);
    for (uint i = begin; i < end; ++i) {
        sum += source[neighbours[i]].xyz - own.xyz;
        if (!moves && first[neighbours[i]] < iteration) {
            moves = true;
            first[v] = iteration;
        }
    }
    if (!moves) return;
    vec3 moved = own.xyz + own.w * factors.x * (sum / float(end - begin));
    if (cell != 0) moved = inside_cell(start[v].xyz, moved);
    target[v].xyz = moved;
}
