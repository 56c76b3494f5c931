#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "geometry/kernel/surface.h"
#include "gpu/compute.h"
#include "gpu/device_topology.h"

namespace vesselbench {

/// A surface on the device: uploaded once, for all filters and measures there. Data that
/// only some of them need is uploaded on first use. What the device has of vertices is in the
/// order of their places (order()). The context that was current at
/// construction must be current whenever the object is used or destroyed. Not
/// thread-safe.
class DeviceSurface {
public:
    /// \throw InvalidInput if the surface is empty or a position is not finite; GpuUnavailable if
    /// it does not fit the device
    DeviceSurface(Device device, Surface surface);

    [[nodiscard]] const Device& device() const { return device_; }

    [[nodiscard]] const Surface& surface() const { return surface_; }

    [[nodiscard]] std::size_t vertex_count() const { return surface_.vertex_count(); }

    [[nodiscard]] const DeviceOrder& order() const { return topology_->order(); }

    /// Origin of positions on the device: the centre of the bounding box [mm].
    [[nodiscard]] const Vec3& centre() const { return centre_; }

    /// A vertex on the device is at anchor + shift [mm]. Anchors are the surface's positions in
    /// single precision and never change: vec4 with w = 1, #V.
    [[nodiscard]] const Buffer& anchors() const { return anchors_; }

    /// Rounding remainder of the surface's own positions in single precision [mm]: vec4, #V. Other
    /// states of the surface have other shifts; filters move shifts.
    [[nodiscard]] const Buffer& shifts() const { return shifts_; }

    /// The surface's positions in double precision [mm], for threshold decisions: 3 doubles,
    /// #V.
    [[nodiscard]] const DeviceTable& exact() const;

    /// Corners of the triangles, which keep their numbers: 3 uint, #T.
    [[nodiscard]] const DeviceTable& triangles() const { return topology_->triangles(device_); }

    /// Triangles at every vertex: uint.
    [[nodiscard]] const DeviceRows& triangles_at() const {
        return topology_->triangles_at(device_);
    }

    /// Uniform umbrella operator of the anchors over 1 or 2 rings [mm]: vec4, #V.
    [[nodiscard]] const Buffer& anchor_umbrellas(int rings) const;

    /// Neighbours within 1 or 2 rings: uint.
    [[nodiscard]] const DeviceRows& rings(int count) const {
        return topology_->rings(device_, count);
    }

    /// The other two corners of the triangles at every vertex, in triangle orientation and, where
    /// connected, in the order around the vertex: uvec2. The highest bit of an offset is set if the
    /// vertex is on a boundary.
    [[nodiscard]] const DeviceRows& corners() const { return topology_->corners(device_); }

    /// True if its tables are read through views (DeviceTable): it is too large for storage blocks.
    [[nodiscard]] bool wide() const { return topology_->wide(); }

    /// The compute program of a name, compiled once for all users of the device, for its tables.
    /// \throw GpuUnavailable as make_compute_program
    [[nodiscard]] const Program& program(const std::string& name) const {
        return program(name, wide());
    }

    /// The same for tables that have views or not.
    [[nodiscard]] const Program& program(const std::string& name, bool wide) const;

private:
    Device device_;
    Surface surface_;
    Vec3 centre_ = Vec3::Zero();
    Buffer anchors_, shifts_;
    std::shared_ptr<const DeviceTopology> topology_;
    mutable std::optional<Buffer> anchor_umbrellas_[2];
    mutable std::optional<DeviceTable> exact_;
};

/// Reads values at the vertices, from the order they have on the device into their own.
/// \throw GpuUnavailable as read_storage
template <class T>
[[nodiscard]] std::vector<T> read_vertices(const DeviceSurface& surface, const Buffer& buffer) {
    return surface.order().by_vertex(
        read_storage<T>(surface.device(), buffer, surface.vertex_count()));
}

/// A buffer of values at the vertices, given in their own order. \throw GpuUnavailable as
/// make_storage
template <class T>
[[nodiscard]] Buffer make_vertices(const DeviceSurface& surface, std::vector<T> values,
                                   const std::string& label) {
    const std::vector<T> by_place = surface.order().by_place(std::move(values));
    return make_storage(surface.device(), std::span<const T>(by_place), label);
}

/// A point relative to a centre, as two single-precision numbers per coordinate.
struct DevicePoint {
    Eigen::Vector3f anchor, shift;
};

[[nodiscard]] DevicePoint device_point(const Vec3& point, const Vec3& centre);

}  // namespace vesselbench
