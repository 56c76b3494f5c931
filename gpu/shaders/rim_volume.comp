#version 430 core
// Volume between an open rim and the fan from its mean, which closes the surface virtually: one
// group per rim; its part is z of the entries behind the parts of the surface.
// 0 shifts, 2 parts, 3 offsets of the rims, 4 their vertices, 6 anchors
#include "elements.glsl"
#include "positions.glsl"
#include "reduce.glsl"

layout(std430, binding = 2) buffer Parts { vec4 parts[]; };
layout(std430, binding = 3) restrict readonly buffer Offsets { uint offsets[]; };
layout(std430, binding = 4) restrict readonly buffer Vertices { uint vertices[]; };
layout(location = 1) uniform uint first_part;

void main() {
    uint rim = element() / 256u;
    bool used = rim * 256u < element_count;
    uint begin = used ? offsets[rim] : 0u, end = used ? offsets[rim + 1u] : 0u;
    vec3 sum = vec3(0.0);
    for (uint i = begin + gl_LocalInvocationIndex; i < end; i += 256u) sum += position_of(vertices[i]);
    vec3 centre = group_total(vec4(sum, 0.0)).xyz / float(max(end - begin, 1u));
    barrier();
    float volume = 0.0;
    for (uint i = begin + gl_LocalInvocationIndex; i < end; i += 256u) {
        vec3 a = position_of(vertices[i]);
        vec3 b = position_of(vertices[i + 1u < end ? i + 1u : begin]);
        volume += dot(centre, cross(b - centre, a - centre)) / 6.0;
    }
    volume = group_total(vec4(0.0, 0.0, volume, 0.0)).z;
    if (gl_LocalInvocationIndex == 0u && used) parts[first_part + rim] = vec4(0.0, 0.0, volume, 0.0);
}
