#version 430 core
// Moves each vertex's reference along with it (thesis 6.4.1).
// 0 shifts, 3 offsets and 4 corners, 5 shifts of the original, 6 anchors, 7 references
#include "elements.glsl"
#include "positions.glsl"
#include "corners.glsl"
#include "drift.glsl"

void main() {
    uint v = element();
    if (v < element_count) references[v] = drifted(references[v], v);
}
