#pragma once

#include <map>
#include <optional>
#include <string>

#include "geometry/kernel/surface.h"
#include "gpu/compute.h"

namespace vesselbench {

/// Rows of elements on the device: row i spans offsets[i] to offsets[i + 1].
struct DeviceRows {
    Buffer offsets;  ///< uint, #V + 1
    Buffer values;
};

/// A surface on the device: uploaded once, for all filters and measures there. Data that
/// only some of them need is uploaded on first use. The context that was current at
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
    [[nodiscard]] const Buffer& exact() const;

    /// Corners of the triangles: 3 uint, #T.
    [[nodiscard]] const Buffer& triangles() const;

    /// Triangles at every vertex: uint.
    [[nodiscard]] const DeviceRows& triangles_at() const;

    /// Uniform umbrella operator of the anchors over 1 or 2 rings [mm]: vec4, #V.
    [[nodiscard]] const Buffer& anchor_umbrellas(int rings) const;

    /// Neighbours within 1 or 2 rings: uint.
    [[nodiscard]] const DeviceRows& rings(int count) const;

    /// The other two corners of the triangles at every vertex, in triangle orientation: uvec2. The
    /// highest bit of an offset is set if the vertex is on a boundary.
    [[nodiscard]] const DeviceRows& corners() const;

    /// The compute program of a name, compiled once for all users of the surface.
    /// \throw GpuUnavailable as make_compute_program
    [[nodiscard]] const Program& program(const std::string& name) const;

private:
    const CompressedRows& neighbours(int rings) const;
    void forget_neighbours() const;

    Device device_;
    Surface surface_;
    Vec3 centre_ = Vec3::Zero();
    Buffer anchors_, shifts_;
    mutable std::optional<DeviceRows> rings_[2], corners_, triangles_at_;
    mutable std::optional<Buffer> anchor_umbrellas_[2], exact_, triangles_;
    mutable std::optional<CompressedRows> two_rings_;  ///< until both its users are built
    mutable std::map<std::string, Program> programs_;
};

/// A point relative to a centre, as two single-precision numbers per coordinate.
struct DevicePoint {
    Eigen::Vector3f anchor, shift;
};

[[nodiscard]] DevicePoint device_point(const Vec3& point, const Vec3& centre);

}  // namespace vesselbench
