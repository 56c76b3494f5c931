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
#include "finite.glsl"

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

layout(std430, binding = 1) restrict buffer Distances { float distances[]; };
layout(location = 1) uniform bool closed;
layout(location = 2) uniform float far_factor;  // distance, in radii, from which a node counts as distant

#ifdef WIDE
layout(binding = 3) uniform usamplerBuffer node_table;
layout(binding = 4) uniform usamplerBuffer corner_table;
layout(binding = 5) uniform usamplerBuffer dipole_table;
uint node_count() { return uint(textureSize(node_table)) / 2u; }
uint corner_count() { return uint(textureSize(corner_table)); }
vec3 corner(uint i) { return uintBitsToFloat(texelFetch(corner_table, int(i)).xyz); }
Node node(uint at) {
    uvec4 low = texelFetch(node_table, int(2u * at)), high = texelFetch(node_table, int(2u * at + 1u));
    return Node(uintBitsToFloat(low.xyz), low.w, uintBitsToFloat(high.xyz), high.w);
}
Dipole dipole_of(uint at) {
    return Dipole(uintBitsToFloat(texelFetch(dipole_table, int(2u * at))),
                  uintBitsToFloat(texelFetch(dipole_table, int(2u * at + 1u))));
}
#else
layout(std430, binding = 3) restrict readonly buffer Nodes { Node nodes[]; };
layout(std430, binding = 4) restrict readonly buffer Corners { vec4 corners[]; };
layout(std430, binding = 5) restrict readonly buffer Dipoles { Dipole dipoles[]; };
uint node_count() { return uint(nodes.length()); }
uint corner_count() { return uint(corners.length()); }
vec3 corner(uint i) { return corners[i].xyz; }
Node node(uint at) { return nodes[at]; }
Dipole dipole_of(uint at) { return dipoles[at]; }
#endif

const uint leaf = 0x80000000u;
const float whole_sphere = 12.566370614359172;

// A damaged tree may name nodes that it does not have.
Node known_node(uint at) { return node(min(at, node_count() - 1u)); }

// The nodes still to be visited; a tree of 2^32 leaves would be 32 levels deep. In a damaged tree,
// some are left out, and every walk ends after as many visits as there are nodes.
const int deepest = 40;
uint stack[deepest];
int depth = 0;

void push(uint at) {
    if (depth < deepest && at < node_count()) stack[depth++] = at;
}

// Behind the last triangle of a leaf.
uint leaf_end(Node visited) { return min(visited.begin + (visited.right - leaf), corner_count() / 3u); }

float squared_to_box(vec3 p, Node visited) {
    vec3 outside = max(max(visited.low - p, p - visited.high), vec3(0.0));
    return dot(outside, outside);
}

// The nearer child first.
float nearest_squared(vec3 p, float known) {
    depth = 0;
    push(0u);
    float best = known;
    for (uint visits = node_count(); depth > 0 && visits > 0u; --visits) {
        uint at = stack[--depth];
        Node visited = node(at);
        if (!(squared_to_box(p, visited) < best)) continue;
        if (visited.right >= leaf) {
            uint end = leaf_end(visited);
            for (uint i = visited.begin; i < end; ++i)
                best = min(best, to_triangle(corner(3u * i) - p, corner(3u * i + 1u) - p, corner(3u * i + 2u) - p).squared);
            continue;
        }
        bool left_first = squared_to_box(p, known_node(at + 1u)) <= squared_to_box(p, known_node(visited.right));
        push(left_first ? visited.right : at + 1u);
        push(left_first ? at + 1u : visited.right);
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
    depth = 0;
    push(0u);
    float angle = 0.0;
    for (uint visits = node_count(); depth > 0 && visits > 0u; --visits) {
        uint at = stack[--depth];
        Dipole dipole = dipole_of(at);
        vec3 away = dipole.centre.xyz - p;
        float distance = length(away);
        if (distance > far_factor * dipole.area_normal.w) {
            angle += dot(dipole.area_normal.xyz, away) / (distance * distance * distance);
            continue;
        }
        Node visited = node(at);
        if (visited.right >= leaf) {
            uint end = leaf_end(visited);
            for (uint i = visited.begin; i < end; ++i)
                angle += solid_angle(corner(3u * i) - p, corner(3u * i + 1u) - p, corner(3u * i + 2u) - p);
            continue;
        }
        push(visited.right);
        push(at + 1u);
    }
    return angle > 0.5 * whole_sphere;
}

void main() {
    uint v = element();
    if (v >= element_count) return;
    vec3 p = position_of(v);
    float known = distances[v];
    if (known == 0.0 || !is_finite(p)) return;  // what is not finite stays unknown
    float best = nearest_squared(p, known < 1e18 ? known * known : 3e38);
    float distance = best < 3e38 ? min(known, sqrt(best)) : known;
    distances[v] = closed && squared_to_box(p, node(0u)) == 0.0 && inside(p) ? 0.0 : distance;
}
