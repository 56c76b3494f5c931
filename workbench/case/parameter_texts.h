#pragma once

#include <string>

#include "workbench/case/parameter.h"

namespace vesselbench {

[[nodiscard]] std::string to_string(ParameterType type);  ///< "flag", "integer", "real" ...

/// What a parameter may be: "0 ... 1", ">= 1", "x,y,z, > 0", "keep|smooth|round",
/// "[{\"place\": ..., \"way\": ...}, ...]".
[[nodiscard]] std::string range_text(const Parameter& parameter);

/// What its value may be: "a number (0 to 1 mm)".
[[nodiscard]] std::string allowed_text(const Parameter& parameter);

/// "[mm]"; empty for texts and ratios.
[[nodiscard]] std::string unit_text(const Parameter& parameter);

/// The text of its default, "automatic" if the operation decides, "required" if it must be given.
[[nodiscard]] std::string default_text(const Parameter& parameter);

}  // namespace vesselbench
