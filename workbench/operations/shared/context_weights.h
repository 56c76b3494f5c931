#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "smoothing/context/context_finder.h"
#include "workbench/case/operation.h"

namespace vesselbench {

// Weights from a surface's context (thesis 5.2, 5.3): staircases, neighbours, paint. A weight is
// the fraction of an operation's effect on a vertex; 1 is all of it.

/// The words of a weighted operation for help texts.
struct WeighedAction {
    std::string doing;           ///< "smoothing"
    std::string staircase_help;  ///< of the flag `staircase`
    std::string kept;            ///< effect of weight 0 on vertices: "do not move"
    std::string painted_one;     ///< effect of weight 1 on vertices: "are smoothed in full"
};

/// staircase, stack_axis, tau_theta, tau_max
[[nodiscard]] std::vector<Parameter> staircase_parameter_table(const WeighedAction& action);

/// distance, combine, neighbours, margin, omega, painted
[[nodiscard]] std::vector<Parameter> distance_parameter_table(const WeighedAction& action);

/// Settings not covered by the arguments above.
struct WeightSettings {
    std::string operation;           ///< named in error texts
    double beta_min = 0.0;           ///< weight outside staircases, in [0, 1] [-]
    double cap_weight = 0.0;         ///< of caps, which are no staircases, in [0, 1] [-]
    bool thesis_scaling = false;     ///< Eq. 5.5 as printed
    std::vector<std::uint8_t> caps;  ///< 1 at their vertices, #V
};

/// Findings on the context; none: not asked for.
struct ContextFigures {
    std::optional<double> stack_axis_confidence;  ///< of an estimate, in [0, 1] [-]
    std::string stack_axis_from;     ///< "argument", "image" or "estimate"; may be empty
    std::optional<Vec3> stack_axis;  ///< none although it comes from somewhere: all three
    std::map<std::string, std::string> decisions;  ///< on staircases: by argument, with the reason
    std::optional<std::size_t> staircase_vertices;
    std::optional<double> mean_weight_staircase;        ///< [-]
    std::optional<double> smallest_neighbour_distance;  ///< [mm]
    std::optional<double> largest_neighbour_distance;   ///< [mm]
    std::optional<double> mean_weight_distance;         ///< [-]
    std::optional<double> mean_weight_painted;          ///< [-]
    std::optional<double> mean_weight;                  ///< of all together [-]

    bool operator==(const ContextFigures&) const = default;
};

/// The figures in an operation's report; those that are none are left out.
[[nodiscard]] nlohmann::ordered_json context_json(const ContextFigures& figures);

/// Weights and what was found on the way.
struct ContextWeights {
    std::vector<double> weights;                         ///< #V; empty: 1 everywhere
    std::optional<StackAxes> stack_axes = std::nullopt;  ///< of the staircases, if they count
    ContextFigures figures = {};
};

/// How the weights of staircases and of distances to neighbours are combined (thesis 5.6).
enum class Combination { Multiply, Average };

[[nodiscard]] Combination combination_from(const Arguments& arguments);

[[nodiscard]] inline double combined_weight(double a, double b, Combination how) {
    return how == Combination::Average ? 0.5 * (a + b) : a * b;
}

/// All weights that the arguments request, combined, times the painted ones; fills in its decisions
/// (stack_axis, tau_theta, tau_max, neighbours).
/// \param finder of the scene's surface
/// \throw UsageError if arguments make no sense; InvalidInput if the scene lacks something they
/// name; AlgorithmFailure if the stack orientation is uncertain
[[nodiscard]] ContextWeights context_weights(const Scene& scene, const WeightSettings& settings,
                                             ContextFinder& finder, Arguments& arguments);

/// Fills in these decisions without the weights.
/// \param operation named in error texts
/// \throw as context_weights()
void decide_weights(const Scene& scene, const std::string& operation, ContextFinder& finder,
                    Arguments& arguments);

/// The reason if the weights are 0 on the whole surface: thresholds that find no staircase, or a
/// margin that covers everything; else none.
/// \param figures, resolved after context_weights
[[nodiscard]] std::optional<Diagnostic> why_all_is_kept(const ContextFigures& figures,
                                                        const Arguments& resolved);

/// Distance of every position from one neighbour [mm]; 0 inside a closed one.
[[nodiscard]] std::vector<double> distances_from_neighbour(const Surface& neighbour,
                                                           const Positions& positions);

/// The same, negative inside a closed neighbour [mm].
[[nodiscard]] std::vector<double> signed_distances_from_neighbour(const Surface& neighbour,
                                                                  const Positions& positions);

/// Smallest distance of a position from a neighbour [mm]; 0 inside.
/// \throw AlgorithmFailure if there is no neighbour, or one without triangles
[[nodiscard]] double smallest_neighbour_distance(const Scene& scene, const Arguments& arguments,
                                                 const std::string& operation,
                                                 const Positions& positions);

}  // namespace vesselbench
