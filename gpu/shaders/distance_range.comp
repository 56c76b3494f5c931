#version 430 core
// Smallest and largest of some non-negative distances, compared by their bits.
// 0 distances, 1 both
#include "elements.glsl"

layout(std430, binding = 0) restrict readonly buffer Distances { float distances[]; };
layout(std430, binding = 1) buffer Range { uint least, most; };

shared uint lowest, highest;

void main() {
    uint v = element();
    if (gl_LocalInvocationIndex == 0u) {
        lowest = 0xffffffffu;
        highest = 0u;
    }
    barrier();
    if (v < element_count) {
        uint bits = floatBitsToUint(distances[v]);
        atomicMin(lowest, bits);
        atomicMax(highest, bits);
    }
    barrier();
    if (gl_LocalInvocationIndex != 0u) return;
    atomicMin(least, lowest);
    atomicMax(most, highest);
}
