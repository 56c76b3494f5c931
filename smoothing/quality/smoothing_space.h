#pragma once

#include <optional>

#include "smoothing/quality/search.h"

namespace vesselbench {

/// The space of a search for smoothing parameters.
struct SmoothingSpaceOptions {
    FilterParameters filter;  ///< with the values of the fixed parameters
    std::shared_ptr<const std::vector<double>> weights = nullptr;  ///< fixed; null: all 1
    /// Set: graphs vary tau_theta, tau_max and beta_min, too (7.2). A search keeps them: its score
    /// falls with the curvature of all the surface, so it would smooth everywhere (beta_min 1). Of
    /// Laplace+HC it searches the iterations only. alpha stays as given: it pulls to the original
    /// positions, which are the staircases, and the score's error, measured from them, rewards
    /// that. beta is the least possible: with the same effect on the shape, few strong iterations
    /// remove more of the steps than many weak ones. The score weighs the volume more.
    StaircaseWeights staircase = nullptr;
    bool engine_weighs = false;  ///< SmoothingEngine::weighs_staircases
    double slice = 1.0;          ///< distance of the image's slices; scales tau_max [mm]
    int most_iterations = 50;
    bool all_parameters = false;  ///< also those that the search does not vary: for graphs
    bool mu_stays = false;        ///< Taubin: mu does not follow lambda
};

/// The grid of a filter's parameters: weights in steps of 0.05, iterations in steps of 1, coarsely
/// 0.1 (0.2 with more than two parameters) and 5. Laplace+HC searches alpha and beta, Taubin lambda
/// with mu = -1.02 lambda (mu separately in graphs), the others lambda. Sets with which the filter
/// would amplify some bumps are left out.
[[nodiscard]] SearchSpace smoothing_space(const SmoothingSpaceOptions& options);

/// The values of a filter as a set of that space; staircases use the given values.
[[nodiscard]] ParameterSet current_set(const SearchSpace& space, const FilterParameters& filter,
                                       int iterations, const StaircaseValues& staircase = {});

/// A set's value of a parameter; none if the space lacks it.
[[nodiscard]] std::optional<double> value_of(const SearchSpace& space, const ParameterSet& set,
                                             const std::string& name);

}  // namespace vesselbench
