#version 430 core
// Finds every vertex's nearest source in space and proves by a straight walk to it that it reaches
// the vertex (Eq. 5.5): every point of such a walk is closer to the source than the vertex. If the
// walk does not arrive, nothing is proved, and the vertex stays open.
// 0 exact positions, 1 out: sources in doubt of open vertices (else none), 2 nearest, 3 offsets and
// 4 neighbours, 5 beginnings of the cells, 6 sources by cell, 7 results
#include "elements.glsl"
#include "exact.glsl"
#include "neighbours.glsl"
#include "staircase_search.glsl"
#include "cells.glsl"

layout(std430, binding = 1) restrict writeonly buffer Doubts { uint doubts[]; };
layout(std430, binding = 2) buffer Nearest { uint nearest[]; };
layout(std430, binding = 5) restrict readonly buffer CellOffsets { uint cell_offsets[]; };
layout(std430, binding = 6) restrict readonly buffer Sources { uint sources_by_cell[]; };
layout(location = 1) uniform double reach;  // [mm]

const double slack = 1.0lf + 1e-9lf;  // for rounding

struct Source {
    uint vertex;
    double squared;  // distance [mm^2]
};

// Lower bound of the distance from a place to a cell along an axis, in cells.
double gap(double at, int cell) {
    return max(0.0lf, max(double(cell) - at, at - double(cell + 1)) - 1e-9lf * (1.0lf + abs(at)));
}

// Of two equally near sources, the one with the smaller number, whatever the order in a cell.
void look_at(uint source, dvec3 p, inout Source best) {
    double squared = squared_length(p - exact_at(source));
    if (squared < best.squared || (squared == best.squared && source < best.vertex)) best = Source(source, squared);
}

// Visits all sources within a distance no larger than that of the best one.
void look_around(dvec3 p, double distance, inout Source best) {
    dvec3 at = (p - origin) * per_length;
    double cells_far = distance * per_length * slack, squared_scale = per_length * per_length * slack;
    ivec3 first, last;
    for (int axis = 0; axis < 3; ++axis) {
        first[axis] = cell_along(at[axis] - cells_far, axis);
        last[axis] = cell_along(at[axis] + cells_far, axis);
    }
    for (int z = first.z; z <= last.z; ++z) {
        double dz = gap(at.z, z);
        for (int y = first.y; y <= last.y; ++y) {
            double dy = gap(at.y, y);
            if (dy * dy + dz * dz > best.squared * squared_scale) continue;
            uint row = first_in_row(y, z), end = min(cell_offsets[row + uint(last.x) + 1u], uint(sources_by_cell.length()));
            for (uint i = cell_offsets[row + uint(first.x)]; i < end; ++i) look_at(sources_by_cell[i], p, best);
        }
    }
}

// Widens the search step by step, so that most vertices visit few cells.
Source nearest_in_space(dvec3 p) {
    Source best = Source(none, reach * reach);
    double distance = 1.0lf / per_length;
    for (int doublings = 0; ; ++doublings, distance *= 2.0lf) {
        bool whole = !(distance < reach) || doublings >= 64;
        look_around(p, whole ? reach : distance, best);
        if (whole || best.squared <= distance * distance) return best;
    }
}

bool walk_arrives(uint v, uint source) {
    dvec3 goal = exact_at(source);
    double here = squared_length(exact_at(v) - goal);
    for (uint steps = 0u; v != source; ++steps) {
        uint from = v, end = offsets[from + 1u];
        for (uint i = offsets[from]; i < end; ++i) {
            uint u = neighbour(i);
            if (u == source) return true;
            double there = squared_length(exact_at(u) - goal);
            if (there < here) {
                here = there;
                v = u;
            }
        }
        if (v == from || steps >= element_count) return false;
    }
    return true;
}

void main() {
    uint v = element();
    if (v >= element_count) return;
    if (nearest[v] == v) return;
    uint source = nearest_in_space(exact_at(v)).vertex;
    if (source == none) return;
    if (walk_arrives(v, source)) {
        nearest[v] = source;
    } else {
        doubts[v] = source;
        atomicAdd(open, 1u);
    }
}
