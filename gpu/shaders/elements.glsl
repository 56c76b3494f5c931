// One invocation per element; if a dispatch has more groups than one axis allows, they form rows.
layout(local_size_x = 256) in;
layout(location = 0) uniform uint element_count;

// The last resort of loops that end by themselves unless memory is damaged.
const uint most_steps = 1u << 24;

uint element() {
    uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    return group * 256u + gl_LocalInvocationIndex;
}
