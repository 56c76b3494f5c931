// The reference of each moved vertex: the original vertex that it drifts to along the original's edges
// (geometry/kernel/local_error.h).
layout(std430, binding = 5) restrict readonly buffer OriginalShifts { vec4 original_shifts[]; };
layout(std430, binding = 7) buffer References { uint references[]; };

// From a vertex to the original place of another one.
vec3 way_to(uint v, uint u) {
    return (anchors[u].xyz - anchors[v].xyz) + (original_shifts[u].xyz - shifts[v].xyz);
}

vec3 original_edge(uint from, uint to) {
    return (anchors[to].xyz - anchors[from].xyz) + (original_shifts[to].xyz - original_shifts[from].xyz);
}

float squared_to(uint u, uint v) {
    vec3 way = way_to(v, u);
    return dot(way, way);
}

// Every step comes strictly closer, so the loop ends. Comparisons are false for not-a-number.
uint drifted(uint reference, uint v) {
    reference = min(reference, element_count - 1u);
    float closest = squared_to(reference, v);
    bool closer = true;
    for (uint steps = 0u; closer && steps < element_count; ++steps) {
        closer = false;
        uint from = reference, end = first_corner(from + 1u), last = no_vertex;
        for (uint i = first_corner(from); i < end; ++i) {
            uvec2 others = corner(i);
            for (int k = others.x == last ? 1 : 0; k < 2; ++k) {
                float squared = squared_to(others[k], v);
                if (!(squared < closest)) continue;
                closest = squared;
                reference = others[k];
                closer = true;
            }
            last = others.y;
        }
    }
    return reference;
}
