#pragma once

#include <vector>

#include "workbench/session/case_store.h"
#include "workbench/session/edit_run.h"
#include "workbench/session/session_options.h"

namespace vesselbench {

/// Runs the edits of a case: new ones, pending ones, and stored ones again.
class EditRunner {
public:
    EditRunner(CaseStore& store, const SessionOptions& options)
        : store_(&store), options_(&options) {}

    /// Runs an operation on a scene.
    /// \param located arguments with the paths of the files it reads
    /// \throw what the operation throws
    [[nodiscard]] EditRun run(const Operation& operation, Scene input, const Arguments& located,
                              const Progress& progress) const;

    /// Runs what is pending among the entries, from the first on, and enters each result as it
    /// comes: after a cancel or an error, what ran before it stays.
    /// \return the result behind them
    ResultId evaluate(const std::vector<HistoryEntry>& entries, const Progress& progress);

    /// The same in memory: nothing is entered.
    [[nodiscard]] EvaluatedLine evaluated(const std::vector<HistoryEntry>& entries,
                                          const Progress& progress);

    /// The scene of a result: from memory, read, or, where only its source is known, made again.
    [[nodiscard]] Scene load(ResultId id, const Progress& progress = {});

    /// Runs a stored edit again on its stored input, with what it had decided.
    [[nodiscard]] Outcome rerun(const HistoryResult& result, const Progress& progress);

private:
    EditRun run_pending(EditRef edit, Scene input, const Progress& progress);
    std::vector<Scene> recall(ResultId id, const Progress& progress);

    CaseStore* store_;
    const SessionOptions* options_;
};

/// Adds the results of the line's runs to a history that holds its edits, and fills in their ids.
/// Runs whose result the history knows by now are dropped.
/// \param results gets what is to be stored with `next`
/// \param start the result before it
/// \return the result behind the line
ResultId enter(EvaluatedLine& line, History& next, std::vector<NewResult>& results,
               ResultId start = 0);

}  // namespace vesselbench
