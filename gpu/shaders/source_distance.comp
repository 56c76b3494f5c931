#version 430 core
// Distance of every vertex to its nearest source [mm], and the largest settled one.
// 0 exact positions, 1 out: distances, 2 nearest, 5 sources in doubt of open vertices, 7
// results
#include "elements.glsl"
#include "exact.glsl"
#include "staircase_search.glsl"

layout(std430, binding = 1) restrict writeonly buffer Distances { float distances[]; };
layout(std430, binding = 2) restrict readonly buffer Nearest { uint nearest[]; };
layout(std430, binding = 5) restrict readonly buffer Doubts { uint doubts[]; };

const float unreached = 3.1e38;  // gpu/shaders/distance_weight.comp

shared uint largest;

void main() {
    uint v = element();
    if (gl_LocalInvocationIndex == 0u) largest = 0u;
    barrier();
    if (v < element_count) {
        float distance = unreached;
        if (nearest[v] != none) {
            distance = float(sqrt(squared_length(exact_at(v) - exact_at(nearest[v]))));
            if (doubts[v] == none) atomicMax(largest, floatBitsToUint(distance));
        }
        distances[v] = distance;
    }
    barrier();
    if (gl_LocalInvocationIndex == 0u && largest > 0u) atomicMax(farthest, largest);
}
