#pragma once

#include <span>
#include <string>

#include "geometry/kernel/measure.h"
#include "meshing/products/cfd_parameters.h"
#include "meshing/products/openfoam_mesh.h"

namespace vesselbench {

/// What the solver writes in every iteration, or step of time, below postProcessing/: a folder for
/// each of these names (with an opening's or the wall's name behind the first three).
namespace watched_tables {
inline constexpr const char* kPressure = "pressure_";   ///< mean over an opening [m^2/s^2]
inline constexpr const char* kFlow = "flow_";           ///< out through an opening [m^3/s]
inline constexpr const char* kWallShear = "shear_";     ///< mean magnitude over the wall [m^2/s^2]
inline constexpr const char* kResiduals = "residuals";  ///< of every equation, at its begin [-]
}  // namespace watched_tables

/// Means over the last period of a pulsatile flow.
namespace cycle_means {
inline constexpr const char* kShear = "wallShearStressMean";               ///< vector [m^2/s^2]
inline constexpr const char* kMagnitude = "wallShearStressMagnitudeMean";  ///< [m^2/s^2]
inline constexpr const char* kPressure = "pMean";                          ///< [m^2/s^2]
}  // namespace cycle_means

/// A file of this name in the case's folder ends the run: the next iteration is the last, and is
/// written.
inline constexpr const char* kStopFile = "stop";

/// system/controlDict: starts at the last time folder, writes one at least every 50 iterations
/// and at the last one (so that a killed run goes on), and the tables above. Of a pulsatile flow,
/// one at least every 20th of a period, with the means over the last period of the fields of
/// cycle_means.
[[nodiscard]] std::string control_dictionary(std::span<const FoamPatch> patches,
                                             const CfdParameters& parameters);

/// system/decomposeParDict: as many slices along the longest axis, of equal numbers of cells.
[[nodiscard]] std::string decomposition_dictionary(const Bounds& bounds, int processes);

}  // namespace vesselbench
