#pragma once

#include <memory>
#include <vector>

#include "gpu/device_surface.h"
#include "smoothing/quality/surface_meter.h"

namespace vesselbench {

/// The effect of smoothing on a surface, in a few numbers (thesis 6.4-6.5).
struct DeviceMeasures {
    QualityMeasures quality;
    double largest_error = 0.0;  ///< largest local error [mm]
};

/// Measures states of a surface on the device, where their positions are: only a few numbers are
/// read back, on request. The measures are those of smoothing/quality/surface_meter.h, in single
/// precision; sums have a fixed order. The surface's context must be current whenever it is used or
/// destroyed.
class GpuMeter {
public:
    /// \param states number of states that can be measured before their numbers are read
    /// \param planes measures quality.error_thesis too
    /// \throw GpuUnavailable if a shader does not compile or the buffers do not fit
    explicit GpuMeter(std::shared_ptr<const DeviceSurface> surface, std::size_t states = 1,
                      bool planes = false);

    /// Makes every vertex its own reference again, as at the start of smoothing.
    void restart();

    /// Updates the reference neighbourhoods to a state and measures it, as number `state`.
    /// \param shifts of its vertices (DeviceSurface)
    /// \pre state is below the number of states
    void measure(const Buffer& shifts, std::size_t state = 0);

    /// References of another run: every vertex its own.
    [[nodiscard]] PooledBuffer make_references() const { return copy_of(own_references_); }

    /// A copy of a run's references.
    [[nodiscard]] PooledBuffer copy_of(const Buffer& references) const;

    /// Updates a run's references to its vertices, without measuring.
    void follow(const Buffer& shifts, const Buffer& references);

    /// Measures a state with the references of its run.
    /// \param follow updates them first, permanently
    void measure(const Buffer& shifts, const Buffer& references, bool follow,
                 std::size_t state = 0);

    /// Unit vertex normals and mean curvature only, for drawing.
    void measure_shape(const Buffer& shifts);

    /// Waits for the device and reads the numbers of the first states.
    /// \throw GpuUnavailable if the context was lost
    [[nodiscard]] std::vector<DeviceMeasures> read(std::size_t states = 1) const;

    /// Of the last state measured: unit vertex normal, and w the mean curvature [1/mm]; vec4, #V.
    [[nodiscard]] const Buffer& normals() const { return normals_; }

    /// Of the last state measured: local error [mm]; float, #V.
    [[nodiscard]] const Buffer& errors() const { return errors_; }

private:
    void find_shape(const Buffer& shifts, Then then);
    void find_error(const Buffer& shifts, const Buffer& references, bool follow);
    void add_rims(const Buffer& shifts);
    void total(const Buffer& parts, std::size_t count, std::size_t place, Then then);

    std::shared_ptr<const DeviceSurface> surface_;
    bool planes_;
    Buffer own_references_, references_, normals_, errors_, shape_parts_, error_parts_, results_;
    DeviceRows rims_;  ///< vertices of each boundary loop: uint
    std::size_t rim_count_ = 0;
};

}  // namespace vesselbench
