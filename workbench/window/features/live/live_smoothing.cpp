#include "workbench/window/features/live/live_smoothing.h"

#include <algorithm>
#include <utility>

#include "geometry/kernel/measure.h"
#include "geometry/kernel/wording.h"
#include "workbench/window/case/readable.h"

namespace vesselbench {

namespace {

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

LiveSmoothing::LiveSmoothing(std::function<void()> wake, const LiveDevice& device)
    : LiveForm(std::move(wake), live_modelling(device)) {}

// --- following the form

std::string why_not_followed(const LiveSmoothing::Followed& followed) {
    const Document& document = followed.document;
    const Scene* scene = document.current();
    if (!document.snapshot()) return "no case is open";
    if (scene == nullptr || !scene->surface || scene->surface->empty())
        return "there is no surface yet";
    return document.why_not_input();
}

void LiveSmoothing::take_base(const Followed& followed) {
    const Scene* scene = followed.document.current();
    const auto positions = scene != nullptr && scene->surface ? scene->surface->positions : nullptr;
    if (positions == base_positions_) return;
    base_positions_ = positions;
    take_new_base();
}

bool LiveSmoothing::update(const Followed& followed) {
    const Operation* operation =
        followed.form != nullptr && followed.form->operation().search.smoothing != nullptr
            ? &followed.form->operation()
            : nullptr;
    take_operation(operation);
    if (followed.document.current() == nullptr) take_base(followed);  // of a closed case
    if (!has_form()) return take_models();
    take_base(followed);
    take_reason(why_not_followed(followed));
    axes_ = usable_axes(*followed.form, wanted_axes_);
    const bool changed = take_models();
    if (follows()) ask_for(followed);
    return show(!followed.document.previewed()) || changed;
}

/// The last question's figures are waited for.
void LiveSmoothing::ask_for(const Followed& followed) {
    const OperationForm& form = *followed.form;
    if (!form.valid()) return;
    ask({base(), form.changes(), followed.colouring}, is_answered() && model()->state.change, [&] {
        return LiveQuestion{.scene = *followed.document.current(),
                            .base = base(),
                            .arguments = checked_arguments(form.operation(), form.arguments()),
                            .colouring = followed.colouring};
    });
}

// --- the mouse

void LiveSmoothing::begin_drive() {
    starts_.clear();
    begin_drag();
    if (shown() && !outdated()) starts_ = numbers_in(shown()->state.resolved);
}

std::vector<FieldText> LiveSmoothing::drive(const OperationForm& before, const DriveReach& reach) {
    // What a driven parameter decides by the way is not taken for its start.
    if (starts_.empty() && is_answered()) starts_ = numbers_in(model()->state.resolved);
    return driven_texts(before, starts_, axes_, reach);
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
