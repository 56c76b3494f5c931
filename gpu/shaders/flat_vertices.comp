#version 430 core
// Flat vertices, none of whose triangles deviates from their normal
// (smoothing/context/flat_areas.h): each is its own label; all others get none.
// 0 normals of the triangles, 1 out: unit normals, 2 out: labels, 3 offsets and 4 triangles at
// every vertex. Wide: the normals would not fit a buffer; 0 exact positions and 1 triangles instead
#include "elements.glsl"
#include "triangles_at.glsl"
#include "parts.glsl"
#include "part_planes.glsl"

layout(location = 1) uniform double flat_cosine;

const double zero = 1e-12lf;  // [mm^2], as Eigen's isZero()

#ifdef WIDE
#include "area_normal.glsl"
dvec3 face_normal(uint t) { return area_normal(t); }
#else
layout(std430, binding = 0) restrict readonly buffer FaceNormals { double face_normals[]; };
dvec3 face_normal(uint t) { return dvec3(face_normals[3u * t], face_normals[3u * t + 1u], face_normals[3u * t + 2u]); }
#endif

void main() {
    uint v = element();
    if (v >= element_count) return;
    uint first = offsets[v], end = offsets[v + 1u];
    dvec3 sum = dvec3(0.0lf);
    for (uint i = first; i < end; ++i) sum += face_normal(triangle_at(i));
    double size = length(sum);
    bool is_flat = any(greaterThan(abs(sum), dvec3(zero)));
    for (uint i = first; i < end; ++i) {
        dvec3 normal = face_normal(triangle_at(i));
        is_flat = is_flat && dot(normal, sum) >= flat_cosine * size * length(normal);
    }
    labels[v] = is_flat ? v : none;
    if (!is_flat) return;
    for (int k = 0; k < 3; ++k) normals[3u * v + k] = int(round(sum[k] / size * unit));
}
