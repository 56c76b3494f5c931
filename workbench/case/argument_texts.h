#pragma once

#include <span>
#include <string>

#include "workbench/case/operation.h"

namespace vesselbench {

/// Reads and checks the command line's "parameter=value" texts.
/// \throw UsageError that names the operation and the text
[[nodiscard]] GivenArguments arguments_from_texts(const Operation& operation,
                                                  std::span<const std::string> texts);

/// "parameter=value parameter=value", in the order of the table; defaults are left out.
[[nodiscard]] std::string argument_summary(const Operation& operation, const Arguments& arguments);

}  // namespace vesselbench
