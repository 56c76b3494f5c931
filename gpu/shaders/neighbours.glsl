// Neighbours of every vertex.
layout(std430, binding = 3) readonly buffer Offsets { uint offsets[]; };
layout(std430, binding = 4) readonly buffer Neighbours { uint neighbours[]; };
