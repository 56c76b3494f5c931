#pragma once

#include <optional>
#include <string>

#include "workbench/case/parameter.h"

namespace vesselbench {

/// The records that a value stands for: records, their JSON, or a flat list of the values of all
/// their fields, one after the other, as numbers or as texts between commas and colons. Their
/// values are not checked, and may be texts.
/// \param called the parameter in error texts: "parameter 'dabs'"
/// \return none if the value stands for no records
/// \throw UsageError if it is no JSON, or one of something else
[[nodiscard]] std::optional<Records> records_from(const Parameter& parameter, const Value& value,
                                                  const std::string& called);

}  // namespace vesselbench
