#pragma once

#include <utility>
#include <vector>

#include "geometry/kernel/parallel.h"
#include "geometry/kernel/topology.h"

namespace vesselbench {

/// The order of a surface's vertices on the device, in which neighbours are close to each other in
/// memory: their own if it follows the mesh, else along the mesh (smoothing/filters/mesh_order.h).
/// A vertex's number there is its place; the order of its neighbours and triangles stays.
class DeviceOrder {
public:
    /// Their own.
    DeviceOrder() = default;
    explicit DeviceOrder(const Topology& topology);

    /// True if places are vertices.
    [[nodiscard]] bool is_own() const { return vertices_.empty(); }

    [[nodiscard]] VertexId vertex_at(std::size_t place) const {
        return is_own() ? static_cast<VertexId>(place) : vertices_[place];
    }

    [[nodiscard]] VertexId place_of(std::size_t vertex) const {
        return is_own() ? static_cast<VertexId>(vertex) : places_[vertex];
    }

    /// Values at the vertices, in the order of their places.
    template <class T>
    [[nodiscard]] std::vector<T> by_place(std::vector<T> by_vertex) const {
        return moved(std::move(by_vertex), vertices_);
    }

    /// Values at the places, in the order of their vertices.
    template <class T>
    [[nodiscard]] std::vector<T> by_vertex(std::vector<T> by_place) const {
        return moved(std::move(by_place), places_);
    }

    /// Vertex numbers as places.
    [[nodiscard]] std::vector<VertexId> as_places(std::vector<VertexId> vertices) const;

    /// Rows of the vertices, in the order of their places, with the same values.
    [[nodiscard]] CompressedRows rows_by_place(const CompressedRows& by_vertex) const;

private:
    template <class T>
    [[nodiscard]] static std::vector<T> moved(std::vector<T> values,
                                              const std::vector<VertexId>& from) {
        if (from.empty()) return values;
        std::vector<T> result(values.size());
        for_each_vertex(result.size(), [&](std::size_t i) { result[i] = values[from[i]]; });
        return result;
    }

    std::vector<VertexId> vertices_, places_;  ///< empty: their own order
};

}  // namespace vesselbench
