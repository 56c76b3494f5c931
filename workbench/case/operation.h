#pragma once

#include <memory>
#include <string>
#include <vector>

#include "workbench/case/checked_arguments.h"
#include "workbench/case/operation_example.h"
#include "workbench/case/operation_search.h"
#include "workbench/case/parameter.h"
#include "workbench/case/recipe_part.h"
#include "workbench/case/stepper.h"

namespace vesselbench {

/// The ordered steps of a case (DESIGN 2); edits are ordered by step, then by
/// time.
enum class Step : int {
    Source = 1,
    Branches,
    LocalRepair,
    Openings,
    Smoothing,
    Deformation,
    Remeshing,
    Product,
    Review
};

[[nodiscard]] std::string to_string(Step step);  ///< "source", "branches", "local-repair" ...

[[nodiscard]] std::vector<std::string> step_names(const std::vector<Step>& steps);

/// A pure function: same scene, same arguments, same outcome, bit for bit.
/// \throw UsageError, InvalidInput, AlgorithmFailure, Cancelled; the scene is never touched
using OperationFunction = Outcome (*)(const Scene& scene, const Arguments& arguments,
                                      Progress& progress);

/// Starts an operation live.
using StepperFunction = std::unique_ptr<Stepper> (*)(const Scene& scene,
                                                     const CheckedArguments& arguments,
                                                     Progress& progress);

struct StatedChange;

/// One row of the operation table.
struct Operation {
    std::string name;  ///< the command-line name, "clip-opening"
    Step usual_step = Step::Source;
    std::vector<Step> allowed;  ///< all the steps it is allowed in, including the usual one
    std::string summary;        ///< one line
    std::vector<Parameter> parameters;
    OperationFunction run = nullptr;  ///< the batch form; null: from start to outcome
    /// The live form, whose scene() comes without the figures of outcome(); null: none.
    StepperFunction start = nullptr;
    bool isolated =
        false;  ///< run in a worker process: it reads foreign files, or may crash or hang
    /// True for arguments with which it runs in the program's own process, even where all others
    /// run in workers: on a GPU. Null: for none.
    bool (*stays_here)(const Arguments& arguments) = nullptr;
    /// What the form of a new edit starts with, where the scene or the variant, which may have a
    /// purpose's name, speaks for other values than the defaults; null: for none.
    Arguments (*suggested)(const Scene& scene, const std::string& variant) = nullptr;
    /// What it would decide on a scene without a run, by parameter: also of others than those that
    /// are left out; not of all. For any thread. Throws what the operation throws. Null: nothing.
    Arguments (*decided)(const Scene& scene, const CheckedArguments& arguments,
                         const Progress& progress) = nullptr;
    /// What it states that the run which made an outcome may change of the surface
    /// (stated_change.h); the session refuses an outcome that changes more. Null: it may change
    /// everything.
    StatedChange (*may_change)(const Scene& before, const Outcome& outcome) = nullptr;
    std::string thesis = {};  ///< section numbers, "4.2.7"; may be empty
    RecipePart recipe = {};
    OperationSearch search = {};
    OperationExample example = {};
};

/// Runs an operation's batch form in this process.
/// \throw what the operation throws
[[nodiscard]] Outcome run_here(const Operation& operation, const Scene& scene,
                               const CheckedArguments& arguments, Progress& progress);

/// \throw UsageError that lists similar names and all names if the operation has no such parameter
[[nodiscard]] const Parameter& find_parameter(const Operation& operation, const std::string& name);

/// The operation's first parameter of a meaning; null: none.
[[nodiscard]] const Parameter* parameter_of(const Operation& operation, Meaning meaning);

/// Given arguments that had no effect, as warnings.
/// \param resolved the arguments that the operation finally ran with
[[nodiscard]] std::vector<Diagnostic> arguments_without_effect(const Operation& operation,
                                                               const Arguments& given,
                                                               const Arguments& resolved);

}  // namespace vesselbench
