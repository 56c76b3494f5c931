#include "workbench/window/case/rail.h"

#include <algorithm>
#include <array>

#include "geometry/kernel/catalogue.h"
#include "workbench/case/diagnostic_words.h"
#include "workbench/operations/table.h"
#include "workbench/report/log_json.h"
#include "workbench/window/case/argument_words.h"
#include "workbench/window/case/edit_places.h"
#include "workbench/window/case/message.h"
#include "workbench/window/case/stroke_request.h"

namespace vesselbench {

namespace {

struct StepText {
    const char* title;
    const char* purpose;
};

constexpr std::array<StepText, 9> kSteps = {
    {{"Source", "Load an image or a surface, extract and repair it"},
     {"Branches", "Remove branches that the model does not need"},
     {"Local repair", "Correct bumps, narrowings and holes by hand"},
     {"Openings", "Cut the vessel's ends, cap and extend them"},
     {"Smoothing", "Remove staircases and noise, keep the caps"},
     {"Deformation", "Pose branches for a print"},
     {"Remeshing", "Make well-shaped triangles"},
     {"Product", "Fill with tetrahedra, or check for printing"},
     {"Review", "Check, compare, export"}}};

RailEdit rail_edit(const LogEntry& entry) {
    const EditRecord& edit = entry.edit;
    RailEdit row{.id = edit.edit.id,
                 .revision = edit.edit.revision,
                 .operation = edit.operation,
                 .arguments = arguments_text(edit),
                 .status = entry.status,
                 .reason = entry.status == EditStatus::Stale ? reason_of(entry) : "",
                 .places = places_of_edit(entry)};
    if (entry.result) {
        row.change = effect_text(*entry.result);
        for (const Diagnostic& warning : entry.result->warnings)
            (is_note(warning) ? row.notes : row.warnings)
                .push_back(worded(warning, {.window = true}));
    }
    return row;
}

}  // namespace

bool makes_strokes(const std::string& name) {
    const Operation* operation = known_operation(name);
    return operation != nullptr && is_brush(*operation);
}

std::string arguments_text(const EditRecord& edit) {
    const Operation* operation = known_operation(edit.operation);
    return operation == nullptr ? "an operation of another version"
                                : argument_words(*operation, edit.given);
}

std::string title_of(Step step) {
    return kSteps.at(static_cast<std::size_t>(step) - 1).title;
}

std::vector<RailStep> empty_rail() {
    std::vector<RailStep> rail;
    for (std::size_t i = 0; i < kSteps.size(); ++i)
        rail.push_back({.step = static_cast<Step>(i + 1),
                        .title = kSteps[i].title,
                        .purpose = kSteps[i].purpose});
    return rail;
}

std::vector<RailStep> rail_of(const Snapshot& snapshot, const std::string& variant) {
    std::vector<RailStep> rail = empty_rail();
    for (const LogEntry& entry : snapshot.log)
        if (is_part_of(entry.edit.place, variant))
            rail.at(static_cast<std::size_t>(entry.edit.place.step) - 1)
                .edits.push_back(rail_edit(entry));
    for (RailStep& step : rail)
        step.state = state_of(step, {.first = 0, .count = step.edits.size()});
    return rail;
}

std::vector<RailRow> rail_rows(const RailStep& step) {
    std::vector<RailRow> rows;
    for (std::size_t i = 0; i < step.edits.size(); ++i) {
        const RailEdit& edit = step.edits[i];
        const bool continues =
            i > 0 && makes_strokes(edit.operation) && step.edits[i - 1].operation == edit.operation;
        if (continues)
            ++rows.back().count;
        else
            rows.push_back({.first = i, .count = 1});
    }
    return rows;
}

StepState state_of(const RailStep& step, const RailRow& row) {
    StepState worst = StepState::Empty;
    for (std::size_t i = row.first; i < row.first + row.count; ++i)
        worst = std::max(worst, state_of(step.edits[i]));
    return worst;
}

StepState state_of(const RailEdit& edit) {
    if (edit.status == EditStatus::Stale) return StepState::Stale;
    if (edit.status == EditStatus::Pending) return StepState::Pending;
    return edit.warnings.empty() ? StepState::Done : StepState::Warnings;
}

const LogEntry* find_entry(const Snapshot& snapshot, EditId edit) {
    const auto found = std::ranges::find_if(
        snapshot.log, [&](const LogEntry& entry) { return entry.edit.edit.id == edit; });
    return found == snapshot.log.end() ? nullptr : &*found;
}

const LogEntry* first_stale(const Snapshot& snapshot, const std::string& variant) {
    const auto found = std::ranges::find_if(snapshot.log, [&](const LogEntry& entry) {
        return entry.status == EditStatus::Stale && is_part_of(entry.edit.place, variant);
    });
    return found == snapshot.log.end() ? nullptr : &*found;
}

int pending_count(const Snapshot& snapshot, const std::string& variant) {
    return static_cast<int>(std::ranges::count_if(snapshot.log, [&](const LogEntry& entry) {
        return entry.status == EditStatus::Pending && is_part_of(entry.edit.place, variant);
    }));
}

std::size_t warning_count(const Snapshot& snapshot, const std::string& variant) {
    std::size_t count = 0;
    for (const LogEntry& entry : snapshot.log)
        if (entry.result && is_part_of(entry.edit.place, variant))
            count += static_cast<std::size_t>(std::ranges::count_if(
                entry.result->warnings, [](const Diagnostic& one) { return !is_note(one); }));
    return count;
}

}  // namespace vesselbench
