#include "smoothing/context/context_finder.h"

#include <algorithm>
#include <utility>

namespace vesselbench {

namespace {

class CpuFinder final : public ContextFinder {
public:
    explicit CpuFinder(Surface surface) : surface_(std::move(surface)) {}

    [[nodiscard]] StaircaseContext staircases(const StackAxes& stack_axes,
                                              const StaircaseParameters& parameters) override {
        const auto change = orientation_change(faces(), stack_axes);
        StaircaseContext found;
        found.weights =
            staircase_weights(*surface_.topology, surface_.points(), change, parameters);
        for (std::size_t v = 0; v < change.size(); ++v) {
            const bool cap = !parameters.caps.empty() && parameters.caps[v] != 0;
            found.vertices += change[v] > parameters.tau_theta && !cap ? 1 : 0;
        }
        return found;
    }

    [[nodiscard]] NeighbourContext neighbours(std::span<const Surface> neighbours,
                                              const DistanceParameters& parameters) override {
        keep_distances(neighbours);
        const auto [least, most] = std::ranges::minmax(distances_);
        return {distance_weights(distances_, parameters), least, most};
    }

private:
    /// Only other neighbours have other distances, whatever is made of them.
    void keep_distances(std::span<const Surface> neighbours) {
        std::vector<std::shared_ptr<const Positions>> asked;
        for (const Surface& neighbour : neighbours) asked.push_back(neighbour.positions);
        if (!distances_.empty() && asked == neighbours_) return;
        distances_ = neighbour_distances(surface_.points(), neighbours);
        neighbours_ = std::move(asked);
    }

    [[nodiscard]] std::vector<Cap> search_caps() override {
        if (surface_.empty()) return {};
        return find_caps(faces());
    }

    /// Detection of staircases and caps share them.
    [[nodiscard]] const AreaNormals& faces() {
        if (!faces_) faces_.emplace(surface_, AreaNormals::When::Ahead);
        return *faces_;
    }

    const Surface surface_;
    std::optional<AreaNormals> faces_;                          ///< refers to the surface
    std::vector<std::shared_ptr<const Positions>> neighbours_;  ///< those of the distances
    std::vector<double> distances_;                             ///< #V; empty: not known
};

}  // namespace

std::unique_ptr<ContextFinder> make_cpu_finder(Surface surface) {
    return std::make_unique<CpuFinder>(std::move(surface));
}

}  // namespace vesselbench
