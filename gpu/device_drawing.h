#pragma once

#include <memory>

#include "gpu/device_surface.h"
#include "gpu/picture.h"
#include "gpu/render/drawn_device_surface.h"
#include "gpu/render/renderer.h"

namespace vesselbench {

/// The appearance of a surface on the device: buffers of a GpuSmoother and a GpuMeter.
struct DeviceState {
    const Buffer& shifts;            ///< positions of its vertices
    const Buffer& normals;           ///< vec4, #V: unit normal and mean curvature [1/mm]
    const Buffer* values = nullptr;  ///< float, #V: values mapped to colours; null: one colour
    double least = 0.0, most = 1.0;  ///< values at the ends of the heated-object scale
};

/// Draws pictures of states of a surface from the buffers they are in: only the picture leaves the
/// device. The surface's context must be current whenever it is used or destroyed.
class DeviceDrawing {
public:
    /// \throw GpuUnavailable if the buffers do not fit
    explicit DeviceDrawing(std::shared_ptr<const DeviceSurface> surface);

    /// A picture of a state, framed as `draw` frames the initial surface.
    /// \param options colours, wires and sharp are ignored
    /// \throw InvalidInput, GpuUnavailable as draw
    [[nodiscard]] Picture picture_of(const DeviceState& state, const PictureOptions& options);

private:
    std::shared_ptr<const DeviceSurface> surface_;
    std::shared_ptr<DrawnDeviceSurface> drawn_;
    Renderer renderer_;
};

}  // namespace vesselbench
