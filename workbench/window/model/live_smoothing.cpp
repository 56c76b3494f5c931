#include "workbench/window/model/live_smoothing.h"

#include <algorithm>
#include <utility>

#include "geometry/kernel/measure.h"
#include "geometry/kernel/wording.h"
#include "workbench/window/model/later_edits.h"
#include "workbench/window/model/readable.h"

namespace vesselbench {

namespace {

constexpr double kPatience = 0.25;   ///< with a question, before a newer one ends it [s]
constexpr double kSameShape = 1e-5;  ///< by the diagonal: a device's rounding stays below it [-]

std::map<std::string, double> numbers_in(const Arguments& arguments) {
    std::map<std::string, double> numbers;
    for (const auto& [name, value] : arguments.values())
        if (const auto* real = std::get_if<double>(&value))
            numbers[name] = *real;
        else if (const auto* count = std::get_if<std::int64_t>(&value))
            numbers[name] = static_cast<double>(*count);
    return numbers;
}

}  // namespace

LiveSmoothing::LiveSmoothing(std::function<void()> wake)
    : models_(std::move(wake), live_modelling()) {}

// --- following the form

std::string LiveSmoothing::reason_against(const Followed& followed) const {
    const Document& document = followed.document;
    const Scene* scene = document.current();
    if (followed.form->edit()) return "an earlier edit is being changed: use Preview";
    if (scene == nullptr || !scene->surface || scene->surface->empty())
        return "there is no surface yet";
    if (!document.snapshot()) return "no case is open";
    const auto line = document.snapshot()->history->line(document.variant());
    if (edit_behind(line, followed.step) != nullptr)
        return "edits of later steps follow: use Preview";
    return "";
}

/// Another model to be smoothed has another number.
void LiveSmoothing::take_base(const Followed& followed) {
    const Scene* scene = followed.document.current();
    const auto positions = scene != nullptr && scene->surface ? scene->surface->positions : nullptr;
    if (positions == base_positions_) return;
    base_positions_ = positions;
    ++base_;
    shown_.reset();
    models_.forget();
}

bool LiveSmoothing::update(const Followed& followed) {
    const Operation* operation =
        followed.form != nullptr && followed.form->operation().search.smoothing != nullptr
            ? &followed.form->operation()
            : nullptr;
    has_form_ = operation != nullptr;
    if (std::exchange(operation_, operation) != operation || !has_form_) follow(false);
    if (!has_form_) {
        why_not_.clear();
        return models_.update();
    }
    take_base(followed);
    why_not_ = reason_against(followed);
    axes_ = usable_axes(*followed.form, wanted_axes_);
    if (!why_not_.empty()) follow(false);
    const bool changed = models_.update();
    if (on_) ask(followed);
    const bool seen = on_ && !followed.document.previewed();
    const auto before = std::exchange(shown_, seen ? models_.newest() : nullptr);
    return changed || before != shown_;
}

/// True while the figures of the last question are about to come: values that change in every frame
/// would otherwise keep all of them from being seen.
bool LiveSmoothing::is_worked_on() const {
    const auto& newest = models_.newest();
    const bool answered = newest && newest->question == question_ && newest->state.change;
    return models_.pending() && !answered && since_asked_.seconds() < kPatience;
}

void LiveSmoothing::ask(const Followed& followed) {
    const OperationForm& form = *followed.form;
    const Asked now{base_, form.changes(), followed.colouring};
    if (now == asked_ || !form.valid() || is_worked_on()) return;
    asked_ = now;
    since_asked_ = {};
    question_ = models_.ask({.scene = *followed.document.current(),
                             .base = base_,
                             .arguments = checked_arguments(form.operation(), form.arguments()),
                             .colouring = followed.colouring});
}

void LiveSmoothing::follow(bool on) {
    if (on_ == on || (on && !can_follow())) return;
    on_ = on;
    asked_ = {};
    if (on) return;
    shown_.reset();
    models_.forget();
}

bool LiveSmoothing::outdated() const {
    return shown_ && (shown_->question != question_ || !shown_->state.whole);
}

// --- the mouse

void LiveSmoothing::begin_drive() {
    starts_.clear();
    on_before_drive_ = on_;
    follow(true);
    if (shown_ && !outdated()) starts_ = numbers_in(shown_->state.resolved);
}

std::vector<FieldText> LiveSmoothing::drive(const OperationForm& before, const DriveReach& reach) {
    // What a driven parameter decides by the way is not taken for its start.
    if (starts_.empty() && model() && model()->question == question_)
        starts_ = numbers_in(model()->state.resolved);
    return driven_texts(before, starts_, axes_, reach);
}

void LiveSmoothing::cancel_drive() {
    if (!on_before_drive_) follow(false);
}

std::string difference_text(const Surface& shown, const Surface& applied) {
    if (shown.vertex_count() != applied.vertex_count()) return "";
    double largest = 0.0;
    for (std::size_t v = 0; v < shown.vertex_count(); ++v)
        largest = std::max(largest, (shown.points()[v] - applied.points()[v]).norm());
    if (!(largest > kSameShape * bounds(shown).diagonal())) return "";
    return "up to " + formatted(largest) + " mm";
}

}  // namespace vesselbench
