#pragma once

#include <map>
#include <optional>
#include <string>

#include "geometry/kernel/surface.h"
#include "gpu/compute.h"

namespace vesselbench {

/// Rows of elements on the device: those of row i stand from offsets[i] to offsets[i + 1].
struct DeviceRows {
    Buffer offsets;  ///< uint, #V + 1
    Buffer values;
};

/// A surface on the device: uploaded once, for every filter and measure there. What only some need
/// is uploaded when it is first asked for.
/// The context that was current when it was made must be current whenever it is used and when it
/// goes. Not for several threads.
class DeviceSurface {
public:
    /// \throw InvalidInput if the surface is empty or a position is not finite; GpuUnavailable if
    /// it does not fit the device
    DeviceSurface(Device device, Surface surface);

    [[nodiscard]] const Device& device() const { return device_; }

    [[nodiscard]] const Surface& surface() const { return surface_; }

    [[nodiscard]] std::size_t vertex_count() const { return surface_.vertex_count(); }

    /// What positions on the device are relative to: the centre of the bounding box [mm].
    [[nodiscard]] const Vec3& centre() const { return centre_; }

    /// Where vertices are on the device is anchor + shift [mm]. Anchors are the surface's positions
    /// in single precision and never change: vec4 with w = 1, #V.
    [[nodiscard]] const Buffer& anchors() const { return anchors_; }

    /// What single precision left out of the surface's own positions [mm]: vec4, #V. States of the
    /// surface have other shifts; theirs are what filters move.
    [[nodiscard]] const Buffer& shifts() const { return shifts_; }

    /// The surface's positions in double precision [mm], for what a threshold decides: 3 doubles,
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

    /// The other corners of the triangles at every vertex, in the triangles' direction: uvec2. The
    /// highest bit of an offset is set where the vertex lies on a boundary.
    [[nodiscard]] const DeviceRows& corners() const;

    /// The compute program of a name, compiled once for everything that works on the surface.
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
    mutable std::optional<CompressedRows> two_rings_;  ///< until both that need it are made
    mutable std::map<std::string, Program> programs_;
};

/// A point relative to a centre, in two numbers of single precision each.
struct DevicePoint {
    Eigen::Vector3f anchor, shift;
};

[[nodiscard]] DevicePoint device_point(const Vec3& point, const Vec3& centre);

}  // namespace vesselbench
