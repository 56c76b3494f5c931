#include "workbench/session/live_edit.h"

#include <utility>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/stopwatch.h"

namespace vesselbench {

LiveEdit::LiveEdit(const Operation& operation, EditRecord edit, EvaluatedLine before,
                   const Arguments& located, Progress& progress)
    : operation_(&operation),
      edit_(std::move(edit)),
      before_(std::move(before)),
      given_(located),
      checked_(checked_arguments(operation, located)) {
    if (operation.start == nullptr)
        throw UsageError(operation.name + " cannot be driven live; preview it");
    const Stopwatch watch;
    stepper_ = operation.start(before_.scene, checked_, progress);
    seconds_ = watch.seconds();
}

void LiveEdit::add(const Arguments& more, Progress progress) {
    Arguments all = given_;
    for (const auto& [name, value] : more.values()) all.set(name, value);
    Arguments checked = checked_arguments(*operation_, all);
    Arguments added;
    for (const auto& [name, value] : more.values()) added.set(name, checked.values().at(name));
    const Stopwatch watch;
    stepper_->add(added, progress);
    seconds_ += watch.seconds();
    given_ = std::move(all);
    checked_ = std::move(checked);
}

Outcome LiveEdit::outcome(Progress& progress) {
    const Stopwatch watch;
    Outcome outcome = stepper_->outcome(progress);
    for (const auto& [name, value] : checked_.values())
        if (!outcome.resolved.has(name)) outcome.resolved.set(name, value);
    seconds_ += watch.seconds();
    return outcome;
}

Arguments LiveEdit::given(const Arguments& resolved) const {
    Arguments given;
    for (const auto& [name, value] : given_.values()) given.set(name, resolved.values().at(name));
    return given;
}

}  // namespace vesselbench
