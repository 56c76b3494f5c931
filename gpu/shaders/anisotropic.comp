#version 430 core
// An iteration of anisotropic smoothing (smoothing/filters/anisotropic.h), factors.x lambda. In
// double precision: features are detected in every iteration, and if single precision decides one
// vertex differently, its whole neighbourhood shows it.
// 0 source, 1 target, 2 start, 3 offsets and 4 corners of every vertex, 6 anchors
#include "filter_pass.glsl"
#include "corners.glsl"
#include "angle_double.glsl"
#define REAL double
#define VEC3 dvec3
#include "cotangent_umbrella.glsl"
#include "corner_curvature.glsl"

layout(location = 9) uniform double feature_curvature;  // [1/mm]

dvec3 exact_edge(uint from, uint to) {
    return (dvec3(anchors[to].xyz) - dvec3(anchors[from].xyz)) + (dvec3(shifts[to].xyz) - dvec3(shifts[from].xyz));
}

// Meyer et al. 2003, section 6: fraction of the flow that a vertex keeps.
double flow_share(double mean, double gauss, double feature) {
    double spread = sqrt(max(0.0lf, mean * mean - gauss));
    double one = mean + spread, two = mean - spread;
    if (abs(one) <= feature && abs(two) <= feature) return 1.0lf;
    if (abs(one) > feature && abs(two) > feature && gauss > 0.0lf) return 0.0lf;
    double smallest = abs(one) < abs(two) ? one : two;
    if (abs(mean) <= abs(smallest)) return 1.0lf;
    return clamp(smallest / mean, 0.0lf, 1.0lf);
}

void main() {
    uint v = element();
    if (v >= element_count) return;
    vec4 own = shifts[v];
    target[v] = own;
    if (own.w <= 0.0) return;
    dvec3 sum = dvec3(0.0lf), flow = dvec3(0.0lf), normal = dvec3(0.0lf);
    double weights = 0.0lf, area = 0.0lf, angles = 0.0lf;
    uint end = first_corner(v + 1u);
    for (uint i = first_corner(v); i < end; ++i) {
        dvec3 to_next = exact_edge(v, corner(i).x), to_last = exact_edge(v, corner(i).y);
        add_triangle(to_next, to_last, sum, weights);
        CornerShare share = corner_share(to_next, to_last);
        flow += share.flow;
        normal += share.normal;
        area += share.area;
        if (share.across > 0.0lf) angles += angle_of(share.across, share.along);
    }
    if (!(weights > 0.0lf)) return;
    double share = factors.x;
    if (area > 0.0lf && !on_boundary(v))
        share *= flow_share(mean_of(flow, normal, area), (6.28318530717958647693lf - angles) / area, feature_curvature);
    vec3 moved = own.xyz + vec3(own.w * share * (sum / weights));
    if (cell != 0) moved = inside_cell(start[v].xyz, moved);
    target[v].xyz = moved;
}
