// What the steps of the search for the nearest staircase have in common (gpu/staircase_search.h).
layout(std430, binding = 7) buffer Found {
    uint sources;   // how many there are
    uint open;      // vertices whose nearest source may not reach them
    uint moved;     // how often a sweep found something
    uint farthest;  // largest distance [mm], the bits of a float
    uint listed;    // vertices that stay open
};

const uint none = 0xffffffffu;
