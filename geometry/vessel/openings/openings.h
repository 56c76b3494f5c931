#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "geometry/kernel/progress.h"
#include "geometry/vessel/openings/opening_place.h"

namespace vesselbench {

/// An opening to be made, or a cap that can be kept.
struct PlannedOpening {
    OpeningPlace place;
    bool keep = false;  ///< a flat, perpendicular cap exists already: only its name may change
    std::optional<Patch> patch;  ///< name and kind, if known; otherwise chosen by size
};

struct OpeningPlan {
    std::vector<PlannedOpening> openings;
    std::vector<std::string> warnings;  ///< ends left closed, bends, doubtful axes
};

struct OpeningPlanOptions {
    std::optional<Vec3> tip;         ///< near the one branch to open [mm]; none: all vessel ends
    std::optional<double> distance;  ///< from the tip [mm]; none: chosen automatically
    std::optional<double> radii;     ///< the same in radii of the tip's vessel
};

/// A border or a cap belongs to a tip within this many of its diameters [-].
inline constexpr double kEndReach = 1.5;

/// The tip that a point means.
/// \param point at most 4 radii from it [mm]
/// \return node of the graph
/// \throw AlgorithmFailure if there is none; the text names the nearest one
[[nodiscard]] std::size_t tip_to_open(const CenterlineGraph& graph, const Vec3& point);

/// Decides where the vessel ends are cut. All ends: the open borders and known caps at a tip; if
/// there are fewer than two of these, or only cuts at an image's border, every other tip as well,
/// except an aneurysm's sac (a branch no longer than its width, behind a neck).
/// \throw AlgorithmFailure if there is no end, or no branch has its tip near `tip`
[[nodiscard]] OpeningPlan plan_openings(const Surface& surface, const CenterlineGraph& graph,
                                        const OpeningPlanOptions& options = {});

/// Cuts and caps as planned. name_openings assigns a name and a kind to unnamed openings. A cut
/// that would remove another vessel's end as well is left out: it is in a neck of the network, not
/// at an end.
/// \param inlet a point near the opening that is the inlet [mm]; none: the largest, unless a patch
/// of that kind exists
/// \param left_out if not null, receives the indices of the openings left out, ascending
[[nodiscard]] Surface clip_openings(const Surface& surface, const OpeningPlan& plan,
                                    const std::optional<Vec3>& inlet = std::nullopt,
                                    std::vector<std::size_t>* left_out = nullptr,
                                    const Progress& progress = {});

}  // namespace vesselbench
