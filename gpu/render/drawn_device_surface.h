#pragma once

#include <memory>

#include "gpu/device_surface.h"
#include "gpu/render/surface_source.h"
#include "gpu/render/vertex_buffers.h"

namespace vesselbench {

/// The appearance of a surface on the device: buffers of a GpuSmoother and a GpuMeter, which must
/// outlive the drawing of them.
struct DeviceBuffers {
    const Buffer* shifts = nullptr;   ///< positions of its vertices
    const Buffer* normals = nullptr;  ///< vec4, #V: unit normal and mean curvature [1/mm]
    const Buffer* values = nullptr;   ///< float, #V: values mapped to colours; null: none
};

/// Draws states of a surface from the buffers they are in: nothing leaves the device. The surface's
/// context must be current whenever it is used or destroyed. Its edges are drawn as lines, and all
/// of it is one patch.
class DrawnDeviceSurface final : public SurfaceSource {
public:
    /// \throw GpuUnavailable if the buffers do not fit
    explicit DrawnDeviceSurface(std::shared_ptr<const DeviceSurface> surface);

    /// The state to draw from now on.
    void show(const DeviceBuffers& buffers) { shown_ = buffers; }

    [[nodiscard]] Sphere bounds() const override { return bounds_; }

    [[nodiscard]] std::size_t triangle_count() const override {
        return surface_->surface().triangle_count();
    }

    [[nodiscard]] bool has_values() const override { return shown_.values != nullptr; }

    [[nodiscard]] bool has_colours() const override { return false; }

    [[nodiscard]] bool is_solid() const override { return solid_; }

    [[nodiscard]] bool has_corners() const override { return false; }

    std::size_t bind_triangles(Detail detail) const override;
    std::size_t bind_edges() const override;

private:
    void bind_vertices() const;

    std::shared_ptr<const DeviceSurface> surface_;
    DeviceBuffers shown_;
    Sphere bounds_;
    bool solid_ = false;
    mutable DrawnEdges edges_;
    VertexArray layout_;
};

}  // namespace vesselbench
