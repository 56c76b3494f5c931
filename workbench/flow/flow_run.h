#pragma once

#include <functional>
#include <string>

#include "geometry/kernel/progress.h"
#include "workbench/flow/flow_case.h"
#include "workbench/flow/flow_watch.h"

namespace vesselbench {

struct FlowRunOptions {
    int processes = 0;  ///< that share the mesh; 0: as many as the machine's cores, and useful
    SettlingLimits limits = {};
};

/// How a run ended.
struct FlowRun {
    bool converged = false;  ///< by its figures, or by the residuals of system/fvSolution
    int iterations = 0;      ///< all, with those of earlier runs
    double seconds = 0.0;    ///< of this run
    int processes = 1;
    Settling settling;
    double courant = 0.0;  ///< largest of a pulsatile flow in this run [-]
};

/// True if the last run ended because all residuals of system/fvSolution were reached.
[[nodiscard]] bool has_reached_residuals(const std::filesystem::path& folder);

/// The log of a case's solver, in its folder: "log.simpleFoam".
[[nodiscard]] std::string solver_log(const FlowRecord& record);

/// Runs OpenFOAM's simpleFoam until its figures rest (settling_of), its residuals are reached, or
/// its iterations are used up; of a pulsatile flow pimpleFoam, to the end of the last period.
/// Progress says the iteration, the largest residual and the pressure drop. A case that ran before
/// goes on at its last time that was written whole; one whose figures rest is not run again. Output
/// goes to solver_log(). A cancel kills the solver at once, and so does the end of this process;
/// the next run goes on.
/// \throw AlgorithmFailure if OpenFOAM is not installed, fails (with its last lines) or diverges;
/// InvalidInput if another process runs the case; Cancelled
[[nodiscard]] FlowRun run_flow(const FlowCase& flow, const FlowRunOptions& options,
                               const std::function<void(const std::string&)>& tell,
                               const Progress& progress);

}  // namespace vesselbench
