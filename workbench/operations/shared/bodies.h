#pragma once

#include <string>
#include <vector>

#include "workbench/case/operation.h"

namespace vesselbench {

/// The parameter `bodies` of repair.
[[nodiscard]] Parameter bodies_parameter();

/// A surface of which the bodies are settled, for repair to keep the largest.
struct SettledBodies {
    Surface surface;
    std::size_t united = 0;      ///< bodies that became part of another one
    std::size_t no_vessels = 0;  ///< bodies that were left out
    std::vector<Diagnostic> warnings;
};

/// Unites closed bodies that overlap, and leaves out those that cannot be a vessel, such as a base
/// plate. A surface of one part stays as it is, and one of an image: extract-surface has chosen.
/// \param choice of the parameter `bodies`
/// \throw UsageError if a body that cannot be a vessel matters, and the choice is "ask"
/// \throw AlgorithmFailure with the place if bodies that overlap cannot be united
[[nodiscard]] SettledBodies settled_bodies(const Scene& scene, const std::string& choice,
                                           const Progress& progress);

}  // namespace vesselbench
