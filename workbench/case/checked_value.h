#pragma once

#include <string>

#include "workbench/case/parameter.h"

namespace vesselbench {

/// The value in the parameter's type: an integer is accepted as a real number, three numbers as a
/// point, a text is parsed. Records are also read from the values of all their fields, one after
/// the other, as numbers or as texts between commas and colons: x,y,z of a point, and the name or
/// the index of a choice.
/// \throw UsageError that names the parameter, the value and what is allowed, if the value is of
/// another type or out of range, or contains a name outside the grammar of names
[[nodiscard]] Value checked_value(const Parameter& parameter, const Value& value);

/// \param called the parameter in error texts: "parameter 'dabs', record 2, field 'radius'"
[[nodiscard]] Value checked_value(const Parameter& parameter, const Value& value,
                                  const std::string& called);

}  // namespace vesselbench
