#include "workbench/session/live_edit.h"

#include <utility>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/stopwatch.h"

namespace vesselbench {

LiveEdit::LiveEdit(const Operation& operation, EditRecord edit, EvaluatedLine before,
                   const CheckedArguments& located, Progress& progress)
    : operation_(&operation),
      edit_(std::move(edit)),
      before_(std::move(before)),
      arguments_(located) {
    if (operation.start == nullptr)
        throw UsageError(operation.name + " cannot be driven live; preview it");
    const Stopwatch watch;
    stepper_ = operation.start(before_.scene, located, progress);
    seconds_ = watch.seconds();
}

void LiveEdit::add(const Arguments& more, Progress progress) {
    const GivenArguments added = given_arguments(*operation_, more);
    const Stopwatch watch;
    stepper_->add(added, progress);
    seconds_ += watch.seconds();
    for (const auto& [name, value] : added->values()) {
        edit_.given.set(name, value);
        arguments_.set(name, value);
    }
}

Outcome LiveEdit::outcome(Progress& progress) {
    const Stopwatch watch;
    Outcome outcome = stepper_->outcome(progress);
    for (const auto& [name, value] : arguments_.values())
        if (!outcome.resolved.has(name)) outcome.resolved.set(name, value);
    seconds_ += watch.seconds();
    return outcome;
}

Arguments LiveEdit::given(const Arguments& resolved) const {
    Arguments given;
    for (const auto& [name, value] : edit_.given.values())
        given.set(name, resolved.values().at(name));
    return given;
}

}  // namespace vesselbench
