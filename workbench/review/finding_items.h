#pragma once

#include <string>
#include <vector>

#include "workbench/findings/dismissals.h"
#include "workbench/review/page_queue.h"

namespace vesselbench {

/// What looks wrong on a variant's newest model as far as its edits have run, without what was
/// dismissed in the project. Nothing if there is no surface.
/// \param log of the variant, in order
/// \throw what Session::result_scene() throws; Cancelled
[[nodiscard]] std::vector<Finding> open_findings(Session& session, const std::vector<LogEntry>& log,
                                                 const Progress& progress = {});

/// Findings as items of the queue, of kind "finding", in their order: they come after all
/// reasons of edits, and stand at the last edit that has run, whose model they are of.
/// \param log as above
[[nodiscard]] std::vector<QueueItem> finding_items(const std::vector<Finding>& findings,
                                                   const std::vector<LogEntry>& log);

/// Both, for the end of a queue.
[[nodiscard]] std::vector<QueueItem> finding_items(Session& session,
                                                   const std::vector<LogEntry>& log,
                                                   const Progress& progress = {});

}  // namespace vesselbench
