#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <vector>

#include "workbench/case/edit_record.h"
#include "workbench/case/history.h"
#include "workbench/project/database.h"
#include "workbench/project/source_file.h"

namespace vesselbench {

// The rows of edits, results, sources and states; always inside the caller's transaction.

void insert_edit(const Database& database, const EditRecord& edit);
void update_note(const Database& database, EditRef edit, const std::string& note);
void insert_sources(const Database& database, EditRef edit, const std::vector<SourceFile>& sources);

/// \param scene the packed SceneRow; empty for a stale result
void insert_result(const Database& database, const ResultRecord& result,
                   std::span<const std::byte> scene);

/// Writes the difference between two histories. \return the ids of the states that were written
std::vector<StateId> write_states(const Database& database, const History& before,
                                  const History& after);

/// Reads a consistent snapshot of states, edits and results without their data.
/// \throw InvalidInput if they are inconsistent
[[nodiscard]] History read_history(const Database& database);

/// The records of these edits, by one query. \throw InvalidInput if one is missing or damaged
[[nodiscard]] std::map<EditRef, EditRecord> read_edits(const Database& database,
                                                       const std::vector<EditRef>& edits);

/// The records of these results, by one query. \throw InvalidInput if one is missing or damaged
[[nodiscard]] std::map<ResultId, ResultRecord> read_results(const Database& database,
                                                            const std::vector<ResultId>& results);

[[nodiscard]] std::vector<SourceFile> read_sources(const Database& database, EditRef edit);

}  // namespace vesselbench
