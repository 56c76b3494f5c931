#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "gpu/device_neighbours.h"
#include "gpu/device_surface.h"
#include "gpu/staircase_search.h"
#include "smoothing/context/distance_weights.h"
#include "smoothing/context/staircase_weights.h"
#include "smoothing/context/staircases.h"

namespace vesselbench {

/// Smoothing weights computed on the device that uses them (thesis 5.2, 5.3, 7.2): it detects
/// staircases, excludes caps, finds the distances to staircases (gpu/staircase_search.h) and to
/// neighbours (gpu/device_neighbours.h), and turns distances into weights. The surface's context
/// must be current whenever it is used or destroyed.
class GpuWeights {
public:
    /// All weights 1. \throw GpuUnavailable if the buffers do not fit
    explicit GpuWeights(std::shared_ptr<const DeviceSurface> surface);

    /// Computes the orientation change of every vertex (Eqs. 5.3-5.4), in double precision, so that
    /// the same vertices exceed a threshold as on the CPU. \throw InvalidInput if an axis has no
    /// direction
    void find_orientation_change(const StackAxes& stack_axes);

    /// Reads the orientation changes [-], #V; all 0 before they are computed.
    [[nodiscard]] std::vector<double> orientation_change() const;

    /// Resets all weights to 1.
    void restart();

    /// Multiplies by staircase weights (Eqs. 5.5-5.6) of the orientation changes; caps are no
    /// staircases and get weight 0. Other scalings and values of beta_min need no new search.
    /// Agrees with the CPU's to single precision.
    /// \throw InvalidInput as staircase_weights; GpuUnavailable if the context is lost, a shader
    /// does not compile or a buffer does not fit
    void multiply_staircases(const StaircaseParameters& parameters = {});

    /// Number of staircase vertices, caps excluded, in the last multiply_staircases.
    [[nodiscard]] std::size_t staircase_vertices() const { return staircases_.sources; }

    /// Multiplies by weights from distances to neighbours (5.2, Eq. 5.2).
    /// \throw InvalidInput as distance_weights, or if the distances are not #V
    void multiply_distances(const NeighbourDistances& distances,
                            const DistanceParameters& parameters = {});

    /// Multiplies by other weights in [0, 1]: float, #V.
    void multiply(const Buffer& others);

    /// The weights in [0, 1]: float, #V.
    [[nodiscard]] const Buffer& weights() const { return weights_; }

private:
    struct Search {
        double tau_theta = 0.0, tau_max = 0.0;
        std::vector<std::uint8_t> caps;
        bool operator==(const Search&) const = default;
    };

    void find_staircase_distances(const StaircaseParameters& parameters);
    void multiply(const Buffer& distances, const Buffer& factors, std::span<const float> scale,
                  int kind);

    std::shared_ptr<const DeviceSurface> surface_;
    Buffer changes_, weights_, ones_;
    std::optional<Search> search_;  ///< the input of the next two
    DeviceDistances staircases_;
    Buffer free_of_caps_;
};

}  // namespace vesselbench
