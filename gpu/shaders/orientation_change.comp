#version 430 core
// Orientation change of every vertex (thesis Eq. 5.4): the largest minus the smallest orientation
// of the triangles around it; those without a normal are ignored. A larger change of an earlier axis
// stays.
// 0 orientations, 1 in and out: changes, 0 before the first axis, 3 offsets and 4 triangles at every vertex
#include "elements.glsl"
#include "triangles_at.glsl"

layout(std430, binding = 0) restrict readonly buffer Orientations { double orientations[]; };
layout(std430, binding = 1) buffer Changes { double changes[]; };

void main() {
    uint v = element();
    if (v >= element_count) return;
    double smallest = 2.0lf, largest = -1.0lf;
    for (uint i = offsets[v]; i < offsets[v + 1u]; ++i) {
        double orientation = orientations[triangle_at(i)];
        if (orientation < 0.0lf) continue;
        smallest = min(smallest, orientation);
        largest = max(largest, orientation);
    }
    if (largest >= 0.0lf) changes[v] = max(changes[v], largest - smallest);
}
