#pragma once

#include <string>
#include <vector>

#include "workbench/case/edit_record.h"
#include "workbench/project/chain.h"
#include "workbench/project/part_store.h"

namespace vesselbench {

/// "2.1": an edit and its revision, as keys and subjects of the record name it.
[[nodiscard]] std::string edit_key(EditRef edit);

/// Enters what one change of the history wrote, inside the caller's transaction: the new edit
/// revision, the removal of an edit, or a move between states. Nothing if there is none of these.
/// \param edit of the new revision; null: none
/// \param written ids of the states that were written
/// \param author of a change without an edit of its own
void enter_change(const Database& database, const History& before, const History& after,
                  const EditRecord* edit, const std::vector<StateId>& written,
                  const std::string& author);

/// Enters a result. \param digest of its scene, scene_digest(); empty: it is stale
/// \param last the blobs after this one were stored with it
void enter_result(const Database& database, const ResultRecord& result, const std::string& digest,
                  BlobId last, const std::string& author);

/// Enters another note of an edit.
void enter_note(const Database& database, EditRef edit, const std::string& note,
                const std::string& author);

/// Enters that results lost their scenes to save space.
/// \param blobs those that are gone
void enter_compaction(const Database& database, const std::vector<ResultId>& results,
                      const std::vector<BlobId>& blobs, const std::string& author);

}  // namespace vesselbench
