#include "workbench/case/history.h"

#include <algorithm>
#include <set>
#include <utility>

#include "geometry/kernel/errors.h"

namespace vesselbench {

namespace {

std::string edit_text(EditId id) {
    return "edit " + std::to_string(id);
}

void require_known(EditId id, const std::map<EditRef, EditPlace>& edits) {
    const EditId newest = edits.empty() ? 0 : edits.rbegin()->first.id;
    if (newest == 0) throw UsageError("there are no edits");
    for (const auto& [edit, place] : edits)
        if (edit.id == id) return;
    throw UsageError("there is no " + edit_text(id) + " (the newest is " + std::to_string(newest) +
                     ")");
}

/// Walks along edits: the result before the next one, and whether that is known.
struct Walk {
    ResultId input = 0;
    bool pending = false;
};

HistoryEntry next_entry(const History& history, EditRef edit, Walk& walk) {
    HistoryEntry entry;
    entry.edit = edit;
    entry.place = history.edits().at(edit);
    if (walk.pending) return entry;
    entry.input = walk.input;
    const HistoryResult* result = history.result_of(edit, walk.input);
    if (result == nullptr) {
        walk.pending = true;
    } else if (result->stale_reason.empty()) {
        entry.status = EditStatus::Done;
        entry.result = walk.input = result->id;
    } else {
        entry.status = EditStatus::Stale;
        entry.result = result->id;
        entry.reason = result->stale_reason;
    }
    return entry;
}

void check_states(const std::map<StateId, HistoryState>& states,
                  const std::map<EditRef, EditPlace>& edits) {
    for (const auto& [id, state] : states) {
        if (id == 0) continue;
        if (state.parent >= id || !states.contains(state.parent))
            throw InvalidInput("state " + std::to_string(id) + " has no parent");
        if (!edits.contains(state.edit))
            throw InvalidInput("state " + std::to_string(id) + " names an unknown edit");
        if (state.last_child != 0 &&
            (!states.contains(state.last_child) || states.at(state.last_child).parent != id))
            throw InvalidInput("state " + std::to_string(id) + " names a wrong child");
    }
}

}  // namespace

bool belongs_to_variant(Step step) {
    return step >= Step::Openings && step <= Step::Product;
}

bool is_part_of(const EditPlace& place, const std::string& variant) {
    return place.variant.empty() || place.variant == variant;
}

std::string to_string(EditStatus status) {
    switch (status) {
        case EditStatus::Done:
            return "done";
        case EditStatus::Stale:
            return "stale";
        case EditStatus::Pending:
            break;
    }
    return "pending";
}

History::History() {
    states_[0] = {};
}

History::History(std::map<EditRef, EditPlace> edits, std::vector<HistoryState> states,
                 std::vector<HistoryResult> results, StateId current)
    : edits_(std::move(edits)), current_(current) {
    for (const HistoryState& state : states) states_[state.id] = state;
    if (!states_.contains(0)) throw InvalidInput("the history has no start");
    check_states(states_, edits_);
    if (!states_.contains(current)) throw InvalidInput("the history's current state is missing");
    for (HistoryResult& result : results) {
        if (!edits_.contains(result.edit) || result.input >= result.id)
            throw InvalidInput("result " + std::to_string(result.id) + " has no edit");
        if (!result.dropped) result_by_input_[{result.edit, result.input}] = result.id;
        results_[result.id] = std::move(result);
    }
}

const HistoryState& History::state(StateId id) const {
    const auto found = states_.find(id);
    if (found == states_.end())
        throw UsageError("there is no state " + std::to_string(id) + " (the newest is " +
                         std::to_string(states_.rbegin()->first) + ")");
    return found->second;
}

std::vector<EditRef> History::edits_of(StateId id) const {
    std::vector<const HistoryState*> path;
    for (; id != 0; id = states_.at(id).parent) path.push_back(&states_.at(id));
    std::map<EditId, EditRef> held;
    for (auto state = path.rbegin(); state != path.rend(); ++state) {
        if ((*state)->change == StateChange::Remove)
            held.erase((*state)->edit.id);
        else
            held[(*state)->edit.id] = (*state)->edit;
    }
    std::vector<EditRef> edits;
    for (const auto& [edit_id, edit] : held) edits.push_back(edit);
    std::stable_sort(edits.begin(), edits.end(), [&](const EditRef& a, const EditRef& b) {
        return edits_.at(a).step < edits_.at(b).step;
    });
    return edits;
}

std::optional<EditRef> History::find(EditId id) const {
    for (const EditRef& edit : edits_of(current_))
        if (edit.id == id) return edit;
    return std::nullopt;
}

EditRef History::held(EditId id) const {
    if (const auto edit = find(id)) return *edit;
    throw UsageError("the current state has no " + edit_text(id) + "; see its edits with log");
}

std::vector<HistoryEntry> History::entries() const {
    std::vector<HistoryEntry> entries;
    Walk trunk;
    std::map<std::string, Walk> branches;
    for (const EditRef& edit : edits_of(current_)) {
        const std::string& variant = edits_.at(edit).variant;
        // All edits of the trunk come before those of the variants, so the walk along the trunk is
        // complete here.
        Walk& walk = variant.empty() ? trunk : branches.try_emplace(variant, trunk).first->second;
        entries.push_back(next_entry(*this, edit, walk));
    }
    return entries;
}

std::vector<HistoryEntry> History::line(const std::string& variant) const {
    std::vector<HistoryEntry> result = entries();
    std::erase_if(result,
                  [&](const HistoryEntry& entry) { return !is_part_of(entry.place, variant); });
    return result;
}

std::vector<std::string> History::variants() const {
    std::set<std::string> names;
    for (const EditRef& edit : edits_of(current_))
        if (const auto& variant = edits_.at(edit).variant; !variant.empty()) names.insert(variant);
    return {names.begin(), names.end()};
}

Step History::first_variant_step() const {
    const std::vector<EditRef> edits = edits_of(current_);
    const bool shared = std::any_of(edits.begin(), edits.end(), [&](const EditRef& edit) {
        const EditPlace& place = edits_.at(edit);
        return place.variant.empty() && belongs_to_variant(place.step);
    });
    return shared ? Step::Deformation : Step::Openings;
}

const HistoryResult* History::result_of(EditRef edit, ResultId input) const {
    const auto found = result_by_input_.find({edit, input});
    return found == result_by_input_.end() ? nullptr : &results_.at(found->second);
}

const HistoryResult* History::newest_result_of(EditRef edit) const {
    for (auto result = results_.rbegin(); result != results_.rend(); ++result)
        if (result->second.edit == edit && result->second.stale_reason.empty())
            return &result->second;
    return nullptr;
}

void History::add_state(StateChange change, EditRef edit) {
    const StateId id = states_.rbegin()->first + 1;
    states_[id] = {id, current_, change, edit, 0};
    states_[current_].last_child = id;
    current_ = id;
}

EditRef History::apply(const EditPlace& place) {
    const EditRef edit{edits_.empty() ? 1 : edits_.rbegin()->first.id + 1, 1};
    edits_[edit] = place;
    add_state(StateChange::Apply, edit);
    return edit;
}

EditRef History::change(EditId id) {
    const EditPlace place = edits_.at(held(id));
    EditRef next{id, 1};
    while (edits_.contains(next)) ++next.revision;
    edits_[next] = place;
    add_state(StateChange::Change, next);
    return next;
}

void History::remove(EditId id) {
    add_state(StateChange::Remove, held(id));
}

void History::undo() {
    if (current_ == 0) throw UsageError("there is nothing to undo");
    const StateId parent = state(current_).parent;
    states_[parent].last_child = current_;
    current_ = parent;
}

void History::redo() {
    const StateId child = state(current_).last_child;
    if (child == 0) throw UsageError("there is nothing to redo");
    current_ = child;
}

void History::undo_before(EditId id) {
    require_known(id, edits_);
    for (StateId at = current_; at != 0; at = state(at).parent)
        if (state(at).edit.id == id && state(at).change != StateChange::Remove) {
            while (current_ != at) undo();
            undo();
            return;
        }
    throw UsageError(edit_text(id) +
                     " is not among those that led to the current state; see them with log");
}

void History::redo_to(EditId id) {
    require_known(id, edits_);
    for (StateId at = state(current_).last_child; at != 0; at = state(at).last_child)
        if (state(at).edit.id == id) {
            while (current_ != at) redo();
            return;
        }
    throw UsageError("nothing that was undone from the current state is " + edit_text(id));
}

void History::jump(StateId id) {
    const StateId target = state(id).id;
    for (StateId at = target; at != 0; at = state(at).parent)
        states_[state(at).parent].last_child = at;
    current_ = target;
}

ResultId History::add_result(EditRef edit, ResultId input, std::string stale_reason) {
    const ResultId id = results_.empty() ? 1 : results_.rbegin()->first + 1;
    results_[id] = {id, edit, input, std::move(stale_reason)};
    result_by_input_[{edit, input}] = id;
    return id;
}

}  // namespace vesselbench
