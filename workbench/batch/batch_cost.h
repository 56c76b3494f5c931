#pragma once

#include <string>
#include <vector>

#include "workbench/batch/plan.h"

namespace vesselbench {

/// What finished cases took: "by 3 cases: 390 cases an hour with 2 jobs (9.2 s a case), memory 240
/// MiB a case (median), 412 MiB at most". Empty: none is finished.
/// \param jobs at once; 0: as many as a cluster runs, which the text then does not say
[[nodiscard]] std::string cost_text(const std::vector<PlannedCase>& cases, std::size_t jobs);

/// How long the cases that are left will take, by those that are finished: a line through their
/// times over the sizes of their inputs, or their mean where they are fewer than five. Empty:
/// nothing is left or finished.
/// \param jobs as for cost_text(); 0: the time of one job after the other
[[nodiscard]] std::string estimate_text(const std::vector<PlannedCase>& cases, std::size_t jobs);

/// costs.csv: a line for each finished case. Times differ from run to run: no other table has them.
[[nodiscard]] std::string costs_csv(const std::vector<PlannedCase>& cases);

}  // namespace vesselbench
