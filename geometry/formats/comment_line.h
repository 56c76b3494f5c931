#pragma once

#include <string>

namespace vesselbench {

/// A text as writers put it into the comment or header of a file: one line of UTF-8 without control
/// characters, and without what ends a comment, states a unit, or means something in XML,
/// OpenFOAM's dictionaries and other formats, in whose place are underscores; cut off at a
/// character. \param most bytes
[[nodiscard]] std::string comment_line(const std::string& text, std::size_t most = 200);

}  // namespace vesselbench
