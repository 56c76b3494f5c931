#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "smoothing/context/context_finder.h"
#include "smoothing/filters/position_constraint.h"
#include "workbench/case/operation.h"
#include "workbench/operations/shared/context_weights.h"

namespace vesselbench {

/// The context parameters of `smooth`.
[[nodiscard]] std::vector<Parameter> context_parameter_table();

/// Those arguments on which the context depends.
[[nodiscard]] Arguments context_arguments(const Arguments& arguments);

/// The arguments among these that are parameters of a table.
[[nodiscard]] Arguments arguments_in(const std::vector<Parameter>& table,
                                     const Arguments& arguments);

/// Findings on a context.
struct SmoothingFigures {
    std::size_t caps = 0;
    std::size_t cap_vertices_kept = 0;
    ContextFigures weights;

    bool operator==(const SmoothingFigures&) const = default;
};

/// The context of a surface before it is smoothed.
struct SmoothingContext {
    std::shared_ptr<const Positions> start;  ///< the surface's, or with domed caps (caps=round)
    std::vector<double> weights;             ///< all of them combined, #V; empty: 1 everywhere
    std::vector<std::uint8_t> caps;          ///< 1 at their vertices, #V
    std::vector<std::uint8_t> fixed;         ///< caps that are kept, #V
    std::optional<PositionConstraint> constraint;
    bool caps_rounded = false;            ///< they become domes, and are smoothed in full
    bool thesis_scaling = false;          ///< of staircase weights: Eq. 5.5 as printed
    std::optional<StackAxes> stack_axes;  ///< of the staircases; none: they do not count
    SmoothingFigures figures;

    /// Weight of the caps' vertices, whatever else weighs on them.
    [[nodiscard]] double cap_weight() const { return caps_rounded ? 1.0 : 0.0; }
};

/// Fills in the decisions of smoothing_context() without its weights.
/// \throw as smoothing_context()
void decide_context(const Scene& scene, ContextFinder& finder, Arguments& arguments);

/// Computes weights, fixed vertices and constraint, and fills in the decisions (stack_axis,
/// tau_theta, tau_max, neighbours, cell).
/// \param finder of the scene's surface
/// \throw UsageError if arguments cannot be combined; InvalidInput if the scene lacks something
/// they name; AlgorithmFailure if the stack orientation is uncertain
[[nodiscard]] SmoothingContext smoothing_context(const Scene& scene, ContextFinder& finder,
                                                 Arguments& arguments);

}  // namespace vesselbench
