// One invocation an element; dispatches of more groups than one axis takes have rows of groups.
layout(local_size_x = 256) in;
layout(location = 0) uniform uint element_count;

uint element() {
    uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    return group * 256u + gl_LocalInvocationIndex;
}
