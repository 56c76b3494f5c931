#pragma once

#include <string>
#include <vector>

#include "workbench/session/snapshot.h"

namespace vesselbench {

enum class StepState { Empty, Done, Warnings, Pending, Stale };

/// An edit as the rail lists it.
struct RailEdit {
    EditId id = 0;
    int revision = 1;
    std::string operation;
    std::string arguments;  ///< as argument_words()
    EditStatus status = EditStatus::Done;
    std::string reason;  ///< of a stale edit
    std::string change;  ///< "volume -2.1 %, moved up to 0.31 mm"
    std::vector<std::string> warnings;
    std::vector<std::string> notes;  ///< what is_note()
    Positions places;                ///< where it was made; empty: on the whole surface
};

/// A step with the edits of the current state.
struct RailStep {
    Step step = Step::Source;
    std::string title;    ///< "Local repair"
    std::string purpose;  ///< what it is for, one line
    StepState state = StepState::Empty;
    std::vector<RailEdit> edits;
};

/// Edits of a step that a list shows in one row: strokes of one brush that follow one another, or
/// any other single edit.
struct RailRow {
    std::size_t first = 0, count = 1;  ///< of the step's edits
};

[[nodiscard]] std::vector<RailRow> rail_rows(const RailStep& step);

/// The worst of the states of a row's edits.
[[nodiscard]] StepState state_of(const RailStep& step, const RailRow& row);

/// The nine steps in order. \param variant whose edits are listed from openings on
[[nodiscard]] std::vector<RailStep> rail_of(const Snapshot& snapshot, const std::string& variant);

/// The nine steps of a case that is not open.
[[nodiscard]] std::vector<RailStep> empty_rail();

/// "Local repair"
[[nodiscard]] std::string title_of(Step step);

/// An edit's arguments as lists show them.
[[nodiscard]] std::string arguments_text(const EditRecord& edit);

/// True for the name of a brush: its edits are strokes.
[[nodiscard]] bool makes_strokes(const std::string& operation);

/// How an edit is marked; never empty.
[[nodiscard]] StepState state_of(const RailEdit& edit);

/// Null if there is no such edit in the current state.
[[nodiscard]] const LogEntry* find_entry(const Snapshot& snapshot, EditId edit);

/// The first edit of the variant's model that no longer applies; null: none.
[[nodiscard]] const LogEntry* first_stale(const Snapshot& snapshot, const std::string& variant);

/// Number of pending edits that the variant's model consists of.
[[nodiscard]] int pending_count(const Snapshot& snapshot, const std::string& variant);

/// Number of warnings of the edits that the variant's model consists of.
[[nodiscard]] std::size_t warning_count(const Snapshot& snapshot, const std::string& variant);

}  // namespace vesselbench
