#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>

namespace vesselbench {

/// The lines of a JSON text, from 1 on, at which its values are; of an object's values, those of
/// their keys. They are named by the keys and indices that lead to them, "/2/arguments".
/// Comments are allowed. \pre the text is JSON
[[nodiscard]] std::map<std::string, std::size_t> json_lines(std::string_view text);

/// The line of a place, or of the nearest one around it.
[[nodiscard]] std::size_t line_at(const std::map<std::string, std::size_t>& lines,
                                  std::string place);

}  // namespace vesselbench
