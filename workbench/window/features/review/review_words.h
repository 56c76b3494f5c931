#pragma once

#include <string>

#include "workbench/review/review.h"

namespace vesselbench {

// What reviewers wrote, of unknown origin, as lists and marks show it.

/// "A. Kern: the neck is too wide"; long texts are cut.
[[nodiscard]] std::string pin_words(const GivenPin& pin);

/// "A. Kern, radiologist: reject (outdated)"
[[nodiscard]] std::string verdict_words(const GivenVerdict& given);

/// "A. Kern: the neck is too wide", "accepted by A. Kern"; empty: nobody has said anything. Who
/// rejects comes first.
[[nodiscard]] std::string remark_of(const ReviewedEdit& edit);

/// True if somebody rejects it, whoever accepts it.
[[nodiscard]] bool is_rejected(const ReviewedEdit& edit);

}  // namespace vesselbench
