#pragma once

#include <string>
#include <vector>

#include "workbench/batch/run_case.h"

namespace vesselbench {

/// Runs the cases without a record as array jobs of Slurm, and fills in their records. Folders,
/// inputs and the program are where all nodes find them. Jobs that an earlier, killed batch has
/// left in the queue are waited for; tasks that died are submitted again, three times in all.
/// \param task arguments of this program with which a task, given a case's name behind them, runs
/// that case (run_task)
/// \throw IoError if there is no Slurm, or it refuses the job; Cancelled, after the jobs are
/// cancelled
void run_on_slurm(std::vector<PlannedCase>& cases, const BatchOptions& options,
                  const std::vector<std::string>& task, const BatchTeller& tell,
                  const Progress& progress);

/// A task of the job: runs one case unless it is finished, or another task runs it.
void run_task(const BatchCase& one, const BatchOptions& options, const BatchTeller& tell,
              const Progress& progress);

}  // namespace vesselbench
