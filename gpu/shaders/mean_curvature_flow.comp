#version 430 core
// An iteration of mean curvature flow (smoothing/filters/mean_curvature_flow.h), factors.x lambda.
// 0 source, 1 target, 2 start, 3 offsets and 4 corners of every vertex, 6 anchors
#include "filter_pass.glsl"
#include "corners.glsl"
#define REAL float
#define VEC3 vec3
#include "cotangent_umbrella.glsl"

void main() {
    uint v = element();
    if (v >= element_count) return;
    vec4 own = shifts[v];
    target[v] = own;
    if (own.w <= 0.0) return;
    vec3 sum = vec3(0.0);
    float weights = 0.0;
    uint end = first_corner(v + 1u), last = no_vertex;
    vec3 to_last = vec3(0.0);
    for (uint i = first_corner(v); i < end; ++i) {
        uvec2 others = corner(i);
        vec3 to_next = others.x == last ? to_last : edge(v, others.x);
        last = others.y;
        to_last = edge(v, last);
        add_triangle(to_next, to_last, sum, weights);
    }
    if (!(weights > 0.0)) return;
    vec3 moved = own.xyz + own.w * factors.x * (sum / weights);
    if (cell != 0) moved = inside_cell(start[v].xyz, moved);
    target[v].xyz = moved;
}
