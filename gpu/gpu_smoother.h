#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "geometry/kernel/progress.h"
#include "gpu/device_surface.h"
#include "smoothing/filters/filter.h"
#include "smoothing/filters/linear_step.h"

namespace vesselbench {

/// Runs the filters of smoothing/ on the device: a surface, weights, fixed vertices and constraint
/// are uploaded once, and positions stay on the device between iterations until they are read. Same
/// filters, parameters and meaning as apply_filter; single precision. The surface's context must be
/// current whenever it is used or destroyed.
class GpuSmoother {
public:
    /// \param settings `iterations` is ignored
    /// \throw InvalidInput if the settings do not fit the surface; GpuUnavailable if it does not
    /// fit the device
    GpuSmoother(std::shared_ptr<const DeviceSurface> surface, const FilterSettings& settings);

    /// An independent copy in the same state.
    [[nodiscard]] GpuSmoother copy() const;

    /// Another one of the same surface, settings and weights, to be started.
    [[nodiscard]] GpuSmoother another() const;

    /// Sets other weights in [0, 1] for the runs that start from now on: float, #V.
    void set_weights(const Buffer& weights);

    /// The same from weights on the CPU. \throw InvalidInput unless they are #V in [0, 1]
    void set_weights(std::span<const double> weights);

    /// Uploads weights for set_weights: float, #V. \throw InvalidInput unless they are #V in [0,
    /// 1]; GpuUnavailable if they do not fit the device
    [[nodiscard]] static Buffer upload_weights(const DeviceSurface& surface,
                                               std::span<const double> weights);

    /// Resets all vertices to the start, for a filter.
    /// \throw InvalidInput as the filter; GpuUnavailable if a shader does not compile
    void start(const FilterParameters& parameters);

    /// Continues for some iterations; start() must have been called.
    /// \throw Cancelled; GpuUnavailable if the context was lost
    void run(int iterations, const Progress& progress = {});

    /// Iterations since start().
    [[nodiscard]] int iterations_done() const { return iterations_done_; }

    /// Waits for the device and reads the positions [mm]; vertices that did not move get the bits
    /// of their start.
    /// \throw GpuUnavailable if the context was lost or a command failed; AlgorithmFailure if the
    /// filter diverges (require_bounded)
    [[nodiscard]] Positions positions() const;

    /// Shifts of the vertices (DeviceSurface), for drawing and measuring.
    [[nodiscard]] const Buffer& shifts() const { return values_[steps_done_ % 2]; }

private:
    GpuSmoother() = default;

    /// A pass over all vertices: a program and the values of its uniforms.
    struct Pass {
        const Program* program = nullptr;
        std::array<double, 4> factors = {};
        double feature_curvature = 0.0;  ///< anisotropic smoothing [1/mm]
        int onto = 0;
        bool of_positions = true;  ///< the source holds shifts, not differences of shifts
        bool by_corners = false;   ///< reads triangles instead of neighbours
    };

    void plan(const LaplaceParameters& parameters);
    void plan(const LaplaceHcParameters& parameters);
    void plan(const TaubinParameters& parameters);
    void plan(const MeanCurvatureFlowParameters& parameters);
    void plan(const AnisotropicParameters& parameters);
    void plan(const CurvatureTriggeredParameters& parameters);
    void plan_linear(const std::vector<LinearStep>& steps);
    void find_first_iterations(double trigger);
    [[nodiscard]] const Program& ring_program(const char* name) const;
    void run_pass(const Pass& pass, bool last);
    static void set_constraint(const PositionConstraint& constraint);

    std::shared_ptr<const DeviceSurface> surface_;
    int rings_ = 1;
    std::optional<PositionConstraint> constraint_;
    /// The surface's shifts; w is the weight, or -1 if fixed.
    std::shared_ptr<const PooledBuffer> start_;
    PooledBuffer values_[2];  ///< read and written alternately
    PooledBuffer first_iterations_;
    std::vector<Pass> passes_;
    std::size_t steps_done_ = 0;
    int iterations_done_ = 0;
};

}  // namespace vesselbench
