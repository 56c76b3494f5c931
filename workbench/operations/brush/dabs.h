#pragma once

#include <span>
#include <string>
#include <vector>

#include "smoothing/brush/brush.h"
#include "workbench/case/operation.h"

namespace vesselbench {

/// Parameters that place a brush: `dabs`, or one dab by `at`, `radius`, `strength`,
/// `falloff`.
/// \param weakest smallest strength, 0 or -1
/// \param strength effect of the strength
[[nodiscard]] std::vector<Parameter> dab_parameters(double weakest, const std::string& strength);

/// The dabs that are given or that an earlier run resolved; else the one at `at`, which is written
/// into the arguments, so that a replay repeats it.
/// \param operation the brush's name, for error texts
/// \param places of the surface
/// \param outcome its resolved arguments are read and completed; receives a warning if `at` is away
/// from the surface
/// \throw UsageError that names the dab and the value if the arguments make no sense;
/// AlgorithmFailure if `at` is far away from the surface, or a radius far larger than it
[[nodiscard]] std::vector<Dab> resolved_dabs(const std::string& operation, const Surface& surface,
                                             const SurfaceDistance& places, Outcome& outcome);

/// Dabs as the records of `dabs`.
[[nodiscard]] Records listed(std::span<const Dab> dabs);

/// True for the names of dab_parameters.
[[nodiscard]] bool is_dab_argument(const std::string& name);

/// \throw UsageError that says how dabs are given
[[noreturn]] void throw_without_dabs(const std::string& operation);

/// "brush-smooth: dab 2 at (1, 2, 3) mm"
[[nodiscard]] std::string dab_name(const std::string& operation, std::size_t index, const Dab& dab);

}  // namespace vesselbench
