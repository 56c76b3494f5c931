// Common part of the passes of all filters. They move shifts (positions.glsl); w is the vertex's
// weight in [0, 1], or -1 if it is fixed.
#include "elements.glsl"
#include "positions.glsl"

layout(std430, binding = 1) buffer Target { vec4 target[]; };
layout(std430, binding = 2) restrict readonly buffer Start { vec4 start[]; };

layout(location = 1) uniform vec4 factors;  // their meaning depends on the filter
layout(location = 2) uniform int onto;      // linear steps: 0 nothing, 1 source, 2 target
layout(location = 3) uniform bool last;     // the last pass of an iteration
layout(location = 4) uniform bool of_positions;  // linear steps: the source holds shifts
layout(location = 5) uniform int iteration;
layout(location = 6) uniform int cell;        // 0 no constraint, 1 voxel, 2 diamond
layout(location = 7) uniform vec3 half_size;  // of the cell along its axes [mm]
layout(location = 8) uniform mat3 cell_axes;  // unit columns

// Limits the move to the cell around the vertex's start; only with a constraint.
vec3 inside_cell(vec3 origin, vec3 wanted) {
    vec3 moved = transpose(cell_axes) * (wanted - origin);
    if (cell == 1) {
        vec3 inside = clamp(moved, -half_size, half_size);
        return inside == moved ? wanted : origin + cell_axes * inside;
    }
    float outside = dot(abs(moved), 1.0 / half_size);
    return outside <= 1.0 ? wanted : origin + (wanted - origin) / outside;
}
