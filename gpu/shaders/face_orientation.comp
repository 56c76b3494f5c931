#version 430 core
// Orientation of every triangle in relation to the image stack (thesis Eq. 5.3): 0 where its normal is
// parallel to the axis, 1 where it is orthogonal, -1 where it has none. In double precision and in
// the CPU's order, so that the same vertices are staircases.
// 0 exact positions, 1 triangles, 2 out: orientations
#include "elements.glsl"
#include "exact.glsl"

layout(std430, binding = 1) readonly buffer Triangles { uint triangles[]; };
layout(std430, binding = 2) writeonly buffer Orientations { double orientations[]; };
layout(location = 1) uniform dvec3 axis;  // unit

dvec3 corner(uint t, uint k) {
    return exact_at(triangles[3u * t + k]);
}

void main() {
    uint t = element();
    if (t >= element_count) return;
    dvec3 a = corner(t, 0u);
    precise dvec3 u = corner(t, 1u) - a, w = corner(t, 2u) - a;
    precise dvec3 normal = dvec3(u.y * w.z - u.z * w.y, u.z * w.x - u.x * w.z, u.x * w.y - u.y * w.x);
    precise double size = sqrt(normal.x * normal.x + normal.y * normal.y + normal.z * normal.z);
    precise double along = normal.x * axis.x + normal.y * axis.y + normal.z * axis.z;
    orientations[t] = size > 0.0lf ? max(0.0lf, 1.0lf - abs(along) / size) : -1.0lf;
}
