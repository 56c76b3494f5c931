#pragma once

#include <memory>

#include "gpu/canvas.h"
#include "gpu/device_surface.h"

namespace vesselbench {

/// What a surface on the device looks like: buffers of a GpuSmoother and a GpuMeter.
struct DeviceState {
    const Buffer& shifts;            ///< where its vertices are
    const Buffer& normals;           ///< vec4, #V: unit normal and mean curvature [1/mm]
    const Buffer* values = nullptr;  ///< float, #V: what colours it; null: one colour
    double least = 0.0, most = 1.0;  ///< values at the ends of the heated-object scale
};

/// Draws states of a surface from where they are: nothing leaves the device but the picture. For
/// the window and for pictures without one. The surface's context must be current whenever it is
/// used and when it goes.
class DeviceDrawing {
public:
    /// \throw GpuUnavailable if a shader does not compile or the buffers do not fit
    explicit DeviceDrawing(std::shared_ptr<const DeviceSurface> surface);

    /// Draws into the framebuffer that is bound, with its depth test.
    /// \param camera of positions relative to the surface's centre
    void draw(const DeviceState& state, const Camera& camera) const;

private:
    std::shared_ptr<const DeviceSurface> surface_;
    Program program_;
    VertexArray vertices_;
    Buffer scale_;
};

/// A picture of a state, seen as `draw` sees the surface at its start.
/// \param options colours, edges, wires and sharp do not count
/// \throw InvalidInput, GpuUnavailable as draw
[[nodiscard]] Picture picture_of(const DeviceSurface& surface, const DeviceDrawing& drawing,
                                 const DeviceState& state, const PictureOptions& options);

}  // namespace vesselbench
