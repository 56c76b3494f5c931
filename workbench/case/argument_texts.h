#pragma once

#include <span>
#include <string>

#include "workbench/case/operation.h"

namespace vesselbench {

/// Reads and checks the command line's "parameter=value" texts.
/// \throw UsageError that names the operation and the text
[[nodiscard]] GivenArguments arguments_from_texts(const Operation& operation,
                                                  std::span<const std::string> texts);

/// "parameter=value parameter=value" for people, in the order of the table; defaults are left out,
/// and long lists are counted: "dabs=(800 numbers)".
[[nodiscard]] std::string argument_summary(const Operation& operation, const Arguments& arguments);

}  // namespace vesselbench
