#pragma once

#include <memory>

#include "gpu/canvas.h"
#include "gpu/device_surface.h"

namespace vesselbench {

/// The appearance of a surface on the device: buffers of a GpuSmoother and a GpuMeter.
struct DeviceState {
    const Buffer& shifts;            ///< positions of its vertices
    const Buffer& normals;           ///< vec4, #V: unit normal and mean curvature [1/mm]
    const Buffer* values = nullptr;  ///< float, #V: values mapped to colours; null: one colour
    double least = 0.0, most = 1.0;  ///< values at the ends of the heated-object scale
};

/// Draws states of a surface from the buffers they are in: only the picture leaves the device. For
/// the window and for pictures without one. The surface's context must be current whenever it is
/// used or destroyed.
class DeviceDrawing {
public:
    /// \throw GpuUnavailable if a shader does not compile or the buffers do not fit
    explicit DeviceDrawing(std::shared_ptr<const DeviceSurface> surface);

    /// Draws into the bound framebuffer, with its depth test.
    /// \param camera of positions relative to the surface's centre
    void draw(const DeviceState& state, const Camera& camera) const;

private:
    std::shared_ptr<const DeviceSurface> surface_;
    Program program_;
    VertexArray vertices_;
    Buffer scale_;
};

/// A picture of a state, framed as `draw` frames the initial surface.
/// \param options colours, edges, wires and sharp are ignored
/// \throw InvalidInput, GpuUnavailable as draw
[[nodiscard]] Picture picture_of(const DeviceSurface& surface, const DeviceDrawing& drawing,
                                 const DeviceState& state, const PictureOptions& options);

}  // namespace vesselbench
