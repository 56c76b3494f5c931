#pragma once

#include <memory>
#include <utility>

#include "workbench/case/operation.h"

namespace vesselbench {

/// Live form of an operation whose add() replaces arguments: the result is that of the last
/// arguments, whatever the earlier ones.
class ReplacingStepper : public Stepper {
public:
    void add(const Arguments& more, Progress& progress) final;

protected:
    explicit ReplacingStepper(Arguments arguments) : arguments_(std::move(arguments)) {}

private:
    /// Uses these arguments from now on. \throw as the batch form; nothing is changed then
    virtual void use(const Arguments& arguments, Progress& progress) = 0;

    Arguments arguments_;
};

/// A StepperFunction that makes an object of a class from scene, arguments and progress.
template <class Live>
std::unique_ptr<Stepper> started(const Scene& scene, const CheckedArguments& arguments,
                                 Progress& progress) {
    return std::make_unique<Live>(scene, arguments, progress);
}

}  // namespace vesselbench
