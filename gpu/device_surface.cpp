#include "gpu/device_surface.h"

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "geometry/kernel/edges.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/finite_positions.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/parallel.h"
#include "smoothing/filters/two_rings.h"

namespace vesselbench {

namespace {

using Eigen::Vector4f;

constexpr std::uint32_t kBoundary = 0x80000000;

DeviceRows upload(const Device& device, const CompressedRows& rows, const std::string& label) {
    return {make_storage(device, std::span<const std::uint32_t>(rows.offsets), label + " offsets"),
            make_storage(device, std::span<const std::uint32_t>(rows.values), label)};
}

}  // namespace

DevicePoint device_point(const Vec3& point, const Vec3& centre) {
    const Vec3 place = point - centre;
    const Eigen::Vector3f anchor = place.cast<float>();
    return {anchor, (place - anchor.cast<double>()).cast<float>()};
}

DeviceSurface::DeviceSurface(Device device, Surface surface)
    : device_(std::move(device)), surface_(std::move(surface)) {
    if (surface_.empty()) throw InvalidInput("there is no surface to compute with");
    require_finite(surface_.points());
    centre_ = bounds(surface_).centre();
    std::vector<Vector4f> anchors(vertex_count()), shifts(vertex_count());
    for (std::size_t v = 0; v < anchors.size(); ++v) {
        const DevicePoint point = device_point(surface_.points()[v], centre_);
        anchors[v] << point.anchor, 1.0F;
        shifts[v] << point.shift, 1.0F;
    }
    anchors_ = make_storage(device_, std::span<const Vector4f>(anchors), "anchors");
    shifts_ = make_storage(device_, std::span<const Vector4f>(shifts), "shifts");
}

const Buffer& DeviceSurface::exact() const {
    if (!exact_)
        exact_ = make_storage(device_, std::span<const Vec3>(surface_.points()),
                              "positions in double precision");
    return *exact_;
}

const Buffer& DeviceSurface::triangles() const {
    if (!triangles_) triangles_ = make_storage(device_, surface_.triangles(), "triangles");
    return *triangles_;
}

const DeviceRows& DeviceSurface::triangles_at() const {
    if (!triangles_at_)
        triangles_at_ = upload(device_, surface_.topology->triangles_at(), "triangles at vertices");
    return *triangles_at_;
}

const CompressedRows& DeviceSurface::neighbours(int rings) const {
    if (rings == 1) return surface_.topology->rings();
    if (!two_rings_) two_rings_ = two_rings(*surface_.topology);
    return *two_rings_;
}

void DeviceSurface::forget_neighbours() const {
    if (rings_[1] && anchor_umbrellas_[1]) two_rings_.reset();
}

const DeviceRows& DeviceSurface::rings(int count) const {
    auto& rows = rings_[count == 1 ? 0 : 1];
    if (rows) return *rows;
    rows = upload(device_, neighbours(count),
                  count == 1 ? "neighbours" : "neighbours within two rings");
    forget_neighbours();
    return *rows;
}

const Buffer& DeviceSurface::anchor_umbrellas(int rings) const {
    auto& buffer = anchor_umbrellas_[rings == 1 ? 0 : 1];
    if (buffer) return *buffer;
    const CompressedRows& rows = neighbours(rings);
    Positions anchors(vertex_count());
    for_each_vertex(anchors.size(), [&](std::size_t v) {
        anchors[v] = device_point(surface_.points()[v], centre_).anchor.cast<double>();
    });
    std::vector<Vector4f> umbrellas(vertex_count());
    for_each_vertex(umbrellas.size(), [&](std::size_t v) {
        Vec3 sum = Vec3::Zero();
        for (const VertexId u : rows.row(v)) sum += anchors[u] - anchors[v];
        if (!rows.row(v).empty()) sum /= static_cast<double>(rows.row(v).size());
        umbrellas[v] << sum.cast<float>(), 0.0F;
    });
    buffer = make_storage(device_, std::span<const Vector4f>(umbrellas), "umbrellas");
    forget_neighbours();
    return *buffer;
}

const DeviceRows& DeviceSurface::corners() const {
    if (corners_) return *corners_;
    const CompressedRows& rows = surface_.topology->triangles_at();
    std::vector<std::array<VertexId, 2>> others(rows.values.size());
    for_each_vertex(vertex_count(), [&](std::size_t v) {
        for (std::uint32_t i = rows.offsets[v]; i < rows.offsets[v + 1]; ++i) {
            const Triangle& t = surface_.triangles()[rows.values[i]];
            const std::size_t at = corner_of(t, static_cast<VertexId>(v));
            others[i] = {t[(at + 1) % 3], t[(at + 2) % 3]};
        }
    });
    std::vector<std::uint32_t> offsets = rows.offsets;
    const auto& boundary = surface_.topology->boundary_vertices();
    for (std::size_t v = 0; v < boundary.size(); ++v)
        if (boundary[v] != 0) offsets[v] |= kBoundary;
    corners_ = DeviceRows{
        make_storage(device_, std::span<const std::uint32_t>(offsets), "corner offsets"),
        make_storage(device_, std::span<const std::array<VertexId, 2>>(others), "corners")};
    return *corners_;
}

const Program& DeviceSurface::program(const std::string& name) const {
    const auto made = programs_.find(name);
    if (made != programs_.end()) return made->second;
    return programs_.emplace(name, make_compute_program(device_, name)).first->second;
}

}  // namespace vesselbench
