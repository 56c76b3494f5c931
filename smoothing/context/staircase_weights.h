#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/kernel/topology.h"
#include "geometry/kernel/vec3.h"

namespace vesselbench {

/// The divisor of distances in Eqs. 5.5-5.6.
enum class StaircaseScaling {
    TauMax,  ///< tau_max, so that weights fade to 0
    Thesis   ///< the largest distance within tau_max, as Eq. 5.5 prints it
};

/// Parameters of staircase awareness (thesis 5.3.3).
struct StaircaseParameters {
    double tau_theta = 0.7;  ///< orientation change above which a vertex belongs to a staircase [-]
    double tau_max = 3.0;    ///< range of a staircase's influence [mm], > 0
    double beta_min = 0.0;   ///< weight of everything else, in [0, 1] [-]
    StaircaseScaling scaling = StaircaseScaling::TauMax;
    /// 1 at vertices of caps, #V; empty: none. They count as no staircases and get weight 0.
    std::span<const std::uint8_t> caps = {};
};

/// Distance of every vertex to the nearest staircase vertex [mm] that can be reached along edges
/// whose vertices all lie within tau_max of that staircase vertex; infinite if there is none. A
/// part of the surface that only passes a staircase in space is therefore not affected. Exact.
/// Costs n log n; where parts of the surface come within tau_max of each other, add a search around
/// each staircase vertex between them. Vertices at positions that are not finite are no staircases
/// and have no distance.
/// \param change orientation change of every vertex, as from orientation_change
/// \throw InvalidInput if a parameter is out of range or the length of an array is not #V
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

/// The same from distances computed before, which are valid for any beta_min and scaling.
/// \param distances as from staircase_distances with these parameters; the memory is reused
[[nodiscard]] std::vector<double> weights_of_distances(std::vector<double> distances,
                                                       const StaircaseParameters& parameters);

/// \throw InvalidInput if a parameter is out of range, or the cap flags are not #V
void require_staircase_parameters(std::size_t vertex_count, const StaircaseParameters& parameters);

}  // namespace vesselbench
