// Normals of triangles, with twice their area as length [mm^2], in double precision and in the
// CPU's order; 0 if a triangle has none. Includes the exact positions, binding 0.
#include "exact.glsl"

#ifdef WIDE
layout(binding = 1) uniform usamplerBuffer triangle_table;
uint triangle_word(uint i) { return texelFetch(triangle_table, int(i)).x; }
#else
layout(std430, binding = 1) restrict readonly buffer Triangles { uint triangles[]; };
uint triangle_word(uint i) { return triangles[i]; }
#endif

dvec3 area_normal(uint t) {
    dvec3 a = exact_at(triangle_word(3u * t));
    precise dvec3 u = exact_at(triangle_word(3u * t + 1u)) - a, w = exact_at(triangle_word(3u * t + 2u)) - a;
    precise dvec3 normal = dvec3(u.y * w.z - u.z * w.y, u.z * w.x - u.x * w.z, u.x * w.y - u.y * w.x);
    return normal;
}
