#pragma once

#include <optional>
#include <string>

namespace vesselbench {

/// A name of the command line as people write it: "clip-opening" is "Clip opening", "tau_max" is
/// "Tau max".
[[nodiscard]] std::string readable(const std::string& name);

/// With a capital first letter: words stay as they are.
[[nodiscard]] std::string readable_sentence(std::string sentence);

/// A unit with raised digits: "mm²"; empty for numbers without one ("-").
[[nodiscard]] std::string readable_unit(const std::string& unit);

/// A number that was typed, with blanks around it or without; none: it is not one.
[[nodiscard]] std::optional<double> typed_number(const std::string& text);

}  // namespace vesselbench
