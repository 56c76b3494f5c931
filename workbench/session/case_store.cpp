#include "workbench/session/case_store.h"

#include <algorithm>
#include <utility>

#include "geometry/kernel/errors.h"
#include "workbench/case/checked_arguments.h"

namespace vesselbench {

namespace {

/// The result of the last of these edits; empty if one of them is pending.
std::optional<ResultId> end_of(const std::vector<HistoryEntry>& line) {
    ResultId end = 0;
    for (const HistoryEntry& entry : line) {
        if (entry.status == EditStatus::Pending) return std::nullopt;
        if (entry.status == EditStatus::Done) end = entry.result;
    }
    return end;
}

/// The results of a revision that are not stale; 0: none.
struct RunRange {
    ResultId first = 0, newest = 0;
};

std::map<EditRef, RunRange> runs_in(const History& history) {
    std::map<EditRef, RunRange> runs;
    for (const auto& [id, result] : history.results()) {  // ascending
        if (!result.stale_reason.empty()) continue;
        RunRange& run = runs[result.edit];
        if (run.first == 0) run.first = id;
        run.newest = id;
    }
    return runs;
}

}  // namespace

CaseStore::CaseStore(ProjectFile project, OperationLookup find, std::size_t scene_bytes)
    : project_(std::move(project)),
      find_(std::move(find)),
      history_(std::make_shared<const History>(project_.history())),
      cache_(scene_bytes) {}

void CaseStore::check_writable() const {
    if (only_reads()) throw IoError(project_.read_only_reason());
}

void CaseStore::commit(History next, ProjectChange change) {
    auto after = std::make_shared<const History>(std::move(next));
    change.before = history_.get();
    change.after = after.get();
    project_.commit(change);
    history_ = std::move(after);
    if (change.edit != nullptr) edits_[change.edit->edit] = *change.edit;
    for (const NewResult& result : change.results) {
        records_[result.record->id] = std::make_shared<const ResultRecord>(*result.record);
        if (result.scene != nullptr) cache_.put(result.record->id, *result.scene);
    }
}

void CaseStore::commit_results(History next, const std::vector<NewResult>& results) {
    if (!only_reads()) {
        ProjectChange change;
        change.results = results;
        return commit(std::move(next), std::move(change));
    }
    for (const NewResult& result : results) {
        const ResultId id = result.record->id;
        records_[id] = std::make_shared<const ResultRecord>(*result.record);
        own_scenes_[id] = result.scene != nullptr ? std::optional(*result.scene) : std::nullopt;
    }
    history_ = std::make_shared<const History>(std::move(next));
}

void CaseStore::set_note(EditRef edit, const std::string& note) {
    check_writable();
    remember({edit});
    project_.set_note(edit, note);
    edits_.at(edit).note = note;
    past_.reset();
}

std::shared_ptr<const ResultRecord> CaseStore::record(ResultId id) {
    remember({}, {id});
    return records_.at(id);
}

std::optional<Scene> CaseStore::at_hand(ResultId id) {
    if (id == 0) return Scene{};
    if (const auto own = own_scenes_.find(id); own != own_scenes_.end()) return own->second;
    return cache_.find(id);
}

EditRecord CaseStore::edit(EditRef edit) {
    remember({edit});
    return edits_.at(edit);
}

/// What is stored of an operation that this program does not know stays as it is.
Arguments CaseStore::typed(const std::string& operation, Arguments stored) const {
    const Operation* known = nullptr;
    try {
        known = &find_(operation);
    } catch (const UsageError&) {
        return stored;
    }
    return with_records(*known, std::move(stored));
}

void CaseStore::remember(std::vector<EditRef> edits) {
    std::erase_if(edits, [&](EditRef edit) { return edits_.contains(edit); });
    std::ranges::sort(edits);
    edits.erase(std::ranges::unique(edits).begin(), edits.end());
    if (edits.empty()) return;
    for (auto& [ref, record] : project_.edits(edits)) {
        record.given = typed(record.operation, std::move(record.given));
        edits_.emplace(ref, std::move(record));
    }
}

void CaseStore::remember(std::vector<EditRef> edits, std::vector<ResultId> results) {
    std::erase_if(results, [&](ResultId id) { return records_.contains(id); });
    std::map<ResultId, ResultRecord> read;
    if (!results.empty()) read = project_.results(results);
    for (const auto& [id, record] : read) edits.push_back(record.edit);
    remember(std::move(edits));
    for (auto& [id, record] : read) {
        record.resolved = typed(edits_.at(record.edit).operation, std::move(record.resolved));
        records_[id] = std::make_shared<const ResultRecord>(std::move(record));
    }
}

/// Edits and results are only ever added; set_note() resets it.
void CaseStore::renew_past() {
    const auto& edits = history_->edits();
    if (past_ && past_->size() == edits.size() && past_results_ == history_->results().size())
        return;
    const std::map<EditRef, RunRange> runs = runs_in(*history_);
    std::vector<EditRef> refs;
    for (const auto& [ref, place] : edits) refs.push_back(ref);
    std::vector<ResultId> results;
    for (const auto& [ref, run] : runs) {
        results.push_back(run.newest);
        if (run.first != run.newest) results.push_back(run.first);
    }
    remember(refs, results);
    auto past = std::make_shared<std::map<EditRef, PastEdit>>();
    for (const EditRef ref : refs) {
        PastEdit& edit = past->emplace(ref, PastEdit{.edit = edits_.at(ref)}).first->second;
        const auto run = runs.find(ref);
        if (run == runs.end()) continue;
        edit.result = records_.at(run->second.newest);
        edit.first = records_.at(run->second.first);
    }
    past_ = std::move(past);
    past_results_ = history_->results().size();
}

std::map<std::string, Scene> CaseStore::scenes_at_hand() {
    std::vector<std::string> variants = history_->variants();
    variants.emplace_back();
    std::map<std::string, Scene> scenes;
    for (const std::string& variant : variants)
        if (const auto end = end_of(history_->line(variant)))
            if (auto scene = at_hand(*end)) scenes.emplace(variant, std::move(*scene));
    return scenes;
}

std::shared_ptr<const Snapshot> CaseStore::snapshot() {
    const std::vector<HistoryEntry> entries = history_->entries();
    std::vector<EditRef> edits;
    std::vector<ResultId> results;
    for (const HistoryEntry& entry : entries) {
        edits.push_back(entry.edit);
        if (entry.status != EditStatus::Pending) results.push_back(entry.result);
    }
    remember(std::move(edits), std::move(results));
    auto made = std::make_shared<Snapshot>();
    made->history = history_;
    for (const HistoryEntry& entry : entries) {
        LogEntry& row = made->log.emplace_back(
            LogEntry{edits_.at(entry.edit), entry.status, entry.reason, nullptr});
        if (entry.status == EditStatus::Done) row.result = records_.at(entry.result);
        if (entry.status == EditStatus::Stale) row.refusal = records_.at(entry.result)->warnings;
    }
    renew_past();
    made->past = past_;
    made->scenes = scenes_at_hand();
    made->project = project_.name();
    made->read_only_reason = project_.read_only_reason();
    return made;
}

}  // namespace vesselbench
