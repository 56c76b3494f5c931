#pragma once

#include <exception>
#include <optional>
#include <string>
#include <vector>

#include "workbench/case/edit_record.h"
#include "workbench/case/operation.h"
#include "workbench/case/scene.h"
#include "workbench/project/utc_time.h"

namespace vesselbench {

/// An edit that has run on an input and is not in the history yet.
struct EditRun {
    ResultRecord record;         ///< without the ids of result, edit and input
    Scene input;                 ///< the scene it ran on
    std::optional<Scene> scene;  ///< none: the edit is stale
};

/// The edits before a new one, evaluated in memory; not in the history yet.
struct EvaluatedLine {
    struct Link {
        EditRef edit;
        std::optional<EditRun> run;  ///< none: its result was known
    };

    std::vector<Link> links;
    /// The known result after them; none: it is produced by their runs.
    std::optional<ResultId> end = 0;
    Scene scene;  ///< of that result
};

/// The outcome of an operation as the record of a result.
/// \param outcome source of the record's report and arguments, with files without their folders
/// \param duration [s]
[[nodiscard]] EditRun edit_run(const Operation& operation, Scene input, Outcome outcome,
                               double duration, const Progress& progress);

/// A pending edit that no longer applies to its input, with the error as the record's reason.
/// \param operation the edit's
[[nodiscard]] EditRun stale_run(Scene input, const std::string& operation,
                                const std::exception& error);

}  // namespace vesselbench
