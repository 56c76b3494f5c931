#version 430 core
// Makes every vertex whose orientation change exceeds the threshold, and that is on no cap, its own
// nearest staircase; all others have none yet.
// 0 orientation changes, 1 free of caps: 0 on them, 2 out: nearest, 7 results
#include "elements.glsl"
#include "staircase_search.glsl"

layout(std430, binding = 0) restrict readonly buffer Changes { double changes[]; };
layout(std430, binding = 1) restrict readonly buffer Free { float free_of_caps[]; };
layout(std430, binding = 2) restrict writeonly buffer Nearest { uint nearest[]; };
layout(location = 1) uniform double tau_theta;

shared uint in_group;

void main() {
    uint v = element();
    if (gl_LocalInvocationIndex == 0u) in_group = 0u;
    barrier();
    if (v < element_count) {
        bool source = changes[v] > tau_theta && free_of_caps[v] > 0.0;
        nearest[v] = source ? v : none;
        if (source) atomicAdd(in_group, 1u);
    }
    barrier();
    if (gl_LocalInvocationIndex == 0u && in_group > 0u) atomicAdd(sources, in_group);
}
