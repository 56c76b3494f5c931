#version 430 core
// Multiplies weights by a function of the distance [mm], selected by `kind`: 0 staircases (thesis
// Eqs. 5.5-5.6), scale x the largest distance, y beta_min; 1 neighbours, linear or from a margin, 2
// neighbours, Eq. 5.2, scale x distance from which weights grow, y the largest distance minus that,
// z omega [1/mm]; 3 nothing.
// 0 distances [mm], 1 weights, 2 constant factor: 0 on caps, or other weights
#include "elements.glsl"

layout(std430, binding = 0) restrict readonly buffer Distances { float distances[]; };
layout(std430, binding = 1) buffer Weights { float weights[]; };
layout(std430, binding = 2) restrict readonly buffer Factors { float factors[]; };
layout(location = 1) uniform vec4 scale;
layout(location = 2) uniform int kind;

const float unreached = 3e38;

// e^x - 1 without loss of precision near 0.
float grown(float x) { return abs(x) < 0.01 ? x * (1.0 + x * (0.5 + x * (1.0 / 6.0 + x / 24.0))) : exp(x) - 1.0; }

float staircase_weight(float d) {
    float near = d >= unreached ? 0.0 : (scale.x > 0.0 ? 1.0 - d / scale.x : 1.0);
    return near * (1.0 - scale.y) + scale.y;
}

float neighbour_weight(float d) {
    float beyond = max(0.0, d - scale.x);
    if (!(scale.y > 0.0)) return 0.0;
    if (kind == 1) return beyond / scale.y;
    float omega = scale.z;
    return exp(omega * (beyond - scale.y)) * grown(-omega * beyond) / grown(-omega * scale.y);
}

void main() {
    uint v = element();
    if (v >= element_count) return;
    float d = distances[v];
    weights[v] *= factors[v] * (kind == 3 ? 1.0 : clamp(kind == 0 ? staircase_weight(d) : neighbour_weight(d), 0.0, 1.0));
}
