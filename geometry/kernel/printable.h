#pragma once

#include <string>
#include <string_view>

namespace vesselbench {

[[nodiscard]] bool is_utf8(std::string_view text);

/// For texts that are stored, and printed as JSON later.
/// \param what it is: "the note"
/// \throw UsageError that shows the text unless it is UTF-8
void require_utf8(std::string_view text, const std::string& what);

/// A text of unknown origin (notes, authors, names) as it may be shown on a terminal: control
/// characters become "\x1b", bytes that are no UTF-8 too, so that no escape sequence gets through.
/// Line breaks and tabs stay.
[[nodiscard]] std::string printable(std::string_view text);

/// At most `most` bytes of a text for error texts; what is cut off is shown as "...".
[[nodiscard]] std::string shortened(const std::string& text, std::size_t most = 80);

}  // namespace vesselbench
