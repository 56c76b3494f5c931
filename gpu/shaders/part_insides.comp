#version 430 core
// Drops the vertices outside their part's plane, and counts the others.
// 1 unit normals, 2 labels, 5 and 6 parts
#include "elements.glsl"
#include "parts.glsl"
#include "part_planes.glsl"

layout(location = 1) uniform double spread_cosine;

shared uint common_part, inside;

void main() {
    uint v = element(), part = none;
    if (gl_LocalInvocationIndex == 0u) {
        common_part = none;
        inside = 0u;
    }
    barrier();
    if (v < element_count && labels[v] != none) {
        part = labels[v];
        if (dot(normal_of(v), normal_of_part(part)) < spread_cosine) {
            labels[v] = none;
            part = none;
        } else {
            atomicMin(common_part, part);
        }
    }
    barrier();
    if (part != none && part == common_part) atomicAdd(inside, 1u);
    if (part != none && part != common_part) atomicAdd(part_high[part].inside, 1u);
    barrier();
    if (gl_LocalInvocationIndex == 0u && common_part != none) atomicAdd(part_high[common_part].inside, inside);
}
