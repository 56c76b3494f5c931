#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "geometry/kernel/large_array.h"
#include "geometry/kernel/progress.h"
#include "geometry/kernel/topology.h"
#include "smoothing/filters/filter_settings.h"
#include "smoothing/filters/linear_step.h"
#include "smoothing/filters/neighbour_blocks.h"

namespace vesselbench {

/// A running filter whose iterations consist of one or two linear steps. The first step of an
/// iteration reads positions and writes positions, or the input of the second one, whose target
/// holds the positions before the first. The share of the last step is the weights, and the
/// constraint applies to its vertices; the share of an earlier step is 0 at fixed vertices, else 1.
class LinearRun {
public:
    /// Keeps references to the positions and to the settings and their spans.
    /// \param blocks of the neighbours that the settings require; shared by runs on one topology
    /// \throw InvalidInput if the settings do not fit the topology
    LinearRun(const Topology& topology, const Positions& positions,
              std::span<const LinearStep> steps, const FilterSettings& settings,
              std::shared_ptr<const NeighbourBlocks> blocks);

    /// \param moved null, or #V long: receives the positions reached (with 1 iteration or more)
    /// \throw Cancelled; the run must not be used afterwards
    void advance(int iterations, const Progress& progress, Positions* moved = nullptr);

    /// Writes the positions reached [mm], in the order of the vertices.
    void write(Positions& moved) const;

    /// The positions by place, until the next step.
    [[nodiscard]] std::span<const PackRow> packs();

    /// Continues from the state of another run of the same filter on the same surface.
    void continue_from(const LinearRun& other);

private:
    void bring_in(std::size_t block) const;
    void take_step(std::size_t number, std::size_t block) const;
    void bring_out(std::size_t number, std::size_t block, Positions& moved) const;
    [[nodiscard]] std::size_t end_of(std::size_t block) const;
    [[nodiscard]] std::size_t bytes_at_place() const;

    const Positions& positions_;
    const FilterSettings& settings_;
    std::vector<std::uint8_t> fixed_;
    std::shared_ptr<const NeighbourBlocks> blocks_;
    std::vector<LinearStep> steps_;
    bool in_ = false;       ///< the arrays are filled
    std::size_t done_ = 0;  ///< steps
    LargeArray<PackRow> values_[2], start_;
    /// Per-vertex factors, 0 at fixed vertices: for the last step of an iteration, and for the
    /// steps before it. Empty if all are 1.
    LargeArray<double> weights_, free_;
};

/// The blocks for a linear filter with these settings.
[[nodiscard]] std::shared_ptr<const NeighbourBlocks> blocks_for(const Topology& topology,
                                                                const FilterSettings& settings);

/// A LinearRun of all iterations of the settings.
/// \return moved positions in the order of `positions`
/// \throw InvalidInput if the settings do not fit the topology
[[nodiscard]] Positions run_linear_filter(const Topology& topology, const Positions& positions,
                                          std::span<const LinearStep> steps,
                                          const FilterSettings& settings, const Progress& progress);

}  // namespace vesselbench
