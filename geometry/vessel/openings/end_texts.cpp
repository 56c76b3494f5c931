#include "geometry/vessel/openings/end_texts.h"

#include "geometry/kernel/wording.h"

namespace vesselbench {

bool looks_like_sac(const EndVerdict& verdict) {
    return verdict.odds.opening <= 0.5 && verdict.odds.sac >= verdict.odds.bump;
}

std::string closed_text(const EndVerdict& verdict) {
    const EndOdds& odds = verdict.odds;
    const std::string what =
        odds.sac >= odds.bump ? "it looks like an aneurysm" : "it looks like a bump of the wall";
    return (odds.opening > 0.5 ? "it may be an opening" : what) + " (" +
           formatted(100.0 * odds.opening, "%.0f %% likely an opening") + ", " +
           formatted(100.0 * verdict.share, "%.3g %% of the flow)");
}

}  // namespace vesselbench
