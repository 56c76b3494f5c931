// Connected parts of flat vertices (gpu/device_caps.h). A vertex's label is another vertex of its
// part that comes before it on the surface, or itself; following the labels ends at the part's first
// vertex.
layout(std430, binding = 2) coherent buffer Labels { uint labels[]; };

const uint none = 0xffffffffu;

uint first_of(uint v) {
    for (uint steps = 0u; labels[v] != v && steps < element_count; ++steps) v = labels[v];
    return v;
}
