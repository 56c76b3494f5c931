// Triangles at every vertex: the two other corners, in triangle orientation. The highest bit of an
// offset is set if the vertex is on a boundary.
layout(std430, binding = 3) readonly buffer Offsets { uint offsets[]; };
layout(std430, binding = 4) readonly buffer Corners { uvec2 corners[]; };

uint first_corner(uint v) { return offsets[v] & 0x7fffffffu; }
bool on_boundary(uint v) { return offsets[v] >= 0x80000000u; }
