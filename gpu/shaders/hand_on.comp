#version 430 core
// A sweep over the open vertices: a source that reaches a neighbour reaches them, too, if it is
// within reach. If it is their nearest source in space, they are no longer open. Neighbours may
// change at the same time: any source they have reaches them.
// 0 exact positions, 1 sources in doubt, 2 nearest, 3 offsets and 4 neighbours, 7 results
#include "elements.glsl"
#include "exact.glsl"
#include "neighbours.glsl"
#include "staircase_search.glsl"

layout(std430, binding = 1) buffer Doubts { uint doubts[]; };
layout(std430, binding = 2) coherent buffer Nearest { uint nearest[]; };
layout(location = 1) uniform double reach;  // [mm]

void main() {
    uint v = element();
    if (v >= element_count || doubts[v] == none) return;
    dvec3 own = exact_at(v);
    uint known = nearest[v], best = known;
    double least = known == none ? 0.0lf : squared_length(own - exact_at(known));
    uint end = offsets[v + 1u];
    for (uint i = offsets[v]; i < end; ++i) {
        uint source = nearest[neighbour(i)];
        if (source == none || source == best) continue;
        double squared = squared_length(own - exact_at(source));
        if (squared > reach * reach || (best != none && squared >= least)) continue;
        best = source;
        least = squared;
    }
    if (best == known) return;
    nearest[v] = best;
    atomicAdd(moved, 1u);
    if (least > squared_length(own - exact_at(doubts[v]))) return;
    doubts[v] = none;
    atomicAdd(open, none);
}
