#version 430 core
// Lists the vertices still open with the nearest sources known to reach them.
// 1 sources in doubt, 2 nearest, 5 out: vertices and sources, 7 results
#include "elements.glsl"
#include "staircase_search.glsl"

layout(std430, binding = 1) restrict readonly buffer Doubts { uint doubts[]; };
layout(std430, binding = 2) restrict readonly buffer Nearest { uint nearest[]; };
layout(std430, binding = 5) restrict writeonly buffer Open { uvec2 open_vertices[]; };

void main() {
    uint v = element();
    if (v >= element_count || doubts[v] == none) return;
    open_vertices[atomicAdd(listed, 1u)] = uvec2(v, nearest[v]);
}
