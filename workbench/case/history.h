#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "workbench/case/operation.h"

namespace vesselbench {

using EditId = std::int64_t;    ///< permanent; 1, 2, ... in the order the edits were first made
using StateId = std::int64_t;   ///< 0 is the empty case every history starts from
using ResultId = std::int64_t;  ///< 0 is the empty scene

/// One form of an edit: changing its arguments makes the next revision of the same edit. An
/// expert's verdict refers to both.
struct EditRef {
    EditId id = 0;
    int revision = 1;

    auto operator<=>(const EditRef&) const = default;
};

/// The place of an edit in the case.
struct EditPlace {
    Step step = Step::Source;
    std::string variant;  ///< "cfd", "rp", ...; empty: the trunk of all variants

    bool operator==(const EditPlace&) const = default;
};

/// True for the steps whose edits belong to a variant: openings to product. What an opening is for
/// decides how it is made; steps 1-3 are the trunk.
[[nodiscard]] bool belongs_to_variant(Step step);

/// True for the edits that a variant consists of: the trunk's and its own.
[[nodiscard]] bool is_part_of(const EditPlace& place, const std::string& variant);

enum class StateChange : std::uint8_t { Start, Apply, Change, Remove };

/// A node of the history's tree: its parent, and the one edit by which it differs.
struct HistoryState {
    StateId id = 0;
    StateId parent = 0;
    StateChange change = StateChange::Start;
    EditRef edit;            ///< the edit applied, changed (its new revision) or removed
    StateId last_child = 0;  ///< the child last visited; 0: none. The target of redo
};

/// The result of an edit on a certain input.
struct HistoryResult {
    ResultId id = 0;
    EditRef edit;
    ResultId input = 0;        ///< the result it ran on
    std::string stale_reason;  ///< if not empty, the edit does not apply; its input passes through
    bool dropped = false;  ///< its scene was dropped to save space: the edit is pending there again
};

enum class EditStatus : std::uint8_t {
    Done,     ///< it has run on the result before it
    Pending,  ///< an edit before it changed; it runs when its result is shown or exported
    Stale     ///< it no longer applies to the result before it
};

[[nodiscard]] std::string to_string(EditStatus status);

/// An edit of a state with its result there, as far as known.
struct HistoryEntry {
    EditRef edit;
    EditPlace place;
    EditStatus status = EditStatus::Pending;
    ResultId result = 0;  ///< Done: its result. Stale: the result with the reason. Pending: 0
    ResultId input = 0;   ///< the result it ran on or would run on; undefined after a pending edit
    std::string reason;   ///< of a stale edit
};

/// The tree of states (DESIGN 1), a value. A state is the list of its edits, ordered by step, then
/// time; applying, changing or removing an edit makes a child state, and nothing is ever thrown
/// away. Whether an edit is done is not stored but follows from the known results: an edit is done
/// if its revision has run on exactly the result before it.
class History {
public:
    History();

    /// Rebuilds a stored history. \throw InvalidInput if it contradicts itself
    History(std::map<EditRef, EditPlace> edits, std::vector<HistoryState> states,
            std::vector<HistoryResult> results, StateId current);

    [[nodiscard]] StateId current() const { return current_; }

    [[nodiscard]] const std::map<StateId, HistoryState>& states() const { return states_; }

    [[nodiscard]] const std::map<EditRef, EditPlace>& edits() const { return edits_; }

    [[nodiscard]] const std::map<ResultId, HistoryResult>& results() const { return results_; }

    /// \throw UsageError if there is no such state
    [[nodiscard]] const HistoryState& state(StateId id) const;

    /// The revision of an edit in the current state; empty if the state does not contain it.
    [[nodiscard]] std::optional<EditRef> find(EditId id) const;

    /// All edits of the current state, by step, then time.
    [[nodiscard]] std::vector<HistoryEntry> entries() const;

    /// The edits that make one variant of the current state: the trunk's, then the variant's. An
    /// unknown variant has the trunk's only.
    [[nodiscard]] std::vector<HistoryEntry> line(const std::string& variant) const;

    /// Names of the variants that have edits in the current state, ascending.
    [[nodiscard]] std::vector<std::string> variants() const;

    /// The first step whose new edits belong to a variant: openings. In a project whose trunk has
    /// edits of openings or smoothing, it is deformation: further ones join them there, because the
    /// whole trunk precedes the variants.
    [[nodiscard]] Step first_variant_step() const;

    /// The result of an edit on an input, if it ever ran on it and was not dropped.
    [[nodiscard]] const HistoryResult* result_of(EditRef edit, ResultId input) const;

    /// The newest result of this revision that is not stale, on any input.
    [[nodiscard]] const HistoryResult* newest_result_of(EditRef edit) const;

    /// Adds a new edit after the edits of its step: a child state. \return the new edit
    EditRef apply(const EditPlace& place);

    /// A new revision of an edit in its old place: a child state.
    /// \throw UsageError if the current state does not contain it
    EditRef change(EditId id);

    /// Leaves an edit out: a child state. \throw UsageError if the current state lacks it
    void remove(EditId id);

    /// To the parent. \throw UsageError at the start
    void undo();
    /// To the child last visited. \throw UsageError if there is none
    void redo();
    /// Back to the state before the current revision of an edit was made.
    /// \throw UsageError if the current state does not come from one
    void undo_before(EditId id);
    /// Forward along the children last visited until the edit is made, changed or removed.
    /// \throw UsageError if none of them does
    void redo_to(EditId id);
    /// To any state. \throw UsageError if there is none with this id
    void jump(StateId id);

    ResultId add_result(EditRef edit, ResultId input, std::string stale_reason = {});

private:
    [[nodiscard]] std::vector<EditRef> edits_of(StateId id) const;
    void add_state(StateChange change, EditRef edit);
    [[nodiscard]] EditRef held(EditId id) const;

    std::map<EditRef, EditPlace> edits_;
    std::map<StateId, HistoryState> states_;
    std::map<ResultId, HistoryResult> results_;
    std::map<std::pair<EditRef, ResultId>, ResultId> result_by_input_;
    StateId current_ = 0;
};

}  // namespace vesselbench
