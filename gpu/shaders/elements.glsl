// One invocation per element; if a dispatch has more groups than one axis allows, they form rows.
layout(local_size_x = 256) in;
layout(location = 0) uniform uint element_count;

// Loops that end by themselves, unless numbers are not finite or memory is damaged, also end after
// as many steps as there are elements.

uint element() {
    uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    return group * 256u + gl_LocalInvocationIndex;
}
