#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "geometry/vessel/ends/end_odds.h"
#include "geometry/vessel/ends/flow_tree.h"
#include "geometry/vessel/ends/inlet_odds.h"

namespace vesselbench {

/// An end or a vessel with a larger share of the inlet's flow is not closed, cut off or lost
/// without being asked for [-].
inline constexpr double kLeastShare = 0.05;
/// Odds from which an end of less flow, about which nobody is asked, is opened [-]: a wrong opening
/// costs more than a twig that stays closed.
inline constexpr double kLikely = 2.0;

/// Where doubt ends: the table end_limits.csv, read off the results of patients that the fit of the
/// odds did not see.
struct EndLimits {
    double certain = 0.0;  ///< odds beyond this factor, or below its inverse, are no doubt [-]
    /// An inlet that is likelier than any other end of a tree by this factor is no doubt [-],
    /// unless an end is wider by `wider_outlet`. Of a vessel without furcations, only the widths
    /// count.
    double inlet_certain = 0.0;
    double wider_outlet = 0.0;
};

[[nodiscard]] const EndLimits& end_limits();

/// What was measured of a candidate, and what is to become of it.
struct EndVerdict {
    EndProfile profile;
    EndOdds odds;
    double share =
        0.0;  ///< of the inlet's flow: the cube of its vessel's diameter over the inlet's
    bool open = false;
    bool doubtful = false;  ///< it has a share of the flow, and the odds do not decide
    std::optional<InletCandidate> inlet;  ///< how likely it is the inlet; none: it is none
    /// The vessels from the inlet to its own, which other ends share, the outermost one first.
    std::vector<SharedVessel> through;
};

/// What is to become of all candidates.
struct EndChoice {
    std::vector<EndVerdict> ends;      ///< by end
    std::vector<EndVerdict> stubs;     ///< by blind branch without a line
    std::optional<std::size_t> inlet;  ///< the end where the blood enters; none: unknown
};

/// Opens the ends whose odds say so: likelier openings than not, small ones kLikely; at least two
/// in any case. Closed ends beside two that were left open or named stay closed (kFewestCuts). If
/// a vessel with a share of the flow leads to closed ends alone, the likeliest of them gets its
/// share, and is in doubt unless all of them are surely closed.
/// \param ends as from find_surface_ends
/// \param stubs of the same lines
/// \throw Cancelled
[[nodiscard]] EndChoice choose_ends(const EndScene& scene, const std::vector<SurfaceEnd>& ends,
                                    const std::vector<Stub>& stubs, const Progress& progress = {});

/// True if another opening may be the inlet as well: it is about as likely, or wider (EndLimits).
/// Of two openings only the widths count: nothing else tells where the blood enters. \param ends
/// verdicts by end; `inlet` has been judged as one \param opened by end
[[nodiscard]] bool has_rival(const std::vector<EndVerdict>& ends, std::size_t inlet,
                             const std::vector<bool>& opened);

}  // namespace vesselbench
