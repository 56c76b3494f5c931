#version 430 core
// Vertex normals, weighted by the angle at the vertex, and mean curvature (thesis 6.4.2), with each
// group's part of the integrals of H and |H| [mm] and of the volume [mm^3] (Eqs. 6.4, 6.5).
// 0 shifts, 1 out: normal and H [1/mm], 2 out: parts, 3 offsets and 4 corners, 6 anchors
#include "elements.glsl"
#include "positions.glsl"
#include "corners.glsl"
#include "angle.glsl"
#include "reduce.glsl"
#define REAL float
#define VEC3 vec3
#include "corner_curvature.glsl"

layout(std430, binding = 1) restrict writeonly buffer Normals { vec4 normals[]; };
layout(std430, binding = 2) restrict writeonly buffer Parts { vec4 parts[]; };

// Component of the flow along the normal (Eq. 6.3); 0 if it is below the rounding of the areas.
float along(vec3 flow, vec3 normal, float doubled_areas) {
    float size = length(normal);
    return size > 1e-5 * doubled_areas ? dot(flow, normal) / size : 0.0;
}

vec4 shape_of(uint v) {
    vec3 flow = vec3(0.0), outward = vec3(0.0), normal = vec3(0.0);
    float area = 0.0, doubled_areas = 0.0;
    uint end = first_corner(v + 1u), last = no_vertex;
    vec3 to_last = vec3(0.0);
    for (uint i = first_corner(v); i < end; ++i) {
        uvec2 others = corner(i);
        vec3 to_next = others.x == last ? to_last : edge(v, others.x);
        last = others.y;
        to_last = edge(v, last);
        CornerShare share = corner_share(to_next, to_last);
        flow += share.flow;
        area += share.area;
        doubled_areas += share.across;
        normal += share.normal;
        if (share.across > 0.0) outward += angle_of(share.across, share.along) / share.across * share.normal;
    }
    float size = length(outward), curvature = 0.0;
    // less is the rounding remainder of coincident triangles: no normal
    outward = size > 1e-5 ? outward / size : vec3(0.0);
    if (area > 0.0 && !on_boundary(v)) curvature = mean_of(flow, outward, area);
    normals[v] = vec4(outward, curvature);
    vec2 integrals = on_boundary(v) ? vec2(0.0) : vec2(along(flow, normal, doubled_areas), length(flow)) / 4.0;
    return vec4(integrals, dot(position_of(v), normal) / 18.0, 0.0);  // each triangle counts at 3 corners
}

void main() {
    uint v = element();
    vec4 sum = group_total(v < element_count ? shape_of(v) : vec4(0.0));
    if (gl_LocalInvocationIndex == 0u && v < element_count) parts[v / 256u] = sum;
}
