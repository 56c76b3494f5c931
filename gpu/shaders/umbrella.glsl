// The uniform umbrella operator: mean of the neighbours minus the own value.
#include "neighbours.glsl"
layout(std430, binding = 5) restrict readonly buffer AnchorUmbrellas { vec4 anchor_umbrellas[]; };

// Of the shifts, or of the values the source holds instead.
vec3 umbrella_of_shifts(uint v, vec3 own) {
    uint first = offsets[v], end = offsets[v + 1u];
    if (first == end) return vec3(0.0);
    vec3 sum = vec3(0.0);
    for (uint i = first; i < end; ++i) sum += shifts[neighbour(i)].xyz - own;
    return sum / float(end - first);
}

// Of the positions: the anchors' part is constant.
vec3 umbrella_of_positions(uint v, vec3 own) {
    return anchor_umbrellas[v].xyz + umbrella_of_shifts(v, own);
}
