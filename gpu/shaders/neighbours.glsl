// Neighbours of every vertex.
layout(std430, binding = 3) restrict readonly buffer Offsets { uint offsets[]; };
#ifdef WIDE
layout(binding = 4) uniform usamplerBuffer neighbour_table;
uint neighbour(uint i) { return texelFetch(neighbour_table, int(i)).x; }
#else
layout(std430, binding = 4) restrict readonly buffer Neighbours { uint neighbours[]; };
uint neighbour(uint i) { return neighbours[i]; }
#endif
