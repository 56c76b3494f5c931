// Sums over the vertices of a part, stored at its first vertex: their unit normals as integers, so
// that the order of summation does not matter, and their number.
// Two buffers, because one of both would be too large for large surfaces.
struct PartLow {
    uint low[3];  // lower words of 64-bit numbers
    uint size;    // vertices
};

struct PartHigh {
    uint high[3];  // upper words
    uint inside;   // vertices in the part's plane
};

layout(std430, binding = 1) buffer Normals { int normals[]; };  // 3 per vertex, 1 is 2^30
layout(std430, binding = 5) buffer PartsLow { PartLow part_low[]; };
layout(std430, binding = 6) buffer PartsHigh { PartHigh part_high[]; };

const double unit = 1073741824.0lf;

dvec3 normal_of(uint v) { return dvec3(normals[3u * v], normals[3u * v + 1u], normals[3u * v + 2u]) / unit; }

// Component k of the sum of a part's normals, of its two words.
double sum_of_part(uint part, int k) {
    return double(int(part_high[part].high[k])) * 4294967296.0lf + double(part_low[part].low[k]);
}

// Unit normal of a part's plane; 0 if it has none. Components by name: NVIDIA's linker has no
// assignment to a component of a dvec3 by its index (C9999, __setVectorIndex).
dvec3 normal_of_part(uint part) {
    dvec3 sum = dvec3(sum_of_part(part, 0), sum_of_part(part, 1), sum_of_part(part, 2));
    double size = length(sum);
    return size > 0.0lf ? sum / size : dvec3(0.0lf);
}
