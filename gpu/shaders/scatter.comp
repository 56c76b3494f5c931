#version 430 core
// Writes values to given places.
// 0 places, 1 values, 2 out
#include "elements.glsl"

layout(std430, binding = 0) restrict readonly buffer Places { uint places[]; };
layout(std430, binding = 1) restrict readonly buffer Values { float values[]; };
layout(std430, binding = 2) restrict writeonly buffer Out { float written[]; };

void main() {
    uint i = element();
    if (i < element_count) written[places[i]] = values[i];
}
