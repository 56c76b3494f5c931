#include "workbench/window/panels/export_choices.h"

#include <exception>

#include "geometry/kernel/wording.h"
#include "workbench/export/flow_parameters.h"
#include "workbench/window/case/readable.h"
#include "workbench/window/fields/form_fields.h"
#include "workbench/window/widgets/controls.h"
#include "workbench/window/widgets/ui.h"
#include "workbench/window/workplace/workplace.h"

namespace vesselbench {

void ExportChoices::begin(PanelContext& c) {
    state_.reset();
    problem_.clear();
    form_.reset();
    meant_ = {-1, -1};
    const Document& document = c.place.document;
    reading_ = document.runner()->submit(
        [project = document.project(), variant = document.variant()](
            Session& session, const Progress&) { return export_state(session, project, variant); },
        "export state");
}

void ExportChoices::poll() {
    if (!reading_.poll()) return;
    problem_ = reading_.problem();
    const auto read = reading_.newest();
    if (!read) return;
    state_ = *read;
    form_.emplace(flow_table(), state_->flow.given());
}

std::string ExportChoices::refusal() const {
    if (!problem_.empty()) return readable_sentence(problem_);
    if (!state_) return "The project is being read";
    if (!state_->refusal.empty()) return readable_sentence(state_->refusal);
    return form_->valid() ? "" : readable_sentence(form_->error());
}

std::string ExportChoices::doubt() const {
    return state_ && state_->unsettled ? "The model's review is " + state_->review : "";
}

void ExportChoices::draw_review(PanelContext& c) const {
    if (!state_ || state_->review.empty()) return;
    const bool bad = state_->unsettled || !state_->refusal.empty();
    wrapped(c.ui, "Review: " + state_->review, bad ? c.ui.theme.warning : c.ui.theme.muted);
}

void ExportChoices::draw_flow(PanelContext& c) {
    if (!form_) return;
    group_heading(c.ui, "Flow");
    space(c.ui, 0.5F);
    draw_meaning(c);
    const auto set = [&](const std::string& parameter, const std::string& text) {
        form_->set(parameter, text);
    };
    const Parameter* parameter =
        draw_form_fields(c, *form_, {.prefix = "export.flow.", .set = set, .in_view = false});
    if (parameter != nullptr)
        tooltip(c.ui, readable(parameter->name) + ": " + parameter->help + ".");
}

void ExportChoices::draw_meaning(PanelContext& c) {
    const Scene* scene = c.place.document.newest();
    if (scene == nullptr || !scene->surface || !form_->valid()) return;
    const std::pair now{form_->changes(), c.place.document.scene_changes()};
    if (meant_ != now) meaning_ = meaning(*scene->surface);
    meant_ = now;
    wrapped(c.ui, meaning_, c.ui.theme.muted);
    space(c.ui, 0.5F);
}

std::string ExportChoices::meaning(const Surface& surface) const {
    try {
        CfdParameters parameters = flow_from(form_->arguments());
        if (!parameters.split) parameters.split = state_->split;
        std::string text;
        for (const InletFlow& inlet : flow_summary(surface, parameters).inlets)
            text += (text.empty() ? "" : "\n") + inlet.name + ": " + readable_number(inlet.flow) +
                    " cm³/s, mean velocity " + readable_number(inlet.mean_velocity) +
                    " m/s, Reynolds number " + readable_number(inlet.reynolds);
        return text;
    } catch (const std::exception& error) {
        return readable_sentence(error.what());
    }
}

std::optional<FlowSettings> ExportChoices::flow() const {
    return form_ ? std::optional(FlowSettings(form_->arguments())) : std::nullopt;
}

}  // namespace vesselbench
