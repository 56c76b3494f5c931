#include "gpu/device_surface.h"

#include <string>
#include <utility>
#include <vector>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/finite_positions.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/parallel.h"
#include "gpu/device_store.h"

namespace vesselbench {

using Eigen::Vector4f;

DevicePoint device_point(const Vec3& point, const Vec3& centre) {
    const Vec3 place = point - centre;
    const Eigen::Vector3f anchor = place.cast<float>();
    return {anchor, (place - anchor.cast<double>()).cast<float>()};
}

DeviceSurface::DeviceSurface(Device device, Surface surface)
    : device_(std::move(device)), surface_(std::move(surface)) {
    if (surface_.empty()) throw InvalidInput("there is no surface to compute with");
    require_finite(surface_.points());
    topology_ = device_.store->topology(device_, surface_.topology);
    centre_ = bounds(surface_).centre();
    std::vector<Vector4f> anchors(vertex_count()), shifts(vertex_count());
    for_each_vertex(anchors.size(), [&](std::size_t place) {
        const DevicePoint point =
            device_point(surface_.points()[order().vertex_at(place)], centre_);
        anchors[place] << point.anchor, 1.0F;
        shifts[place] << point.shift, 1.0F;
    });
    anchors_ = make_storage(device_, std::span<const Vector4f>(anchors), "anchors");
    shifts_ = make_storage(device_, std::span<const Vector4f>(shifts), "shifts");
}

const DeviceTable& DeviceSurface::exact() const {
    if (!exact_) {
        const Positions moved =
            order().is_own() ? Positions() : order().by_place(surface_.points());
        const Positions& points = order().is_own() ? surface_.points() : moved;
        const std::span numbers(points.front().data(), 3 * points.size());
        exact_ = make_table(device_, numbers, wide(), "positions in double precision");
    }
    return *exact_;
}

const Buffer& DeviceSurface::anchor_umbrellas(int rings) const {
    auto& buffer = anchor_umbrellas_[rings == 1 ? 0 : 1];
    if (buffer) return *buffer;
    const CompressedRows& rows = topology_->neighbours(rings);
    Positions anchors(vertex_count());
    for_each_vertex(anchors.size(), [&](std::size_t v) {
        anchors[v] = device_point(surface_.points()[v], centre_).anchor.cast<double>();
    });
    std::vector<Vector4f> umbrellas(vertex_count());
    for_each_vertex(umbrellas.size(), [&](std::size_t v) {
        Vec3 sum = Vec3::Zero();
        for (const VertexId u : rows.row(v)) sum += anchors[u] - anchors[v];
        if (!rows.row(v).empty()) sum /= static_cast<double>(rows.row(v).size());
        umbrellas[order().place_of(v)] << sum.cast<float>(), 0.0F;
    });
    buffer = make_storage(device_, std::span<const Vector4f>(umbrellas), "umbrellas");
    topology_->forget_neighbours();
    return *buffer;
}

const Program& DeviceSurface::program(const std::string& name, bool wide) const {
    return device_.store->program(device_, name, wide);
}

}  // namespace vesselbench
