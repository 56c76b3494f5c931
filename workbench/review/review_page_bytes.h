#pragma once

#include <span>

namespace vesselbench {

// The pages that the build makes of workbench/review/page (cmake/BuildReviewPage.cmake); empty
// without npm.

/// On which experts review edits.
[[nodiscard]] std::span<const unsigned char> review_page_bytes();

/// That shows a model.
[[nodiscard]] std::span<const unsigned char> viewer_page_bytes();

}  // namespace vesselbench
