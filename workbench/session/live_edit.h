#pragma once

#include <memory>

#include "workbench/case/operation.h"
#include "workbench/session/edit_run.h"

namespace vesselbench {

/// An operation that is driven live, made by Session::start_live(): a brush stroke, a sliding
/// plane. Additions are visible in scene() at once; Session::preview() and commit() turn it into
/// one edit, whose arguments are the sum of those given. Not thread-safe: one thread drives it,
/// which need not be the session's; it may outlive the session.
class LiveEdit {
public:
    /// A brush appends the dabs of `more`; other operations replace the arguments named in it.
    /// \throw UsageError if they do not fit the operation; what the operation throws. The scene is
    /// then unchanged
    void add(const Arguments& more, Progress progress = {});

    /// The scene after everything added so far.
    [[nodiscard]] const Scene& scene() const { return stepper_->scene(); }

private:
    friend class Session;

    LiveEdit(const Operation& operation, EditRecord edit, EvaluatedLine before,
             const CheckedArguments& located, Progress& progress);

    /// What the batch form returns for everything added so far, every given argument filled in.
    [[nodiscard]] Outcome outcome(Progress& progress);

    /// The given arguments, with the values resulting from everything added.
    [[nodiscard]] Arguments given(const Arguments& resolved) const;

    const Operation* operation_;
    EditRecord edit_;  ///< it has the names of all arguments given so far
    EvaluatedLine before_;
    Arguments arguments_;  ///< with defaults and the paths of files; additions replace earlier ones
    std::unique_ptr<Stepper> stepper_;
    double seconds_ = 0.0;  ///< of the stepper's work
};

}  // namespace vesselbench
