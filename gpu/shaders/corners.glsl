// Triangles at every vertex: the two other corners, in triangle orientation. Most begin with the
// neighbour at which the last one ends, which need not be read again. The highest bit of an offset
// is set if the vertex is on a boundary.
layout(std430, binding = 3) restrict readonly buffer Offsets { uint offsets[]; };
#ifdef WIDE
layout(binding = 4) uniform usamplerBuffer corner_table;
uvec2 corner(uint i) { return texelFetch(corner_table, int(i)).xy; }
#else
layout(std430, binding = 4) restrict readonly buffer Corners { uvec2 corners[]; };
uvec2 corner(uint i) { return corners[i]; }
#endif

const uint no_vertex = 0xffffffffu;

uint first_corner(uint v) { return offsets[v] & 0x7fffffffu; }
bool on_boundary(uint v) { return offsets[v] >= 0x80000000u; }
