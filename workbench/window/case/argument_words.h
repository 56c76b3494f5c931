#pragma once

#include <string>

#include "workbench/case/operation.h"

namespace vesselbench {

/// Arguments as the window's lists show them, in the order of the table, without those that are
/// defaults: "iterations 5, find caps: no, edge 0.25 mm, 34 dabs".
[[nodiscard]] std::string argument_words(const Operation& operation, const Arguments& arguments);

}  // namespace vesselbench
