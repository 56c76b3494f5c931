#version 430 core
// Joins the labels of flat vertices along edges: of two first vertices, the one with the larger
// number on the surface gets the other as its label. The loser of a race retries from a smaller
// number, so the loop ends, and the parts do not depend on the order.
// 0 numbers on the surface, 2 labels, 3 offsets and 4 neighbours
#include "elements.glsl"
#include "parts.glsl"
#include "neighbours.glsl"

layout(std430, binding = 0) restrict readonly buffer Numbers { uint numbers[]; };
layout(location = 1) uniform bool reordered;  // false: numbers are the same here

bool before(uint a, uint b) { return reordered ? numbers[a] < numbers[b] : a < b; }

void join(uint a, uint b) {
    for (uint tries = 0u; tries < element_count; ++tries) {
        a = first_of(a);
        b = first_of(b);
        if (a == b) return;
        uint smaller = before(a, b) ? a : b, larger = smaller == a ? b : a;
        uint known = atomicCompSwap(labels[larger], larger, smaller);
        if (known == larger) return;
        a = known;
        b = smaller;
    }
}

void main() {
    uint v = element();
    if (v >= element_count || labels[v] == none) return;
    uint end = offsets[v + 1u];
    for (uint i = offsets[v]; i < end; ++i) {
        uint u = neighbour(i);
        if (u < v && labels[u] != none) join(u, v);
    }
}
