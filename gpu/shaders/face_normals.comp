#version 430 core
// Normals of all triangles, with twice their area as length [mm^2].
// 0 exact positions, 1 triangles, 2 out: normals, 3 doubles each
#include "elements.glsl"
#include "area_normal.glsl"

layout(std430, binding = 2) restrict writeonly buffer Normals { double normals[]; };

void main() {
    uint t = element();
    if (t >= element_count) return;
    dvec3 normal = area_normal(t);
    for (int k = 0; k < 3; ++k) normals[3u * t + k] = normal[k];
}
