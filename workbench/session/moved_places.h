#pragma once

#include <optional>
#include <string>
#include <vector>

#include "workbench/case/edit_record.h"
#include "workbench/case/operation.h"

namespace vesselbench {

/// What becomes of the arguments of later edits if the model gets another unit: places stay where
/// they are in the vessel, sizes keep their numbers.

/// By how much lengths grow from one run of an edit to another that reads the model in another
/// unit [-]; none: it does not.
[[nodiscard]] std::optional<double> unit_factor(const Operation& operation,
                                                const Arguments& resolved_before,
                                                const Arguments& resolved_now);

/// The arguments with all places in them scaled, and all lengths in records: a brush stroke is
/// scaled as a whole.
[[nodiscard]] Arguments with_scaled_places(const Operation& operation, Arguments given,
                                           double factor);

/// The parameters among the arguments that are sizes of the model [mm].
[[nodiscard]] std::vector<std::string> given_sizes(const Operation& operation,
                                                   const Arguments& given);

}  // namespace vesselbench
