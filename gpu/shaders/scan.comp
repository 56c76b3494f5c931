#version 430 core
// Inclusive prefix sum: each number becomes the sum of those up to it in its group's 1024, and the
// groups' sums are stored; a second pass, after a prefix sum of these, adds the sum of the groups
// before.
// 0 numbers, 1 sums of the groups
#include "elements.glsl"

layout(std430, binding = 0) buffer Numbers { uint numbers[]; };
layout(std430, binding = 1) buffer Sums { uint sums[]; };
layout(location = 1) uniform uint count;      // element_count is a quarter of it, rounded up
layout(location = 2) uniform bool of_groups;  // second pass

shared uint totals[256];

void add_within() {
    uint i = gl_LocalInvocationIndex, first = 4u * element();
    uint four[4], sum = 0u;
    for (uint k = 0u; k < 4u; ++k) {
        if (first + k < count) sum += numbers[first + k];
        four[k] = sum;
    }
    totals[i] = sum;
    for (uint apart = 1u; apart < 256u; apart *= 2u) {
        barrier();
        uint before = i >= apart ? totals[i - apart] : 0u;
        barrier();
        totals[i] += before;
    }
    barrier();
    uint before = i > 0u ? totals[i - 1u] : 0u;
    for (uint k = 0u; k < 4u; ++k)
        if (first + k < count) numbers[first + k] = before + four[k];
    uint group = element() / 256u;
    if (i == 255u && 1024u * group < count) sums[group] = totals[255];
}

void main() {
    if (!of_groups) {
        add_within();
        return;
    }
    uint first = 4u * element(), group = element() / 256u;
    for (uint k = 0u; k < 4u; ++k)
        if (group > 0u && first + k < count) numbers[first + k] += sums[group - 1u];
}
