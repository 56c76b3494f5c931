#include "workbench/window/form/form_desk.h"

#include <algorithm>
#include <utility>

#include "workbench/operations/table.h"
#include "workbench/window/case/rail.h"
#include "workbench/window/case/stroke_request.h"
#include "workbench/window/form/picked_text.h"

namespace vesselbench {

FormDesk::FormDesk(const DocumentOptions& options)
    : document(options), automatic_(options.wake), labels_(options.wake) {}

void FormDesk::take_entered() {
    if (std::exchange(seen_entered_, document.entered()) == document.entered()) return;
    if (applied_form_ == form_number_) end_applied_form();
}

// What is dragged is followed by the model: a search would take its time.
bool FormDesk::update_field_values() {
    const bool automatic = !before_drag_ && automatic_.update(document, form_ ? &*form_ : nullptr);
    return labels_.update(document, form_ ? &*form_ : nullptr) || automatic;
}

void FormDesk::end_applied_form() {
    form_.reset();
    wanted_field_.clear();
    disarm();
    end_drag();
    document.stand_before({});
}

// --- the form

void FormDesk::choose_step(Step step) {
    leave_form();
    step_ = step;
}

void FormDesk::choose(const std::string& operation, std::optional<Step> step) {
    const Operation& chosen = find_operation(operation);
    drop_form();
    const bool fits = step && std::ranges::count(chosen.allowed, *step) > 0;
    step_ = fits ? *step : chosen.usual_step;
    document.stand_before(EditSite{.edit = {}, .step = step_});
    form_.emplace(chosen, suggested_arguments(chosen));
    show_form();
    if (!is_brush(form_->operation())) arm_required();
}

void FormDesk::show_form() {
    ++form_number_;
    for_listeners([](FormListener& each) { each.form_shown(); });
}

/// What the form of a new edit starts with.
Arguments FormDesk::suggested_arguments(const Operation& operation) const {
    const Scene* scene = document.current();
    if (operation.suggested == nullptr || scene == nullptr) return {};
    return operation.suggested(*scene, document.variant());
}

/// What has to be picked is picked at once.
void FormDesk::arm_required() {
    for (const FormField& field : form_->fields())
        if (field.parameter->required && pick_target(*field.parameter))
            return arm(field.parameter->name);
}

void FormDesk::choose_edit(EditId edit) {
    drop_form();
    const LogEntry* entry = find_entry(*document.snapshot(), edit);
    const Operation* operation =
        entry == nullptr ? nullptr : known_operation(entry->edit.operation);
    if (operation == nullptr) return document.stand_before({});
    form_.emplace(*operation, entry->edit);
    show_form();
    step_ = entry->edit.place.step;
    document.stand_before(EditSite{.edit = edit, .step = step_});
}

void FormDesk::leave_form() {
    drop_form();
    document.stand_before({});
}

void FormDesk::drop_form() {
    for_listeners([](FormListener& each) { each.form_dropped(); });
    document.drop_preview();
    if (form_) document.forget_failure();
    form_.reset();
    wanted_field_.clear();
    disarm();
    end_drag();
    previewed_changes_ = -1;
}

std::string FormDesk::command() const {
    const std::filesystem::path& project = document.project();
    return form_ ? form_->as_command(project.string(), document.variant(), step_) : "";
}

// --- its fields

void FormDesk::set_field(const std::string& parameter, const std::string& text) {
    const int before = form_->changes();
    form_->set(parameter, text);
    if (form_->changes() == before) return;
    for_listeners([](FormListener& each) { each.field_changed(); });
    document.forget_failure();
    document.drop_preview();
}

void FormDesk::fill_form(const std::vector<FieldText>& texts) {
    if (!form_) return;
    for (const FieldText& field : texts) set_field(field.parameter, field.text);
}

void FormDesk::reset_form() {
    disarm();
    form_->reset();
    document.forget_failure();
    document.drop_preview();
}

// --- running it

bool FormDesk::can_apply() const {
    return form_ && form_->valid() && listeners_allow_apply() && can_change();
}

bool FormDesk::preview_is_current() const {
    return document.previewed() && form_ && previewed_changes_ == form_->changes();
}

void FormDesk::preview() {
    if (!form_ || !form_->valid() || !listeners_allow_apply() ||
        !document.can(RequestKind::Preview))
        return;
    want_model();
    previewed_changes_ = form_->changes();
    if (form_->edit())
        document.preview_change(*form_->edit(), form_->arguments());
    else
        document.preview(form_->operation().name, form_->arguments(), step_);
}

void FormDesk::apply() {
    if (!can_apply()) return;
    applied_form_ = form_number_;
    for_listeners([](FormListener& each) { each.applying(); });
    if (preview_is_current()) return document.commit_preview();
    if (form_->edit())
        document.change(*form_->edit(), form_->arguments());
    else
        document.apply(form_->operation().name, form_->arguments(), step_);
}

void FormDesk::apply_and_run() {
    if (!can_apply()) return;
    apply();
    document.run_following();
}

Rerun FormDesk::following() const {
    if (!form_ || !document.is_open()) return {};
    return rerun_after({.edit = form_->edit(), .step = step_}, *document.snapshot(),
                       document.variant());
}

// --- clicks

void FormDesk::arm(const std::string& parameter) {
    if (armed_ == parameter) return disarm();
    armed_ = parameter;
    want_model();
    const std::optional<PickTarget> target = armed_target();
    if (target) for_listeners([&](FormListener& each) { each.parameter_armed(*target); });
    document.drop_preview();
}

std::optional<PickTarget> FormDesk::armed_target() const {
    if (!form_ || armed_.empty()) return std::nullopt;
    const FormField& field = form_->field(armed_);
    return field.active ? pick_target(*field.parameter) : std::nullopt;
}

void FormDesk::pick(const Vec3& point) {
    const std::optional<PickTarget> target = armed_target();
    if (!target || target == PickTarget::Labels || document.is_reading()) return;
    set_field(armed_, picked_text(*target, form_->field(armed_).text, point));
    if (is_complete(*target, form_->field(armed_).text)) disarm();
}

void FormDesk::pick_label(int label) {
    if (armed_target() == PickTarget::Labels)
        set_field(armed_, picked_labels(form_->field(armed_).text, label));
}

void FormDesk::want_model() {
    for_listeners([](FormListener& each) { each.model_wanted(); });
}

// --- drags

int FormDesk::begin_drag() {
    before_drag_ = form_;
    return ++drags_;
}

void FormDesk::drag(const std::vector<FieldText>& texts) {
    if (before_drag_) fill_form(texts);
}

void FormDesk::cancel_drag() {
    const std::optional<OperationForm> before = std::exchange(before_drag_, std::nullopt);
    if (form_ && before) bring_back(*before);
}

void FormDesk::end_drag() {
    dragged_ = std::exchange(before_drag_, std::nullopt);
    if (!form_) dragged_.reset();
    dragged_changes_ = form_ ? form_->changes() : -1;
}

bool FormDesk::take_back_drag() {
    const std::optional<OperationForm> before = std::exchange(dragged_, std::nullopt);
    if (!before || !form_ || form_->changes() != dragged_changes_ ||
        before->changes() == dragged_changes_)
        return false;
    bring_back(*before);
    return true;
}

void FormDesk::bring_back(const OperationForm& before) {
    for (const FormField& field : before.fields()) set_field(field.parameter->name, field.text);
    for_listeners([](FormListener& each) { each.drag_undone(); });
}

}  // namespace vesselbench
