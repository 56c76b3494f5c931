#include "gpu/render/coarse_triangles.h"

#include <limits>

namespace vesselbench {

namespace {

constexpr VertexId kNone = std::numeric_limits<VertexId>::max();

std::size_t label_of(const DrawingLayout& layout, std::size_t drawn) {
    return layout.tags[drawn] / 4;
}

/// Vertices with copies in several patches stand for themselves.
std::vector<VertexId> with_rims_kept(const DrawingLayout& layout) {
    const std::size_t count = layout.topology->vertex_count();
    std::vector<VertexId> stands_for(count, kNone);
    for (std::size_t e = 0; e < layout.extras.size(); ++e) {
        const VertexId v = layout.extras[e];
        if (label_of(layout, v) != label_of(layout, count + e)) stands_for[v] = v;
    }
    return stands_for;
}

/// The vertex that takes each one's place, by the surface's vertices, #V.
std::vector<VertexId> independent_set(const DrawingLayout& layout) {
    std::vector<VertexId> stands_for = with_rims_kept(layout);
    const CompressedRows& rings = layout.topology->rings();
    for (VertexId v = 0; v < stands_for.size(); ++v) {
        if (stands_for[v] != kNone) continue;
        stands_for[v] = v;
        for (const VertexId u : rings.row(v))
            if (stands_for[u] == kNone) stands_for[u] = v;
    }
    return stands_for;
}

}  // namespace

std::vector<Triangle> coarse_triangles(const DrawingLayout& layout) {
    const std::vector<VertexId> stands_for = independent_set(layout);
    const auto place_of = [&](VertexId drawn) {
        const VertexId v = layout.original_of(drawn);
        return stands_for[v] == v ? drawn : stands_for[v];
    };
    std::vector<Triangle> triangles;
    for (const Triangle& t : layout.triangles) {
        const Triangle coarse{place_of(t[0]), place_of(t[1]), place_of(t[2])};
        const VertexId a = layout.original_of(coarse[0]), b = layout.original_of(coarse[1]),
                       c = layout.original_of(coarse[2]);
        if (a != b && b != c && c != a) triangles.push_back(coarse);
    }
    return triangles;
}

}  // namespace vesselbench
