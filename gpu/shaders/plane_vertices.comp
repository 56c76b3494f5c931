#version 430 core
// Counts, or lists with their labels, the vertices of the parts that are planar and may be enough
// for a cap.
// 0 count, 2 labels, 5 and 6 parts, 7 out: list
#include "elements.glsl"
#include "parts.glsl"
#include "part_planes.glsl"

layout(std430, binding = 0) buffer Count { uint count; };
layout(std430, binding = 7) restrict writeonly buffer Listed { uvec2 listed[]; };
layout(location = 1) uniform uint smallest;  // faces of a cap
layout(location = 2) uniform bool lists;

void main() {
    uint v = element();
    if (v >= element_count || labels[v] == none) return;
    uint inside = part_high[labels[v]].inside, size = part_low[labels[v]].size;
    // a planar net of n vertices has fewer than 2 n triangles
    if (2u * inside < size || 2u * size < smallest) return;
    uint place = atomicAdd(count, 1u);
    if (lists) listed[place] = uvec2(v, labels[v]);
}
