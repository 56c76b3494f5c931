#version 430 core
// Distance of each vertex from the original's triangles around its reference vertex, which first
// drifts along with it (thesis 6.4.1, geometry/kernel/local_error.h), and each group's part of the
// sums.
// 0 shifts, 1 out: distances [mm], 2 out: parts (x closest point, y planes, w largest), 3 offsets
// and 4 corners, 5 shifts of the original, 6 anchors, 7 references
#include "elements.glsl"
#include "positions.glsl"
#include "corners.glsl"
#include "reduce.glsl"
#include "closest_point.glsl"
#include "drift.glsl"

layout(std430, binding = 1) restrict writeonly buffer Distances { float distances[]; };
layout(std430, binding = 2) restrict writeonly buffer Parts { vec4 parts[]; };
layout(location = 1) uniform bool planes;  // y, the thesis's form, is required
layout(location = 2) uniform bool follow;  // the references move permanently

const float infinite = 3e38;

struct RingPlace {
    float squared;
    bool outer;  // on the ring's outer edge
    uvec2 ends;  // of that edge
};

RingPlace closest_in_ring(uint centre, uint v) {
    RingPlace place = RingPlace(infinite, false, uvec2(0u));
    vec3 a = way_to(v, centre);
    uint end = first_corner(centre + 1u), last = no_vertex;
    vec3 c = a;
    for (uint i = first_corner(centre); i < end; ++i) {
        uvec2 others = corner(i);
        vec3 b = others.x == last ? c : way_to(v, others.x);
        last = others.y;
        c = way_to(v, last);
        Closest closest = to_triangle(a, b, c);
        if (closest.squared < place.squared) place = RingPlace(closest.squared, closest.outer, others);
    }
    return place;
}

// If the closest point is on the ring's outer edge, the surface beyond may be closer: the ring then
// moves there. Every step comes strictly closer, so the loop ends.
float to_ring(uint reference, uint v) {
    RingPlace best = closest_in_ring(reference, v);
    bool closer = best.outer;
    for (uint steps = 0u; closer && steps < element_count; ++steps) {
        closer = false;
        uvec2 ends = best.ends;
        for (int k = 0; k < 2; ++k) {
            RingPlace next = closest_in_ring(ends[k], v);
            if (!(next.squared < best.squared)) continue;
            best = next;
            closer = next.outer;
        }
    }
    return best.squared < infinite ? sqrt(best.squared) : sqrt(squared_to(reference, v));
}

// Eq. 6.2 as printed.
float to_planes(uint reference, uint v) {
    float largest = -1.0;
    vec3 way = way_to(v, reference);
    uint end = first_corner(reference + 1u);
    for (uint i = first_corner(reference); i < end; ++i) {
        vec3 normal = cross(original_edge(reference, corner(i).x), original_edge(reference, corner(i).y));
        float size = length(normal);
        if (size > 0.0) largest = max(largest, abs(dot(normal, way)) / size);
    }
    return largest >= 0.0 ? largest : sqrt(squared_to(reference, v));
}

vec4 error_of(uint v) {
    uint reference = drifted(references[v], v);
    if (follow) references[v] = reference;
    float distance = to_ring(reference, v);
    distances[v] = distance;
    return vec4(distance, planes ? to_planes(reference, v) : 0.0, 0.0, distance);
}

void main() {
    uint v = element();
    vec4 sum = group_total(v < element_count ? error_of(v) : vec4(0.0));
    if (gl_LocalInvocationIndex == 0u && v < element_count) parts[v / 256u] = sum;
}
