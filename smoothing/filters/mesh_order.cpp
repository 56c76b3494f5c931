#include "smoothing/filters/mesh_order.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace vesselbench {

namespace {

/// Breadth-first search; appends the component of `start` to `order`.
void append_component(const CompressedRows& rows, VertexId start, std::vector<std::uint8_t>& seen,
                      std::vector<VertexId>& order) {
    std::size_t next = order.size();
    seen[start] = 1;
    order.push_back(start);
    for (; next < order.size(); ++next)
        for (const VertexId u : rows.row(order[next]))
            if (!seen[u]) {
                seen[u] = 1;
                order.push_back(u);
            }
}

std::size_t bandwidth_of(const Topology& topology) {
    std::size_t band = 0;
    for (const Triangle& triangle : topology.triangles()) {
        const auto [least, most] = std::ranges::minmax(triangle);
        band = std::max<std::size_t>(band, most - least);
    }
    return band;
}

}  // namespace

bool follows_mesh(std::size_t bandwidth, std::size_t vertex_count) {
    // any sensible numbering has a band at most this wide
    return bandwidth <=
           2048 + 8 * static_cast<std::size_t>(std::sqrt(static_cast<double>(vertex_count)));
}

/// Starts every component at one of its ends: the vertex that a first search reaches last.
std::vector<VertexId> order_along_mesh(const CompressedRows& neighbours) {
    const std::size_t count = neighbours.offsets.empty() ? 0 : neighbours.offsets.size() - 1;
    std::vector<VertexId> order, trial;
    order.reserve(count);
    std::vector<std::uint8_t> seen(count, 0), tried(count, 0);
    for (VertexId v = 0; v < count; ++v) {
        if (seen[v]) continue;
        trial.clear();
        append_component(neighbours, v, tried, trial);
        append_component(neighbours, trial.back(), seen, order);
    }
    return order;
}

std::vector<VertexId> places_in(const std::vector<VertexId>& order) {
    std::vector<VertexId> places(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) places[order[i]] = static_cast<VertexId>(i);
    return places;
}

std::vector<VertexId> mesh_order(const Topology& topology) {
    if (follows_mesh(bandwidth_of(topology), topology.vertex_count())) return {};
    return order_along_mesh(topology.rings());
}

}  // namespace vesselbench
