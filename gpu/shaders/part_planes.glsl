// Sums over the vertices of a part, stored at its first vertex: their unit normals as integers, so
// that the order of summation does not matter, and their number.
struct Part {
    uint low[3], high[3];  // words of a 64-bit number
    uint size, inside;     // vertices, and those in the part's plane
};

layout(std430, binding = 1) buffer Normals { int normals[]; };  // 3 per vertex, 1 is 2^30
layout(std430, binding = 5) buffer Parts { Part parts[]; };

const double unit = 1073741824.0lf;

dvec3 normal_of(uint v) { return dvec3(normals[3u * v], normals[3u * v + 1u], normals[3u * v + 2u]) / unit; }

// Unit normal of a part's plane; 0 if it has none.
dvec3 normal_of_part(uint part) {
    dvec3 sum;
    for (int k = 0; k < 3; ++k)
        sum[k] = double(int(parts[part].high[k])) * 4294967296.0lf + double(parts[part].low[k]);
    double size = length(sum);
    return size > 0.0lf ? sum / size : dvec3(0.0lf);
}
