#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "geometry/kernel/progress.h"
#include "workbench/case/arguments.h"
#include "workbench/case/checked_arguments.h"
#include "workbench/case/operation_search.h"
#include "workbench/case/recipe_part.h"
#include "workbench/case/scene.h"

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

enum class ParameterType { Flag, Integer, Real, Text, Choice, Point, List, File };

/// An argument without which another one has no effect: "distance=margin".
struct Condition {
    std::string parameter;
    std::vector<std::string> values;  ///< any of them, in the command line's form
};

[[nodiscard]] std::string to_string(const Condition& condition);  ///< "filter=a or b"

/// One documented parameter: the command line's option, the check and its error text, the recipe's
/// key and the page docs/operations.md are all generated from this.
struct Parameter {
    std::string name;
    ParameterType type = ParameterType::Real;
    std::string unit = {};  ///< "mm", "-", "deg" ...; empty for texts
    std::optional<Value> default_value =
        {};            ///< none: the operation decides by itself, or `required`
    std::string help;  ///< one sentence; states the default decision if it is absent
    double minimum = -std::numeric_limits<double>::infinity();  ///< inclusive
    double maximum = std::numeric_limits<double>::infinity();   ///< inclusive
    std::vector<std::string> choices = {};                      ///< for Choice
    bool required = false;
    bool above_minimum = false;               ///< the minimum itself is not allowed
    std::optional<Condition> only_with = {};  ///< without it, no effect; none: unconditional
};

/// An operation's figures about its findings and results: a JSON object with units in the keys
/// (`volume_mm3`).
using Report = std::shared_ptr<const nlohmann::ordered_json>;

/// The outcome of an operation: a new scene, its figures, and the arguments with all its decisions
/// filled in.
struct Outcome {
    Scene scene;
    Report report;
    Arguments resolved;
    std::vector<std::string> warnings;
    std::string device = "cpu";  ///< that computed the scene: "cpu" or "gpu"
};

/// A pure function: same scene, same arguments, same outcome, bit for bit.
/// \throw UsageError, InvalidInput, AlgorithmFailure, Cancelled; the scene is never touched
using OperationFunction = Outcome (*)(const Scene& scene, const Arguments& arguments,
                                      Progress& progress);

/// An operation that is driven live: started on a scene, then given arguments as they arrive. Its
/// batch form is start plus everything added, so the preview and the committed result have the same
/// bits. Not thread-safe.
class Stepper {
public:
    virtual ~Stepper() = default;

    /// A brush appends the dabs of `more`; other operations replace the arguments named in it.
    /// \param more as given_arguments() checks them
    /// \throw as the operation's batch form; everything is then unchanged
    virtual void add(const Arguments& more, Progress& progress) = 0;

    /// The scene after everything added so far.
    [[nodiscard]] virtual const Scene& scene() const = 0;

    /// The arguments after everything added so far, with the operation's decisions filled in.
    [[nodiscard]] virtual const Arguments& resolved() const = 0;

    /// The batch form's outcome for everything added so far, including figures. More may be added
    /// afterwards.
    [[nodiscard]] virtual Outcome outcome(Progress& progress) = 0;
};

/// Starts an operation live.
using StepperFunction = std::unique_ptr<Stepper> (*)(const Scene& scene,
                                                     const CheckedArguments& arguments,
                                                     Progress& progress);

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
    std::string thesis = {};  ///< section numbers, "4.2.7"; may be empty
    RecipePart recipe = {};
    OperationSearch search = {};
};

/// Runs an operation's batch form in this process.
/// \throw what the operation throws
[[nodiscard]] Outcome run_here(const Operation& operation, const Scene& scene,
                               const CheckedArguments& arguments, Progress& progress);

/// \throw UsageError that lists similar names and all names if the operation has no such parameter
[[nodiscard]] const Parameter& find_parameter(const Operation& operation, const std::string& name);

/// The value in the parameter's own type: integers are accepted as real numbers, three numbers as a
/// point; a text is parsed.
/// \throw UsageError that names the parameter, the value and the range
[[nodiscard]] Value checked_value(const Parameter& parameter, const Value& value);

/// Given arguments that had no effect, as warnings: "margin has no effect without distance=margin".
/// \param resolved the arguments that the operation finally ran with
[[nodiscard]] std::vector<std::string> arguments_without_effect(const Operation& operation,
                                                                const Arguments& given,
                                                                const Arguments& resolved);

}  // namespace vesselbench
