#version 430 core
// Counts the sources in every cell; in a second pass, after a prefix sum of the counts, puts each
// in its place.
// 0 exact positions, 2 nearest, 5 counts or ends of the cells, which become their beginnings, 6
// out: sources by cell
#include "elements.glsl"
#include "exact.glsl"
#include "cells.glsl"

layout(std430, binding = 2) restrict readonly buffer Nearest { uint nearest[]; };
layout(std430, binding = 5) buffer CellOffsets { uint cell_offsets[]; };
layout(std430, binding = 6) restrict writeonly buffer Sources { uint sources_by_cell[]; };
layout(location = 1) uniform bool places;  // false: counts

void main() {
    uint v = element();
    if (v >= element_count || nearest[v] != v) return;
    uint cell = cell_of(exact_at(v));
    if (places)
        sources_by_cell[atomicAdd(cell_offsets[cell], 0xffffffffu) - 1u] = v;
    else
        atomicAdd(cell_offsets[cell], 1u);
}
