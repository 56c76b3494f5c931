#version 430 core
// The iteration of curvature-triggered smoothing from which each vertex may move: 0 if its mean
// curvature at the start exceeds the trigger [1/mm], else practically never. In double precision,
// so that the same vertices start as on the CPU.
// 0 exact positions, 2 start, 3 offsets and 4 corners, 7 first iterations
#include "elements.glsl"
#include "exact.glsl"
#include "corners.glsl"
#define REAL double
#define VEC3 dvec3
#include "corner_curvature.glsl"

layout(std430, binding = 2) restrict readonly buffer Start { vec4 start[]; };
layout(std430, binding = 7) restrict writeonly buffer First { int first[]; };
layout(location = 1) uniform double trigger;

void main() {
    uint v = element();
    if (v >= element_count) return;
    first[v] = 0x7fffffff;
    if (start[v].w <= 0.0 || on_boundary(v)) return;
    dvec3 own = exact_at(v), flow = dvec3(0.0), normal = dvec3(0.0);
    double area = 0.0;
    uint end = first_corner(v + 1u);
    for (uint i = first_corner(v); i < end; ++i) {
        CornerShare share = corner_share(exact_at(corner(i).x) - own, exact_at(corner(i).y) - own);
        flow += share.flow;
        normal += share.normal;
        area += share.area;
    }
    if (area > 0.0 && abs(mean_of(flow, normal, area)) > trigger) first[v] = 0;
}
