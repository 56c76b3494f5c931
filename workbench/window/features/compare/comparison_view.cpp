#include "workbench/window/features/compare/comparison_view.h"

#include <cmath>

#include <imgui.h>

#include "workbench/window/case/readable.h"
#include "workbench/window/core/core.h"
#include "workbench/window/core/shown.h"
#include "workbench/window/features/compare/compare_feature.h"
#include "workbench/window/widgets/controls.h"
#include "workbench/window/widgets/ui.h"

namespace vesselbench {

namespace {

float half_of(const ScreenRect& view) {
    return std::floor(view.width / 2);
}

std::string title_of(const Core& core, StateId state) {
    for (const HistoryRow& row : core.history().rows)
        if (row.state == state) return readable(row.title);
    return "";
}

/// "edit 3, Smooth"
std::string edit_title(const Core& core, EditId edit) {
    const LogEntry* entry = find_entry(*core.document.snapshot(), edit);
    return "edit " + std::to_string(edit) +
           (entry == nullptr ? "" : ", " + readable(entry->edit.operation));
}

std::string shown_title(const Core& core) {
    const Document& document = core.document;
    if (document.previewed()) return "preview of " + document.previewed()->edit().operation;
    return title_of(core, document.snapshot()->history->current());
}

/// A text on a plate, centred at the lower end of a part of the view.
void draw_label(const Ui& ui, const ScreenRect& part, const std::string& title) {
    const std::string words = fitted(title, part.width - ui.em * 14);
    const ImVec2 size = ImGui::CalcTextSize(words.c_str());
    const ImVec2 from{part.middle_x() - size.x / 2 - ui.grid(1),
                      part.y + part.height - size.y - ui.grid(3)};
    const ImVec2 to{from.x + size.x + ui.grid(2), from.y + size.y + ui.grid(1)};
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddRectFilled(from, to, faded(ui.theme.panel, 0.9), ImGui::GetStyle().FrameRounding);
    draw.AddText({from.x + ui.grid(1), from.y + ui.grid(0.5F)}, ui.theme.text, words.c_str());
}

}  // namespace

void ComparisonView::update(PanelContext& c) {
    std::optional<Comparison>& comparison = c.core.get<CompareFeature>().comparison();
    if (!comparison) return forget();
    if (mode_ == CompareMode::Blink && c.shown.keys.has(KeyCommand::SwitchComparison))
        comparison->switch_by_hand();
    comparison->blink(ImGui::GetTime());
    take(c, *comparison);
}

void ComparisonView::forget() {
    static_cast<void>(model_.update());  // drops a layout that has ended meanwhile
    if (!mode_) return;
    mode_.reset();
    model_.show(nullptr);
    reference_.reset();
    hides_model_ = false;
    difference_.reset();
    ++version_;
}

void ComparisonView::take(PanelContext& c, Comparison& comparison) {
    const bool same = mode_ == comparison.mode() && hides_model_ == comparison.blinks_reference();
    mode_ = comparison.mode();
    hides_model_ = comparison.blinks_reference();
    if (reference_ != comparison.reference() || seen_scenes_ != comparison.scene_changes()) {
        reference_ = comparison.reference();
        seen_scenes_ = comparison.scene_changes();
        model_.show(comparison.scene());
    }
    difference_ = comparison.difference() ? comparison.difference()->map : nullptr;
    if (const auto* start = std::get_if<EditStart>(&*reference_)) {
        reference_title_ = "Before " + edit_title(c.core, start->edit);
        shown_title_ = "After " + edit_title(c.core, start->edit);
    } else {
        reference_title_ = "Reference: " + title_of(c.core, std::get<StateId>(*reference_));
        shown_title_ = "Shown: " + shown_title(c.core);
    }
    if (model_.update() || !same) ++version_;
}

ScreenRect ComparisonView::room_for_model(const ScreenRect& view) const {
    if (!is_split()) return view;
    const float half = half_of(view);
    return {view.x + half, view.y, view.width - half, view.height};
}

float ComparisonView::shift_to_model(const ScreenRect& view, float x) const {
    return is_split() && x < view.x + half_of(view) ? half_of(view) : 0;
}

void ComparisonView::draw(Renderer& renderer, SceneView view, const ViewLook& look,
                          double edge_width) const {
    if (!is_split() && !hides_model_) return;
    if (is_split()) {
        // The shown model's part begins where the reference's ends.
        view.rectangle.width = view.rectangle.x;
        view.rectangle.x = 0;
    }
    ViewLook own = look;
    own.deviation = false;
    renderer.draw(view, model_.layers(own, edge_width));
}

void ComparisonView::draw_labels(const Ui& ui, const ScreenRect& view) const {
    if (is_split()) {
        const float half = half_of(view);
        ImGui::GetWindowDrawList()->AddLine({view.x + half, view.y},
                                            {view.x + half, view.y + view.height}, ui.theme.border);
        draw_label(ui, {view.x, view.y, half, view.height}, reference_title_);
        draw_label(ui, room_for_model(view), shown_title_);
    } else if (mode_ == CompareMode::Blink) {
        draw_label(ui, view, hides_model_ ? reference_title_ : shown_title_);
    }
}

}  // namespace vesselbench
