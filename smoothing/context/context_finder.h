#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "smoothing/context/caps.h"
#include "smoothing/context/distance_weights.h"
#include "smoothing/context/staircase_weights.h"
#include "smoothing/context/staircases.h"

namespace vesselbench {

/// Staircase weights and their origin.
struct StaircaseContext {
    std::vector<double> weights;  ///< in [0, 1], #V
    std::size_t vertices = 0;     ///< staircase vertices, caps excluded
};

/// Weights of distances to neighbours and their origin.
struct NeighbourContext {
    std::vector<double> weights;     ///< in [0, 1], #V
    double least = 0.0, most = 0.0;  ///< distances [mm]
};

/// Finds the context of one surface (thesis 5.2, 5.3): the interface through which operations use
/// the CPU or another device. Not thread-safe.
class ContextFinder {
public:
    virtual ~ContextFinder() = default;

    /// The surface's caps, as find_caps finds them; computed once.
    [[nodiscard]] const std::vector<Cap>& caps() {
        if (!caps_) caps_ = search_caps();
        return *caps_;
    }

    /// As staircase_weights of orientation_change. \throw InvalidInput as they do
    [[nodiscard]] virtual StaircaseContext staircases(const StackAxes& stack_axes,
                                                      const StaircaseParameters& parameters) = 0;

    /// As distance_weights of neighbour_distances. \throw InvalidInput as they do
    [[nodiscard]] virtual NeighbourContext neighbours(std::span<const Surface> neighbours,
                                                      const DistanceParameters& parameters) = 0;

private:
    [[nodiscard]] virtual std::vector<Cap> search_caps() = 0;

    std::optional<std::vector<Cap>> caps_;
};

/// The finder of smoothing/. Bit-identical for any number of threads.
[[nodiscard]] std::unique_ptr<ContextFinder> make_cpu_finder(Surface surface);

}  // namespace vesselbench
