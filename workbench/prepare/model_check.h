#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/kernel/progress.h"
#include "geometry/vessel/openings/lost_vessels.h"
#include "workbench/session/session.h"

namespace vesselbench {

/// What a model is compared with.
struct BeforeOpenings {
    Surface surface;  ///< before the first edit that cut ends
    /// What was taken away from then on because the caller said where: by cuts at a given place,
    /// and by removed branches.
    std::vector<Removal> asked;
};

/// Empty if no end was cut.
[[nodiscard]] std::optional<BeforeOpenings> before_openings(Session& session,
                                                            const std::string& variant);

/// The vessels that a model misses.
struct VesselCheck {
    std::vector<LostVessel> lost;
    std::string warning;  ///< why they could not be looked for
};

[[nodiscard]] VesselCheck compared_vessels(const BeforeOpenings& before, const Surface& after,
                                           const Progress& progress = {});

/// Compares a variant's model with the surface before its ends were opened.
/// \return a warning if the vessels could not be compared; else empty
/// \throw AlgorithmFailure if a vessel misses over more than 3 of its diameters; the text lists
/// them, and names the edit that lost them with the command that mends it
[[nodiscard]] std::string check_vessels(Session& session, const std::string& variant,
                                        const Progress& progress);

/// \throw AlgorithmFailure if the cuts opened a vessel's side; the text names the opening, and the
/// command that mends it
void check_openings(Session& session, const std::string& variant);

}  // namespace vesselbench
