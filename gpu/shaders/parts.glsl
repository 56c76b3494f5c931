// Connected parts of flat vertices (gpu/device_caps.h). A vertex' label is another vertex of its part
// with a smaller number, or itself, where labels lead to in the end: the part's first vertex.
layout(std430, binding = 2) coherent buffer Labels { uint labels[]; };

const uint none = 0xffffffffu;

uint first_of(uint v) {
    while (labels[v] != v) v = labels[v];
    return v;
}
