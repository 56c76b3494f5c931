#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/kernel/topology.h"
#include "geometry/kernel/vec3.h"

namespace vesselbench {

/// What Eqs. 5.5-5.6 divide distances by.
enum class StaircaseScaling {
    TauMax,  ///< tau_max, so that weights fade to 0
    Thesis   ///< the largest distance within tau_max, as Eq. 5.5 prints it
};

/// Parameters of staircase awareness (thesis 5.3.3).
struct StaircaseParameters {
    double tau_theta = 0.7;  ///< orientation change beyond which a vertex is a staircase's [-]
    double tau_max = 3.0;    ///< how far a staircase's influence reaches [mm], > 0
    double beta_min = 0.0;   ///< weight of everything else, in [0, 1] [-]
    StaircaseScaling scaling = StaircaseScaling::TauMax;
    /// 1 at vertices of caps, #V; empty: none. They are no staircases and get weight 0.
    std::span<const std::uint8_t> caps = {};
};

/// Distance of every vertex to the nearest staircase vertex [mm] that can be reached along edges
/// whose vertices all lie within tau_max of that staircase vertex; infinite if there is none. So a
/// part of the surface that only passes a staircase in space is not affected. Exact.
/// Costs n log n; where parts of the surface come within tau_max of each other, a search around
/// each staircase vertex between them is added. Vertices at positions that are not finite are no
/// staircases and have no distance.
/// \param change orientation change of every vertex, as orientation_change gives it
/// \throw InvalidInput if a parameter is out of range or an array has another length than #V
[[nodiscard]] std::vector<double> staircase_distances(const Topology& topology,
                                                      const Positions& positions,
                                                      std::span<const double> change,
                                                      const StaircaseParameters& parameters = {});

/// Smoothing weights in [0, 1]: 1 at staircases, fading to beta_min at tau_max, 0 on caps. #V
/// Source: thesis Eqs. 5.5-5.6.
/// \throw InvalidInput as staircase_distances
[[nodiscard]] std::vector<double> staircase_weights(const Topology& topology,
                                                    const Positions& positions,
                                                    std::span<const double> change,
                                                    const StaircaseParameters& parameters = {});

/// The same from distances found before, which hold for any beta_min and scaling.
/// \param distances as staircase_distances gives them for these parameters; reused
[[nodiscard]] std::vector<double> weights_of_distances(std::vector<double> distances,
                                                       const StaircaseParameters& parameters);

/// \throw InvalidInput if a parameter is out of range, or the cap flags are not #V
void require_staircase_parameters(std::size_t vertex_count, const StaircaseParameters& parameters);

}  // namespace vesselbench
