#pragma once

#include "workbench/case/arguments.h"

namespace vesselbench {

struct Operation;

/// The arguments that a stored edit ran with, and for each parameter that its operation has had
/// since then the value by which it does what it did: a replay gives the same bits.
/// \param resolved as stored
[[nodiscard]] Arguments with_former_arguments(const Operation& operation, Arguments resolved);

}  // namespace vesselbench
