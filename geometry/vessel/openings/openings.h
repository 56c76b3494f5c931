#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/vessel/openings/opening_place.h"

namespace vesselbench {

/// One opening that is to be made, or a cap that is good as it is.
struct PlannedOpening {
    OpeningPlace place;
    bool keep = false;  ///< there is a flat, perpendicular cap already: only its name may change
    std::optional<Patch> patch;  ///< name and kind, when they are known; otherwise chosen by size
};

struct OpeningPlan {
    std::vector<PlannedOpening> openings;
    std::vector<std::string> warnings;  ///< what was left closed, bends, doubtful axes
};

struct OpeningPlanOptions {
    std::optional<Vec3> tip;         ///< near the one branch to open [mm]; none: all vessel ends
    std::optional<double> distance;  ///< from the tip [mm]; none: chosen by itself
    std::optional<double> radii;     ///< the same in radii of the tip's vessel
};

/// Decides where the vessel ends are cut. All ends: the open borders and known caps that lie at a
/// tip; where there are less than two of these, or only cuts at an image's border, every other tip
/// as well, but not an aneurysm's sac (a branch no longer than its width, behind a neck).
/// \throw AlgorithmFailure if there is no end, or no branch has its tip near `tip`
[[nodiscard]] OpeningPlan plan_openings(const Surface& surface, const CenterlineGraph& graph,
                                        const OpeningPlanOptions& options = {});

/// Cuts and caps as planned. Openings without a name are called and typed by name_openings.
/// A cut that would take the end of another vessel with it is left out: it lies in a neck of the
/// network, not at an end.
/// \param inlet a point near the opening that is the inlet [mm]; none: the largest, unless a patch
///        of that kind exists
/// \param left_out if not null, the indices of the openings left out are added here, ascending
[[nodiscard]] Surface clip_openings(const Surface& surface, const OpeningPlan& plan,
                                    const std::optional<Vec3>& inlet = std::nullopt,
                                    std::vector<std::size_t>* left_out = nullptr);

/// Orders the patches (wall, inlet, outlets by descending area, the rest) and gives those of kind
/// Cut that are listed in `unnamed` a kind and a name: the inlet as above, the others outlet_1,
/// outlet_2 ... by descending area.
[[nodiscard]] Surface name_openings(const Surface& surface, const std::vector<std::string>& unnamed,
                                    const std::optional<Vec3>& inlet = std::nullopt);

/// The patch that is the opening nearest to a point, by centroid; empty if there is no opening.
[[nodiscard]] std::optional<std::size_t> nearest_opening(const Surface& surface, const Vec3& point);

}  // namespace vesselbench
