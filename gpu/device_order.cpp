#include "gpu/device_order.h"

#include <algorithm>

#include "smoothing/filters/mesh_order.h"

namespace vesselbench {

DeviceOrder::DeviceOrder(const Topology& topology)
    : vertices_(mesh_order(topology)), places_(places_in(vertices_)) {}

std::vector<VertexId> DeviceOrder::as_places(std::vector<VertexId> vertices) const {
    if (!is_own())
        for_each_vertex(vertices.size(),
                        [&](std::size_t i) { vertices[i] = places_[vertices[i]]; });
    return vertices;
}

CompressedRows DeviceOrder::rows_by_place(const CompressedRows& by_vertex) const {
    if (is_own()) return by_vertex;
    CompressedRows rows{{0}, std::vector<std::uint32_t>(by_vertex.values.size())};
    rows.offsets.reserve(by_vertex.offsets.size());
    for (const VertexId v : vertices_)
        rows.offsets.push_back(rows.offsets.back() +
                               static_cast<std::uint32_t>(by_vertex.row(v).size()));
    for_each_vertex(vertices_.size(), [&](std::size_t place) {
        std::ranges::copy(by_vertex.row(vertices_[place]),
                          rows.values.begin() + rows.offsets[place]);
    });
    return rows;
}

}  // namespace vesselbench
