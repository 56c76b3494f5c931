#include "gpu/device_topology.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "geometry/kernel/edges.h"
#include "geometry/kernel/parallel.h"
#include "smoothing/filters/two_rings.h"

namespace vesselbench {

namespace {

using Corner = std::array<VertexId, 2>;

constexpr std::uint32_t kBoundary = 0x80000000;

/// Bound of the largest table of a surface, except its rings of two [bytes]: 3 corners a triangle,
/// or positions in double precision.
std::size_t largest_table(const Topology& topology) {
    return std::max(topology.triangle_count() * 3 * sizeof(Corner),
                    topology.vertex_count() * 3 * sizeof(double));
}

/// Puts the corners of a vertex in the order around it, where they are connected: each begins with
/// the neighbour at which the last one ends.
void connect(std::span<Corner> corners) {
    const auto starts = [&](const Corner& corner) {
        return std::ranges::none_of(corners,
                                    [&](const Corner& other) { return other[1] == corner[0]; });
    };
    // An open fan begins at the boundary; a closed one anywhere.
    const auto first = std::ranges::find_if(corners, starts);
    if (first != corners.end()) std::iter_swap(corners.begin(), first);
    for (std::size_t i = 1; i < corners.size(); ++i) {
        const auto next =
            std::find_if(corners.begin() + static_cast<std::ptrdiff_t>(i), corners.end(),
                         [&](const Corner& c) { return c[0] == corners[i - 1][1]; });
        if (next != corners.end())
            std::iter_swap(corners.begin() + static_cast<std::ptrdiff_t>(i), next);
    }
}

void leave(const DeviceTable& table) {
    table.buffer.leave();
    table.view.leave();
}

}  // namespace

DeviceTopology::DeviceTopology(const Device& device, std::shared_ptr<const Topology> topology)
    : topology_(std::move(topology)),
      order_(device.reorders ? DeviceOrder(*topology_) : DeviceOrder()),
      reorders_(device.reorders),
      largest_block_(device.limits.largest_storage_block),
      wide_(largest_table(*topology_) > largest_block_) {}

bool DeviceTopology::is_of(const Device& device,
                           const std::shared_ptr<const Topology>& topology) const {
    return topology_ == topology && reorders_ == device.reorders &&
           largest_block_ == device.limits.largest_storage_block;
}

DeviceRows DeviceTopology::upload(const Device& device, const CompressedRows& by_vertex,
                                  Values values, const std::string& label) const {
    std::optional<CompressedRows> moved;
    if (!order_.is_own()) {
        moved = order_.rows_by_place(by_vertex);
        if (values == Values::Vertices) moved->values = order_.as_places(std::move(moved->values));
    }
    const CompressedRows& rows = moved ? *moved : by_vertex;
    const bool wide = wide_ || rows.values.size() * sizeof(VertexId) > largest_block_;
    return {make_storage(device, std::span<const std::uint32_t>(rows.offsets), label + " offsets"),
            make_table(device, std::span<const std::uint32_t>(rows.values), wide, label)};
}

const DeviceTable& DeviceTopology::triangles(const Device& device) const {
    if (!triangles_) {
        const auto& triangles = topology_->triangles();
        const std::span words(triangles.front().data(), 3 * triangles.size());
        if (order_.is_own()) {
            triangles_ = make_table(device, words, wide_, "triangles");
        } else {
            const auto places = order_.as_places({words.begin(), words.end()});
            triangles_ = make_table(device, std::span<const VertexId>(places), wide_, "triangles");
        }
    }
    return *triangles_;
}

const DeviceRows& DeviceTopology::triangles_at(const Device& device) const {
    if (!triangles_at_)
        triangles_at_ =
            upload(device, topology_->triangles_at(), Values::Triangles, "triangles at vertices");
    return *triangles_at_;
}

const CompressedRows& DeviceTopology::neighbours(int rings) const {
    if (rings == 1) return topology_->rings();
    if (!two_rings_) two_rings_ = two_rings(*topology_);
    return *two_rings_;
}

void DeviceTopology::forget_neighbours() const {
    if (rings_[1]) two_rings_.reset();
}

const DeviceRows& DeviceTopology::rings(const Device& device, int count) const {
    auto& rows = rings_[count == 1 ? 0 : 1];
    if (!rows)
        rows = upload(device, neighbours(count), Values::Vertices,
                      count == 1 ? "neighbours" : "neighbours within two rings");
    return *rows;
}

const DeviceRows& DeviceTopology::corners(const Device& device) const {
    if (corners_) return *corners_;
    std::optional<CompressedRows> moved;
    if (!order_.is_own()) moved = order_.rows_by_place(topology_->triangles_at());
    const CompressedRows& rows = moved ? *moved : topology_->triangles_at();
    std::vector<Corner> others(rows.values.size());
    for_each_vertex(topology_->vertex_count(), [&](std::size_t place) {
        const std::uint32_t begin = rows.offsets[place], end = rows.offsets[place + 1];
        for (std::uint32_t i = begin; i < end; ++i) {
            const Triangle& t = topology_->triangles()[rows.values[i]];
            const std::size_t at = corner_of(t, order_.vertex_at(place));
            others[i] = {order_.place_of(t[(at + 1) % 3]), order_.place_of(t[(at + 2) % 3])};
        }
        connect(std::span(others).subspan(begin, end - begin));
    });
    std::vector<std::uint32_t> offsets = rows.offsets;
    const auto& boundary = topology_->boundary_vertices();
    for (std::size_t v = 0; v < boundary.size(); ++v)
        if (boundary[v] != 0) offsets[order_.place_of(v)] |= kBoundary;
    corners_ =
        DeviceRows{make_storage(device, std::span<const std::uint32_t>(offsets), "corner offsets"),
                   make_table(device, std::span<const Corner>(others), wide_, "corners")};
    return *corners_;
}

void DeviceTopology::leave() const {
    if (triangles_) vesselbench::leave(*triangles_);
    for (const auto* rows : {&rings_[0], &rings_[1], &corners_, &triangles_at_}) {
        if (!*rows) continue;
        (*rows)->offsets.leave();
        vesselbench::leave((*rows)->values);
    }
}

}  // namespace vesselbench
