#pragma once

#include <optional>
#include <string>

#include "workbench/case/parameter.h"

namespace vesselbench {

/// The records that a value gives to a parameter of them, each with the fields that the parameter
/// declares, in their types and ranges.
/// \param value records, their JSON, or a flat list of values (checked_value())
/// \param called the parameter in error texts
/// \return none if the value stands for no records
/// \throw UsageError that names the record, the field, its value and what is allowed
[[nodiscard]] std::optional<Records> checked_records(const Parameter& parameter, const Value& value,
                                                     const std::string& called);

}  // namespace vesselbench
