#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "workbench/case/readable_name.h"

namespace vesselbench {

/// A unit with raised digits: "mm²"; empty for numbers without one ("-").
[[nodiscard]] std::string readable_unit(const std::string& unit);

/// A number that was typed, with blanks around it or without; none: it is not one.
[[nodiscard]] std::optional<double> typed_number(const std::string& text);

/// What a variant's model is for: "printing"; one of the user's is called by its name.
[[nodiscard]] std::string readable_variant(const std::string& variant);

/// A count: "12,400".
[[nodiscard]] std::string grouped(std::size_t number);

/// A measured number as people read it, to three significant digits: "0.0123", "12.3", "12,400".
[[nodiscard]] std::string readable_number(double number);

}  // namespace vesselbench
