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

/// A filter on its way whose iterations are one or two linear steps. The first step of an iteration
/// reads positions and writes them, or what the second needs; the second one's target are the
/// positions before the first. The last step's share is the weights, whose vertices the constraint
/// keeps in their cells; an earlier step's is 0 at fixed vertices, else 1.
class LinearRun {
public:
    /// Keeps references to the positions and to the settings and their spans.
    /// \param blocks of the neighbours that the settings ask for; shared by runs on one topology
    /// \throw InvalidInput if the settings do not fit the topology
    LinearRun(const Topology& topology, const Positions& positions,
              std::span<const LinearStep> steps, const FilterSettings& settings,
              std::shared_ptr<const NeighbourBlocks> blocks);

    /// \param moved null, or #V long: gets the positions reached (with 1 iteration or more)
    /// \throw Cancelled; the run is of no use then
    void advance(int iterations, const Progress& progress, Positions* moved = nullptr);

    /// Writes the positions reached [mm], in the order of the vertices.
    void write(Positions& moved) const;

    /// The positions by place, until the next step.
    [[nodiscard]] std::span<const PackRow> packs();

    /// Goes on from where another run of the same filter on the same surface is.
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
    /// Per-vertex factors, 0 at fixed vertices: of the last step of an iteration, and of those
    /// before it. Empty where all are 1.
    LargeArray<double> weights_, free_;
};

/// The blocks that a linear filter with these settings works on.
[[nodiscard]] std::shared_ptr<const NeighbourBlocks> blocks_for(const Topology& topology,
                                                                const FilterSettings& settings);

/// A LinearRun of all iterations of the settings.
/// \return moved positions in the order of `positions`
/// \throw InvalidInput if the settings do not fit the topology
[[nodiscard]] Positions run_linear_filter(const Topology& topology, const Positions& positions,
                                          std::span<const LinearStep> steps,
                                          const FilterSettings& settings, const Progress& progress);

}  // namespace vesselbench
