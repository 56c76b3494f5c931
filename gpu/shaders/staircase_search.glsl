// Common part of the steps of the search for the nearest staircase (gpu/staircase_search.h).
layout(std430, binding = 7) buffer Found {
    uint sources;   // number of sources
    uint open;      // vertices whose nearest source may not reach them
    uint moved;     // number of changes in a sweep
    uint farthest;  // largest distance [mm], the bits of a float
    uint listed;    // vertices still open
};

const uint none = 0xffffffffu;
