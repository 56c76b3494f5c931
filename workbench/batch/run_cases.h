#pragma once

#include <vector>

#include "workbench/batch/run_case.h"

namespace vesselbench {

/// Runs the cases without a record on this machine, options.jobs at a time, and fills in their
/// records.
/// \param tell receives a line for each
/// \throw IoError if a folder cannot be written; Cancelled: what is finished has its record
void run_cases(std::vector<PlannedCase>& cases, const BatchOptions& options,
               const BatchTeller& tell, const Progress& progress);

}  // namespace vesselbench
