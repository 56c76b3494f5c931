#pragma once

#include <string>
#include <string_view>

namespace vesselbench {

/// A text of unknown origin (notes, authors, names) as it may be shown on a terminal: control
/// characters become "\x1b", bytes that are no UTF-8 too, so that no escape sequence gets through.
/// Line breaks and tabs stay.
[[nodiscard]] std::string printable(std::string_view text);

/// At most `most` bytes of a text for error texts; what is cut off is shown as "...".
[[nodiscard]] std::string shortened(const std::string& text, std::size_t most = 80);

}  // namespace vesselbench
