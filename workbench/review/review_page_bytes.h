#pragma once

#include <span>

namespace vesselbench {

/// The page that the build makes of workbench/review/page (cmake/BuildReviewPage.cmake); empty
/// without npm.
[[nodiscard]] std::span<const unsigned char> review_page_bytes();

}  // namespace vesselbench
