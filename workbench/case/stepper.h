#pragma once

#include <memory>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "geometry/kernel/diagnostic.h"
#include "geometry/kernel/progress.h"
#include "workbench/case/arguments.h"
#include "workbench/case/scene.h"

namespace vesselbench {

/// An operation's figures about its findings and results: a JSON object with units in the keys
/// (`volume_mm3`).
using Report = std::shared_ptr<const nlohmann::ordered_json>;

/// The outcome of an operation: a new scene, its figures, and the arguments with all its decisions
/// filled in.
struct Outcome {
    Scene scene;
    Report report;
    Arguments resolved;
    std::vector<Diagnostic> warnings;  ///< of no operation: of the one that ran
    std::string device = "cpu";        ///< that computed the scene: "cpu" or "gpu"
};

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

}  // namespace vesselbench
