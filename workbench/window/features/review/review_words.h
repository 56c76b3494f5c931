#pragma once

#include <string>
#include <vector>

#include "workbench/review/review.h"

namespace vesselbench {

// What reviewers wrote, of unknown origin, as lists and marks show it.

/// "A. Kern: the neck is too wide"; long texts are cut.
[[nodiscard]] std::string pin_words(const GivenPin& pin);

/// "4.20 mm": between the ends, whatever the reviewer's program said.
[[nodiscard]] std::string length_words(const ReviewedDistance& distance);

/// "A. Kern: 4.20 mm, the neck"; long texts are cut.
[[nodiscard]] std::string distance_words(const GivenDistance& given);

/// "A. Kern, radiologist: reject (outdated)"
[[nodiscard]] std::string verdict_words(const GivenVerdict& given);

/// "A. Kern: the neck is too wide", "accepted by A. Kern"; empty: nobody has said anything. Who
/// rejects comes first.
[[nodiscard]] std::string remark_of(const ReviewedEdit& edit);

/// The same of verdicts on the whole model.
[[nodiscard]] std::string remark_of(const std::vector<GivenVerdict>& verdicts);

/// True if somebody rejects it, whoever accepts it.
[[nodiscard]] bool is_rejected(const ReviewedEdit& edit);

}  // namespace vesselbench
