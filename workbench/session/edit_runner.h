#pragma once

#include <string>
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
    /// \throw what the operation throws; DiagnosedFailure if it changes more than it states
    [[nodiscard]] EditRun run(const Operation& operation, Scene input,
                              const CheckedArguments& located, const Progress& progress) const;

    /// Runs the pending ones among the entries, from the first on, and enters each result as it
    /// arrives: after a cancel or an error, earlier results are kept.
    /// \return the result after them
    ResultId evaluate(const std::vector<HistoryEntry>& entries, const Progress& progress);

    /// The same in memory, without entering anything.
    [[nodiscard]] EvaluatedLine evaluated(const std::vector<HistoryEntry>& entries,
                                          const Progress& progress);

    /// The scene of a result: from memory, read, or recreated if only its source is known.
    [[nodiscard]] Scene load(ResultId id, const Progress& progress = {});

    /// Runs a stored edit again on its stored input, with its decisions.
    [[nodiscard]] Outcome rerun(const HistoryResult& result, const Progress& progress);

    /// In what an outcome of rerun() changes more than its operation states, in words; empty: in
    /// nothing.
    [[nodiscard]] std::string excess(const HistoryResult& result, const Outcome& outcome,
                                     const Progress& progress);

private:
    EditRun run_pending(EditRef edit, Scene input, const Progress& progress);
    std::vector<Scene> recall(ResultId id, const Progress& progress);
    /// Stored arguments of an edit, with the paths of its files. They are checked, because another
    /// version of the program may have stored them.
    [[nodiscard]] CheckedArguments located(const Operation& operation, EditRef edit,
                                           const Arguments& stored) const;

    CaseStore* store_;
    const SessionOptions* options_;
};

/// Adds the results of the line's runs to a history that contains its edits, and fills in their
/// ids. Runs whose result the history already has are dropped.
/// \param results receives the results to be stored with `next`
/// \param start the result before it
/// \return the result after the line
ResultId enter(EvaluatedLine& line, History& next, std::vector<NewResult>& results,
               ResultId start = 0);

}  // namespace vesselbench
