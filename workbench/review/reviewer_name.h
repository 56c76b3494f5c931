#pragma once

#include <string>
#include <string_view>

namespace vesselbench {

/// A reviewer's name as it is compared: the compatibility composition of Unicode (NFKC) without
/// case, each run of blanks as one, none at the ends. "A. Kern" and " a.  KERN" are one reviewer.
/// \param name UTF-8
[[nodiscard]] std::string compared_name(std::string_view name);

/// What is left of a name for the eye: its letters and digits without accents, Cyrillic and Greek
/// letters as the Latin ones that they look like. Different names with the same outline are taken
/// for each other: "A. Kern", "A Kern" and "\u0410. Kern".
[[nodiscard]] std::string name_outline(std::string_view name);

/// True if a name holds characters that show nothing or turn the direction of writing (Unicode's
/// category Cf), or that no text should hold (controls, private and unassigned ones).
[[nodiscard]] bool has_hidden_characters(std::string_view name);

}  // namespace vesselbench
