#pragma once

#include <functional>
#include <vector>

#include "workbench/batch/batch_table.h"
#include "workbench/batch/run_case.h"

namespace vesselbench {

/// Runs the cases without a record, and fills in their records: run_cases(), run_on_slurm().
using BatchEngine = std::function<void(std::vector<PlannedCase>& cases)>;

/// A batch that has run.
struct BatchResult {
    std::vector<PlannedCase> cases;
    BatchTable table;
};

/// Prepares cases, each in a process and a folder of its own, and writes table.csv, table.html and
/// costs.csv to the batch's folder, and questions.html if cases stopped because vessel ends are in
/// doubt. What an earlier batch has finished there with the same files, arguments, limits and
/// program is not run again, whenever it was killed. New answers (options.answers) join those that
/// the folder keeps: the cases that they change are run again.
/// \param tell receives a line for each case whose answers are not taken
/// \throw IoError if the folder cannot be written, or another batch runs in it; InvalidInput as
/// plan_with_answers(), before any case runs; Cancelled, after the tables of what is finished are
/// written
[[nodiscard]] BatchResult run_batch(const std::vector<BatchCase>& cases,
                                    const BatchOptions& options, const BatchEngine& engine,
                                    const BatchTeller& tell);

}  // namespace vesselbench
