#include "gpu/gpu_context_finder.h"

#include <utility>

#include "gpu/device_caps.h"
#include "gpu/gpu_weights.h"

namespace vesselbench {

namespace {

class GpuFinder final : public ContextFinder {
public:
    explicit GpuFinder(std::shared_ptr<const DeviceSurface> surface)
        : surface_(std::move(surface)) {}

    [[nodiscard]] StaircaseContext staircases(const StackAxes& stack_axes,
                                              const StaircaseParameters& parameters) override {
        GpuWeights weights(surface_);
        weights.find_orientation_change(stack_axes);
        weights.multiply_staircases(parameters);
        return {read(weights), weights.staircase_vertices()};
    }

    [[nodiscard]] NeighbourContext neighbours(std::span<const Surface> neighbours,
                                              const DistanceParameters& parameters) override {
        const NeighbourDistances distances = find_neighbour_distances(*surface_, neighbours);
        GpuWeights weights(surface_);
        weights.multiply_distances(distances, parameters);
        return {read(weights), distances.least, distances.most};
    }

private:
    [[nodiscard]] std::vector<Cap> search_caps() override { return find_caps(*surface_); }

    /// An operation multiplies weights by painted ones and reports their means.
    [[nodiscard]] std::vector<double> read(const GpuWeights& weights) const {
        const auto found = read_vertices<float>(*surface_, weights.weights());
        return {found.begin(), found.end()};
    }

    std::shared_ptr<const DeviceSurface> surface_;
};

}  // namespace

std::unique_ptr<ContextFinder> make_gpu_finder(std::shared_ptr<const DeviceSurface> surface) {
    return std::make_unique<GpuFinder>(std::move(surface));
}

}  // namespace vesselbench
