#pragma once

#include "geometry/vessel/ends/end_profile.h"

namespace vesselbench {

/// How likely a candidate is each of the three things that a vessel's end can turn out to be; they
/// add up to 1.
struct EndOdds {
    double opening = 0.0;  ///< blood flows through it
    double sac = 0.0;      ///< an aneurysm, which stays closed
    double bump = 0.0;     ///< of the wall, or an artefact of the image

    /// Odds for an opening, as a ratio [-].
    [[nodiscard]] double for_opening() const { return opening / (1.0 - opening + 1e-12); }
};

/// A multinomial logistic model of `kEndFeatures`. Its weights are the table end_weights.csv, which
/// scripts/fit_ends.py fits to labelled ends; the table states its origin.
[[nodiscard]] EndOdds odds_of(const EndProfile& profile);

}  // namespace vesselbench
