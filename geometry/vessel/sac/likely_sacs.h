#pragma once

#include <optional>
#include <vector>

#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"
#include "geometry/vessel/openings/judged_tips.h"

namespace vesselbench {

/// The vessel's blind ends by their odds for a sac, the likeliest first.
/// \param image that the surface was made from
/// \throw what centerlines_of throws
[[nodiscard]] std::vector<JudgedTip> tips_by_sac_odds(const Surface& surface,
                                                      const std::optional<ImageBox>& image,
                                                      const Progress& progress = {});

/// True if a tip is rather a sac than anything else.
[[nodiscard]] bool is_likely_sac(const JudgedTip& tip);

/// The first of some tips whose sac, as far as its proposed neck (propose_neck), holds all the
/// others: a sac and the blebs on it have a tip each. None: they are not of one sac.
[[nodiscard]] std::optional<Vec3> dome_of_one_sac(const Surface& surface,
                                                  const std::vector<JudgedTip>& tips,
                                                  const Progress& progress = {});

}  // namespace vesselbench
