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
/// and records and long lists are counted: "dabs=(80 records)".
[[nodiscard]] std::string argument_summary(const Operation& operation, const Arguments& arguments);

/// A length or a coordinate as a click fills it in, and as texts propose it: in steps of 0.01 mm,
/// finer than a pixel of most views and short enough to be read.
[[nodiscard]] double rounded_length(double millimetres);
[[nodiscard]] Vec3 rounded_place(const Vec3& point);

}  // namespace vesselbench
