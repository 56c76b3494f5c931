#version 430 core
// Distance of every vertex to a neighbouring structure [mm], 0 inside a closed one, if it is
// smaller than the known one (smoothing/context/distance_weights.h): the nearest triangle in a tree
// of boxes, and the winding number, with distant parts as dipoles
// (geometry/kernel/distance_tree.h).
// 0 shifts, 1 distances, 3 nodes, 4 corners of the triangles by leaf, 5 dipoles of the nodes, 6
// anchors
#include "elements.glsl"
#include "positions.glsl"
#include "closest_point.glsl"
#include "angle.glsl"

struct Node {
    vec3 low;
    uint begin;  // first triangle
    vec3 high;
    uint right;  // right child, the left one is the next node; of a leaf: leaf + number of triangles
};

struct Dipole {
    vec4 area_normal;  // [mm^2], w the radius of the node [mm]
    vec4 centre;
};

layout(std430, binding = 1) buffer Distances { float distances[]; };
layout(std430, binding = 3) restrict readonly buffer Nodes { Node nodes[]; };
layout(std430, binding = 4) restrict readonly buffer Corners { vec4 corners[]; };
layout(std430, binding = 5) restrict readonly buffer Dipoles { Dipole dipoles[]; };
layout(location = 1) uniform bool closed;
layout(location = 2) uniform float far_factor;  // distance, in radii, from which a node counts as distant

const uint leaf = 0x80000000u;
const float whole_sphere = 12.566370614359172;

float squared_to_box(vec3 p, uint at) {
    vec3 outside = max(max(nodes[at].low - p, p - nodes[at].high), vec3(0.0));
    return dot(outside, outside);
}

// The nearer child first; a tree of 2^32 leaves would be 32 levels deep.
float nearest_squared(vec3 p, float known) {
    uint stack[40];
    int depth = 0;
    stack[depth++] = 0u;
    float best = known;
    while (depth > 0) {
        uint at = stack[--depth];
        if (!(squared_to_box(p, at) < best)) continue;
        uint right = nodes[at].right, begin = nodes[at].begin;
        if (right >= leaf) {
            uint end = begin + (right - leaf);
            for (uint i = begin; i < end; ++i)
                best = min(best, to_triangle(corners[3u * i].xyz - p, corners[3u * i + 1u].xyz - p,
                                             corners[3u * i + 2u].xyz - p).squared);
            continue;
        }
        bool left_first = squared_to_box(p, at + 1u) <= squared_to_box(p, right);
        stack[depth++] = left_first ? right : at + 1u;
        stack[depth++] = left_first ? at + 1u : right;
    }
    return best;
}

// Signed solid angle of a triangle seen from the origin [sr] (van Oosterom and Strackee 1983).
float solid_angle(vec3 a, vec3 b, vec3 c) {
    float la = length(a), lb = length(b), lc = length(c);
    float above = dot(a, cross(b, c));
    float below = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
    float angle = above == 0.0 ? 0.0 : 2.0 * angle_of(abs(above), below);
    return above < 0.0 ? -angle : angle;
}

bool inside(vec3 p) {
    if (isnan(p.x + p.y + p.z)) return false;  // else it would visit the whole tree
    uint stack[40];
    int depth = 0;
    stack[depth++] = 0u;
    float angle = 0.0;
    while (depth > 0) {
        uint at = stack[--depth];
        Dipole dipole = dipoles[at];
        vec3 away = dipole.centre.xyz - p;
        float distance = length(away);
        if (distance > far_factor * dipole.area_normal.w) {
            angle += dot(dipole.area_normal.xyz, away) / (distance * distance * distance);
            continue;
        }
        uint right = nodes[at].right, begin = nodes[at].begin;
        if (right >= leaf) {
            uint end = begin + (right - leaf);
            for (uint i = begin; i < end; ++i)
                angle += solid_angle(corners[3u * i].xyz - p, corners[3u * i + 1u].xyz - p, corners[3u * i + 2u].xyz - p);
            continue;
        }
        stack[depth++] = right;
        stack[depth++] = at + 1u;
    }
    return angle > 0.5 * whole_sphere;
}

void main() {
    uint v = element();
    if (v >= element_count) return;
    vec3 p = position_of(v);
    float known = distances[v];
    if (known == 0.0) return;
    float best = nearest_squared(p, known < 1e18 ? known * known : 3e38);
    float distance = best < 3e38 ? min(known, sqrt(best)) : known;
    distances[v] = closed && squared_to_box(p, 0u) == 0.0 && inside(p) ? 0.0 : distance;
}
