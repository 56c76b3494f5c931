#version 430 core
// Adds the parts of another dispatch's groups, in one group; element_count is their number, 0 the
// parts, 1 the results, of which number `place` is written.
#include "elements.glsl"
#include "reduce.glsl"

layout(std430, binding = 0) restrict readonly buffer Parts { vec4 parts[]; };
layout(std430, binding = 1) restrict writeonly buffer Results { vec4 results[]; };
layout(location = 1) uniform uint place;

void main() {
    vec4 sum = vec4(0.0);
    for (uint i = gl_LocalInvocationIndex; i < element_count; i += 256u) sum = joined(sum, parts[i]);
    sum = group_total(sum);
    if (gl_LocalInvocationIndex == 0u) results[place] = sum;
}
