#version 430 core
// Orientation of every triangle relative to the image stack (thesis Eq. 5.3): 0 if its normal is
// parallel to the axis, 1 if it is orthogonal, -1 if there is none. In double precision and in the
// CPU's order, so that the same vertices are staircases.
// 0 exact positions, 1 triangles, 2 out: orientations
#include "elements.glsl"
#include "area_normal.glsl"

layout(std430, binding = 2) restrict writeonly buffer Orientations { double orientations[]; };
layout(location = 1) uniform dvec3 axis;  // unit

void main() {
    uint t = element();
    if (t >= element_count) return;
    dvec3 normal = area_normal(t);
    precise double size = sqrt(squared_length(normal));
    precise double along = normal.x * axis.x + normal.y * axis.y + normal.z * axis.z;
    orientations[t] = size > 0.0lf ? max(0.0lf, 1.0lf - abs(along) / size) : -1.0lf;
}
