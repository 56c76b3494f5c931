#pragma once

#include <optional>
#include <string>

#include "workbench/case/readable_name.h"

namespace vesselbench {

/// A unit with raised digits: "mm²"; empty for numbers without one ("-").
[[nodiscard]] std::string readable_unit(const std::string& unit);

/// A number that was typed, with blanks around it or without; none: it is not one.
[[nodiscard]] std::optional<double> typed_number(const std::string& text);

}  // namespace vesselbench
