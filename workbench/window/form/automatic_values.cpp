#include "workbench/window/form/automatic_values.h"

#include <chrono>
#include <utility>

#include "geometry/kernel/wording.h"
#include "workbench/case/parameter_texts.h"

namespace vesselbench {

namespace {

using namespace std::chrono_literals;

/// The fields rest: what takes longer may begin.
constexpr auto kRest = 150ms;

/// A decision is shown to be read, not to be repeated.
std::string short_text(const Value& value) {
    if (const auto* number = std::get_if<double>(&value)) return formatted(*number);
    if (const auto* point = std::get_if<Vec3>(&value))
        return formatted(point->x(), "%.3g, ") + formatted(point->y(), "%.3g, ") +
               formatted(point->z());
    return to_text(value);
}

/// Without what was given, which is no decision.
Arguments without(Arguments decided, const Arguments& given) {
    for (const auto& [name, value] : given.values()) decided.remove(name);
    return decided;
}

}  // namespace

bool AutomaticValues::Question::has_ground_of(Question other) const {
    other.given = given;
    return *this == other;
}

AutomaticValues::Question AutomaticValues::question_of(const OperationForm& form,
                                                       const Scene& scene) {
    return {.operation = &form.operation(),
            .given = form.arguments(),
            .positions = scene.surface ? scene.surface->positions : nullptr,
            .image = scene.image ? scene.image->voxels : nullptr,
            .mask = scene.mask ? scene.mask->voxels : nullptr,
            .neighbours = scene.neighbours.size()};
}

bool AutomaticValues::update(const Document& document, OperationForm* form) {
    if (form == nullptr || form->operation().decided == nullptr) {
        forget();
        return false;
    }
    const Scene* scene = document.current();
    const bool rests = !document.is_reading() && !document.activity();
    if (scene != nullptr && rests && form->valid()) ask(*form, *scene);
    if (task_.poll()) known_ = task_.take().value_or(Arguments());
    return form->set_automatic(asked_ && asked_->operation == &form->operation() ? known_
                                                                                 : Arguments());
}

void AutomaticValues::ask(const OperationForm& form, const Scene& scene) {
    Question question = question_of(form, scene);
    if (asked_ == question) return;
    task_.forget();
    if (!asked_ || !asked_->has_ground_of(question)) known_ = {};
    task_.start([scene, operation = question.operation,
                 given = question.given](const TaskTurn<Arguments>& turn) {
        if (!turn.rests(kRest)) return;
        const CheckedArguments arguments = checked_arguments(*operation, given);
        turn.send(without(operation->decided(scene, arguments, turn.progress), given));
    });
    asked_ = std::move(question);
}

void AutomaticValues::forget() {
    if (asked_) task_.forget();
    asked_.reset();
    known_ = {};
}

std::string unset_text(const FormField& field) {
    const Parameter& parameter = *field.parameter;
    const std::string text = default_text(parameter);
    if (parameter.default_value || parameter.required || !field.automatic) return text;
    return text + ": " + short_text(*field.automatic);
}

}  // namespace vesselbench
