#version 430 core
// Labels every flat vertex with the first one of its part and adds it to the part. Vertices of one
// part in a group are summed first, because parts can be as large as the surface.
// 1 unit normals, 2 labels, 5 and 6 parts
#include "elements.glsl"
#include "parts.glsl"
#include "part_planes.glsl"

shared uint common_part, low[3], high[3], size;

void main() {
    uint v = element(), part = none;
    if (gl_LocalInvocationIndex == 0u) {
        common_part = none;
        size = 0u;
        for (int k = 0; k < 3; ++k) low[k] = high[k] = 0u;
    }
    barrier();
    if (v < element_count && labels[v] != none) {
        part = first_of(v);
        labels[v] = part;
        atomicMin(common_part, part);
    }
    barrier();
    if (part != none) {
        bool common_one = part == common_part;
        for (int k = 0; k < 3; ++k) {
            int number = normals[3u * v + k];
            uint word = uint(number), sign_word = number < 0 ? none : 0u;
            uint before = common_one ? atomicAdd(low[k], word) : atomicAdd(part_low[part].low[k], word);
            uint carry = before + word < before ? 1u : 0u;
            if (common_one)
                atomicAdd(high[k], sign_word + carry);
            else
                atomicAdd(part_high[part].high[k], sign_word + carry);
        }
        if (common_one)
            atomicAdd(size, 1u);
        else
            atomicAdd(part_low[part].size, 1u);
    }
    barrier();
    if (gl_LocalInvocationIndex != 0u || common_part == none) return;
    for (int k = 0; k < 3; ++k) {
        uint before = atomicAdd(part_low[common_part].low[k], low[k]);
        atomicAdd(part_high[common_part].high[k], high[k] + (before + low[k] < before ? 1u : 0u));
    }
    atomicAdd(part_low[common_part].size, size);
}
