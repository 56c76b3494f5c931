#include "workbench/window/features/review/edit_blink.h"

#include <algorithm>

#include "workbench/window/case/edit_input.h"
#include "workbench/window/features/compare/compare_feature.h"

namespace vesselbench {

namespace {

std::optional<EditInput> start_of(const Document& document, EditId edit) {
    if (!document.is_open()) return std::nullopt;
    return input_of({.edit = edit}, *document.snapshot()->history, document.variant());
}

/// The edit behind another one in the shown variant, before which the model is the one after that.
std::optional<EditSite> site_behind(const Document& document, EditId edit) {
    const std::vector<HistoryEntry> line = document.snapshot()->history->line(document.variant());
    auto found = std::ranges::find(line, edit, [](const HistoryEntry& e) { return e.edit.id; });
    if (found == line.end() || ++found == line.end()) return std::nullopt;
    return EditSite{.edit = found->edit.id};
}

}  // namespace

std::string EditBlink::why_not(EditId edit) const {
    const auto start = start_of(core_.document, edit);
    if (!start) return "no model precedes it";
    return start->has_pending ? "pending edits before it have not run" : "";
}

void EditBlink::start(EditId edit) {
    if (!why_not(edit).empty()) return;
    stop();
    const EditStart start{.edit = edit, .result = start_of(core_.document, edit)->result};
    core_.document.stand_before(site_behind(core_.document, edit));
    core_.get<CompareFeature>().compare(start, CompareMode::Blink);
    edit_ = edit;
    changes_ = core_.document.snapshot_changes();
}

bool EditBlink::compares() const {
    const auto& comparison = core_.get<CompareFeature>().comparison();
    if (!edit_ || !comparison) return false;
    const auto* start = std::get_if<EditStart>(&comparison->reference());
    return start != nullptr && start->edit == *edit_;
}

/// The model that stands before an edit belongs to a form, if one is open.
void EditBlink::stop() {
    if (!edit_) return;
    if (compares()) core_.get<CompareFeature>().stop();
    if (!core_.form()) core_.document.stand_before({});
    edit_.reset();
}

void EditBlink::update() {
    if (edit_ && (!compares() || changes_ != core_.document.snapshot_changes())) stop();
}

}  // namespace vesselbench
