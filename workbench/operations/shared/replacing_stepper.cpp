#include "workbench/operations/shared/replacing_stepper.h"

namespace vesselbench {

void ReplacingStepper::add(const Arguments& more, Progress& progress) {
    Arguments changed = arguments_;
    for (const auto& [name, value] : more.values()) changed.set(name, value);
    use(changed, progress);
    arguments_ = std::move(changed);
}

}  // namespace vesselbench
