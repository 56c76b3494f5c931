#pragma once

#include <memory>
#include <optional>

#include "geometry/kernel/surface.h"
#include "gpu/compute.h"
#include "gpu/device_order.h"

namespace vesselbench {

/// The connectivity of surfaces on a device, shared by those with the same topology. Each table is
/// uploaded on first use. Context and threads as DeviceSurface.
class DeviceTopology {
public:
    /// \param device shares the object that belongs to DeviceStore
    DeviceTopology(const Device& device, std::shared_ptr<const Topology> topology);

    /// True if it is this topology's, for devices with these limits and this order.
    [[nodiscard]] bool is_of(const Device& device,
                             const std::shared_ptr<const Topology>& topology) const;

    /// True if tables of the surface exceed the largest storage block; then all have views.
    [[nodiscard]] bool wide() const { return wide_; }

    [[nodiscard]] const DeviceOrder& order() const { return order_; }

    /// As DeviceSurface. \throw GpuUnavailable if they do not fit
    [[nodiscard]] const DeviceTable& triangles(const Device& device) const;
    [[nodiscard]] const DeviceRows& triangles_at(const Device& device) const;
    [[nodiscard]] const DeviceRows& rings(const Device& device, int count) const;
    [[nodiscard]] const DeviceRows& corners(const Device& device) const;

    /// Neighbours of every vertex within 1 or 2 rings, on the CPU.
    [[nodiscard]] const CompressedRows& neighbours(int rings) const;

    /// Frees those within 2 rings on the CPU, if the device has them.
    void forget_neighbours() const;

    /// Does not delete what it has, because its context is gone.
    void leave() const;

private:
    enum class Values { Vertices, Triangles };

    [[nodiscard]] DeviceRows upload(const Device& device, const CompressedRows& by_vertex,
                                    Values values, const std::string& label) const;

    std::shared_ptr<const Topology> topology_;
    DeviceOrder order_;
    bool reorders_;
    std::size_t largest_block_;
    bool wide_;
    mutable std::optional<DeviceTable> triangles_;
    mutable std::optional<DeviceRows> rings_[2], corners_, triangles_at_;
    mutable std::optional<CompressedRows> two_rings_;
};

}  // namespace vesselbench
