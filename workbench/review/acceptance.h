#pragma once

#include <cstddef>
#include <string>

namespace vesselbench {

/// The number of reviewers that "accepted" or "accepted=2" asks for.
/// \param asked for the text, in errors: "--require"
/// \throw UsageError if it is neither
[[nodiscard]] std::size_t required_reviewers(const std::string& text, const std::string& asked);

}  // namespace vesselbench
