#pragma once

#include <optional>
#include <span>
#include <vector>

#include "geometry/kernel/diagnostic.h"
#include "meshing/products/cfd_parameters.h"
#include "workbench/prepare/recipe_entry.h"
#include "workbench/session/session.h"

namespace vesselbench {

/// An entry as it runs, and what is to be said of that.
struct VesselEntry {
    RecipeEntry entry;
    std::optional<Diagnostic> warning;
};

/// What is to be asked where the vessel's name is that of a vein (venous_name), and the entry opens
/// ends for a flow without a word on the vessel; none: nothing. The name is that of the chosen
/// labels, of the mask's file, of the surface's patches, or of the file, the first that there is.
/// \param session in which the input was loaded
[[nodiscard]] std::optional<Diagnostic> vessel_doubt(const GivenArguments& given, Session& session);

/// Asks as early as possible: before the first entry that does not load the input.
/// \param rest of a recipe that is about to run
/// \throw DiagnosedFailure (vessel-unstated), unless doubts are accepted
void require_stated_vessel(std::span<const RecipeEntry> rest, Session& session);

/// The entry as it runs: where doubts are accepted, the vessel is what its name says.
[[nodiscard]] VesselEntry vessel_entry(const RecipeEntry& entry, Session& session);

/// The flow with its split, where none is given: in a vein, by the cubes of the diameters.
/// \param log of the model
[[nodiscard]] CfdParameters flow_in_vessel(CfdParameters flow, const std::vector<LogEntry>& log);

}  // namespace vesselbench
