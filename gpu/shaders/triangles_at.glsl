// Triangles at every vertex.
layout(std430, binding = 3) restrict readonly buffer Offsets { uint offsets[]; };
#ifdef WIDE
layout(binding = 4) uniform usamplerBuffer triangle_at_table;
uint triangle_at(uint i) { return texelFetch(triangle_at_table, int(i)).x; }
#else
layout(std430, binding = 4) restrict readonly buffer TrianglesAt { uint triangles_at[]; };
uint triangle_at(uint i) { return triangles_at[i]; }
#endif
