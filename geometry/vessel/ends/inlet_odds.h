#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

#include "geometry/vessel/ends/end_profile.h"

namespace vesselbench {

/// What speaks for an end as the one where the blood enters, in the order of `kInletFeatures`.
inline constexpr std::array<std::string_view, 14> kInletFeatures = {
    "murray", "turn",        "width",       "closure", "course", "others",       "length",
    "height", "height_wide", "height_size", "opening", "inner",  "murray_inner", "flare"};

using InletFeatures = std::array<double, kInletFeatures.size()>;

/// An end that may be the inlet.
struct InletCandidate {
    std::size_t end = 0;  ///< as in find_surface_ends
    InletFeatures features{};
    double width = 0.0;  ///< of its vessel [mm]
    double odds = 0.0;   ///< likelihood [-]; those of all candidates add up to 1
};

/// The candidates, the likeliest first: a conditional logit model, whose weights are the table
/// inlet_weights.csv that scripts/fit_ends.py fits to cases with a known inlet.
/// \param opening likelihood of each end to be an opening; less than a half: it is no candidate
/// \throw Cancelled
[[nodiscard]] std::vector<InletCandidate> inlet_candidates(const EndScene& scene,
                                                           const std::vector<SurfaceEnd>& ends,
                                                           const std::vector<EndProfile>& profiles,
                                                           const std::vector<double>& opening,
                                                           const Progress& progress = {});

}  // namespace vesselbench
