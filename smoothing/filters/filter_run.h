#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "smoothing/filters/filter.h"
#include "smoothing/filters/linear_step.h"

namespace vesselbench {

/// Shared by all filter runs on one surface; made once.
struct FilterGround {
    std::shared_ptr<const Topology> topology;
    std::shared_ptr<const Positions> start;  ///< [mm], #V
    std::vector<std::uint8_t> fixed;         ///< 1 where a vertex stays, #V; empty: none
    std::optional<PositionConstraint> constraint;
    bool keep_boundary = true;
    int rings = 1;
};

/// A filter run that can be stopped after any iteration, inspected and continued: after n
/// iterations, in any portions, it has the positions that apply_filter gives for n, bit for bit. A
/// copy continues independently from the same state.
class FilterRun {
public:
    class Ground;  ///< a FilterGround and the neighbour arrays of the linear filters

    /// \throw InvalidInput if a length does not fit
    [[nodiscard]] static std::shared_ptr<const Ground> prepare(FilterGround ground);

    /// \param weights in [0, 1] on the displacements, #V; null: 1 everywhere
    /// \throw InvalidInput as the filter
    FilterRun(std::shared_ptr<const Ground> ground, const FilterParameters& parameters,
              std::shared_ptr<const std::vector<double>> weights = nullptr);
    FilterRun(const FilterRun& other);
    FilterRun& operator=(const FilterRun&) = delete;
    ~FilterRun();

    /// \throw Cancelled; the run must not be used afterwards
    void advance(int iterations, const Progress& progress = {});

    [[nodiscard]] int iterations() const { return iterations_; }

    /// Writes the positions [mm], #V.
    void write_positions(Positions& positions) const;

    /// The positions by place, four numbers each, valid until the run continues. order_of its
    /// ground gives the vertex at every place. Fixed vertices may have -0 for 0 here.
    [[nodiscard]] std::span<const PackRow> packs();

    [[nodiscard]] static const FilterGround& ground_of(const Ground& ground);

    /// The vertex at every place; empty: places are vertices.
    [[nodiscard]] static std::span<const VertexId> order_of(const Ground& ground);

private:
    struct Linear;
    void pack_now();

    std::shared_ptr<const Ground> ground_;
    FilterParameters parameters_;
    std::shared_ptr<const std::vector<double>> weights_;
    std::unique_ptr<Linear> linear_;  ///< of linear filters, else null
    Positions now_;                   ///< of other filters
    std::vector<PackRow> packs_;      ///< of other filters
    int iterations_ = 0;
};

}  // namespace vesselbench
