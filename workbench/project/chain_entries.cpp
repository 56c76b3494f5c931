#include "workbench/project/chain_entries.h"

namespace vesselbench {

namespace {

std::string where_edit(EditRef edit) {
    return "edit = " + std::to_string(edit.id) + " AND revision = " + std::to_string(edit.revision);
}

std::string where_id(const std::vector<std::int64_t>& ids) {
    std::string list;
    for (const std::int64_t id : ids) list += (list.empty() ? "" : ",") + std::to_string(id);
    return "id IN (" + list + ")";
}

bool leads_to(const History& history, StateId from, StateId to) {
    while (to != 0 && to != from) to = history.state(to).parent;
    return to == from;
}

/// "undo", "redo", or "go" to a state that is neither before nor behind.
std::string move_kind(const History& history, StateId from, StateId to) {
    if (leads_to(history, to, from)) return "undo";
    return leads_to(history, from, to) ? "redo" : "go";
}

NewEntry edit_entry(const Database& database, const EditRecord& edit) {
    NewEntry entry{.kind = edit.edit.revision == 1 ? "edit" : "change",
                   .subject = "edit " + edit_key(edit.edit),
                   .author = edit.author,
                   .facts = {{"operation", edit.operation},
                             {"step", to_string(edit.place.step)},
                             {"variant", edit.place.variant},
                             {"note", edit.note}},
                   .rows = {},
                   .gone = {}};
    add_row_digests(database, "edits", where_edit(edit.edit), entry.rows);
    add_row_digests(database, "sources", where_edit(edit.edit), entry.rows);
    return entry;
}

NewEntry move_entry(const History& before, const History& after, const std::string& author) {
    const HistoryState& now = after.state(after.current());
    if (!before.states().contains(now.id))
        return {.kind = "remove",
                .subject = "edit " + edit_key(now.edit),
                .author = author,
                .rows = {},
                .gone = {}};
    return {.kind = move_kind(after, before.current(), now.id),
            .subject = "state " + std::to_string(now.id),
            .author = author,
            .facts = {{"from", before.current()}},
            .rows = {},
            .gone = {}};
}

}  // namespace

std::string edit_key(EditRef edit) {
    return std::to_string(edit.id) + "." + std::to_string(edit.revision);
}

void enter_change(const Database& database, const History& before, const History& after,
                  const EditRecord* edit, const std::vector<StateId>& written,
                  const std::string& author) {
    if (edit == nullptr && written.empty() && before.current() == after.current()) return;
    NewEntry entry =
        edit != nullptr ? edit_entry(database, *edit) : move_entry(before, after, author);
    entry.facts["state"] = after.current();
    add_row_digests(database, "states", where_id(written), entry.rows);
    add_row_digests(database, "meta", "name = 'current'", entry.rows);
    append_entry(database, entry);
}

void enter_result(const Database& database, const ResultRecord& result, const std::string& digest,
                  BlobId last, const std::string& author) {
    NewEntry entry{.kind = result.stale_reason.empty() ? "result" : "refusal",
                   .subject = "edit " + edit_key(result.edit),
                   .author = author,
                   .facts = {{"result", result.id}, {"input", result.input}},
                   .rows = {},
                   .gone = {}};
    if (digest.empty())
        entry.facts["reason"] = result.stale_reason;
    else
        entry.facts["sha256"] = digest;
    add_row_digests(database, "results", where_id({result.id}), entry.rows);
    add_row_digests(database, "blobs", "id > " + std::to_string(last), entry.rows);
    append_entry(database, entry);
}

void enter_note(const Database& database, EditRef edit, const std::string& note,
                const std::string& author) {
    NewEntry entry{.kind = "note",
                   .subject = "edit " + edit_key(edit),
                   .author = author,
                   .facts = {{"note", note}},
                   .rows = {},
                   .gone = {}};
    add_row_digests(database, "edits", where_edit(edit), entry.rows);
    append_entry(database, entry);
}

void enter_compaction(const Database& database, const std::vector<ResultId>& results,
                      const std::vector<BlobId>& blobs, const std::string& author) {
    NewEntry entry{.kind = "compact",
                   .subject = "project",
                   .author = author,
                   .facts = {{"results", results}},
                   .rows = {},
                   .gone = {}};
    add_row_digests(database, "results", where_id(results), entry.rows);
    for (const BlobId blob : blobs) entry.gone.push_back("blobs " + std::to_string(blob));
    append_entry(database, entry);
}

}  // namespace vesselbench
