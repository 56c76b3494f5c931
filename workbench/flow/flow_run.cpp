#include "workbench/flow/flow_run.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <string_view>
#include <thread>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/whole_file.h"
#include "geometry/kernel/wording.h"
#include "meshing/products/cfd_parameters.h"
#include "meshing/products/openfoam_control.h"
#include "workbench/flow/solver_process.h"

namespace vesselbench {

namespace {

namespace fs = std::filesystem;

/// Below this, a process waits for the others longer than it computes.
constexpr std::size_t kCellsForProcess = 10000;

/// Shares of the progress of a parallel run: the mesh is divided before, and joined after it.
constexpr double kDivided = 0.04, kJoined = 0.96;

std::string solver_of(const FlowRecord& record) {
    return solver_name(record.waveform.has_value());
}

void require_openfoam(const FlowRecord& record) {
    if (installed_program(solver_of(record)).empty())
        throw AlgorithmFailure(
            "OpenFOAM is not installed: the case is complete, and `vesselbench run` runs it after "
            "`apt install openfoam`");
}

int useful_processes(const FlowRecord& record, int asked) {
    if (asked == 1 || installed_program("mpirun").empty() ||
        installed_program("decomposePar").empty())
        return 1;
    if (asked > 1) return asked;
    const std::size_t cores = std::max(1U, std::thread::hardware_concurrency());
    return static_cast<int>(std::clamp<std::size_t>(record.cells / kCellsForProcess, 1, cores));
}

std::vector<fs::path> divided_parts(const fs::path& folder) {
    std::vector<fs::path> parts;
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.path().filename().string().starts_with("processor"))
            parts.push_back(entry.path());
    return parts;
}

/// What a run that was stopped has left: times that are whole in all parts are joined, all else of
/// the parts is removed.
void take_up(const fs::path& folder, const Progress& progress) {
    remove_broken_times(folder);
    const std::vector<fs::path> parts = divided_parts(folder);
    std::optional<double> common;
    for (const fs::path& part : parts) {
        remove_broken_times(part);
        const double last = last_whole_time(part).value_or(0.0);
        common = std::min(common.value_or(last), last);
    }
    if (common.value_or(0.0) > last_whole_time(folder).value_or(0.0))
        run_solver(
            folder, {"reconstructPar", "-case", folder.string(), "-time", time_name(*common)},
            "reconstructPar", [] {}, progress);
    for (const fs::path& part : parts) fs::remove_all(part);
}

/// Watches a run: reports it, and asks the solver to end when its figures rest.
class FlowWatcher {
public:
    FlowWatcher(const FlowCase& flow, const SettlingLimits& limits, const Progress& progress)
        : flow_(flow),
          limits_(limits),
          progress_(progress),
          before_(flow_history(flow.folder, flow.record).iterations) {}

    void look() {
        const FlowHistory history = flow_history(flow_.folder, flow_.record);
        if (history.iterations == before_ || history.iterations.empty()) return;  // not begun
        if (first_ == 0) first_ = history.iterations.back();
        const Settling settling = settling_of(history, flow_.record, limits_);
        if (flow_.record.waveform) return look_at_step(history, settling);
        const double done = std::max(0, history.iterations.back() - first_);
        progress_.report(
            done / (done + std::max(1.0, settling.remaining)),
            "iteration " + std::to_string(history.iterations.back()) +
                formatted(settling.residual, ", residual %.1e") +
                formatted(pressure_drop(history, flow_.record), ", pressure drop %.4g Pa"));
        refuse_divergence(settling, history.iterations.back());
        if (settling.settled && !fs::exists(flow_.folder / kStopFile))
            write_file(flow_.folder / kStopFile, "action=writeNow\n");
    }

private:
    /// A pulsatile flow goes on to its end.
    void look_at_step(const FlowHistory& history, const Settling& settling) const {
        const int step = history.iterations.back(), all = flow_.record.waveform->all_steps();
        progress_.report(std::min(1.0, static_cast<double>(step) / all),
                         "step " + std::to_string(step) + " of " + std::to_string(all) +
                             formatted(settling.residual, ", residual %.1e"));
        refuse_divergence(settling, step);
    }

    /// OpenFOAM stops by itself at a number that is none, unless its traps are off.
    static void refuse_divergence(const Settling& settling, int iteration) {
        if (!std::isfinite(settling.residual))
            throw AlgorithmFailure(
                "the flow diverges (iteration " + std::to_string(iteration) +
                "): look at the mesh's quality and at the Reynolds number in report.html");
    }

    const FlowCase& flow_;
    SettlingLimits limits_;
    Progress progress_;
    std::vector<int> before_;  ///< iterations of earlier runs
    int first_ = 0;
};

void run_divided(const FlowCase& flow, int processes, FlowWatcher& watcher,
                 const Progress& progress) {
    const std::string folder = flow.folder.string();
    write_file(flow.folder / "system" / "decomposeParDict",
               decomposition_dictionary(flow.record.bounds, processes));
    progress.report(0.0, "dividing the mesh");
    run_solver(
        flow.folder, {"decomposePar", "-case", folder, "-force", "-latestTime"}, "decomposePar",
        [] {}, progress);
    // The solver's processes have groups of their own: each ends with mpirun.
    const std::string solver = solver_of(flow.record);
    run_solver(
        flow.folder,
        {"mpirun", "-np", std::to_string(processes), "setpriv", "--pdeathsig", "KILL", solver,
         "-case", folder, "-parallel"},
        solver, [&] { watcher.look(); }, progress);
    progress.report(kJoined, "joining the parts");
    take_up(flow.folder, progress);
}

int last_iteration(const FlowHistory& history) {
    return history.iterations.empty() ? 0 : history.iterations.back();
}

FlowRun flow_run_of(const FlowCase& flow, const SettlingLimits& limits) {
    const FlowHistory history = flow_history(flow.folder, flow.record);
    FlowRun run{.iterations = last_iteration(history),
                .settling = settling_of(history, flow.record, limits)};
    if (const auto& wave = flow.record.waveform)
        run.converged = run.iterations >= wave->all_steps();
    else
        run.converged = run.settling.settled || has_reached_residuals(flow.folder);
    return run;
}

/// The largest in a solver's log [-]; 0: there is none.
double largest_courant(const fs::path& log) {
    if (!fs::is_regular_file(log)) return 0.0;
    constexpr std::string_view kLine = "Courant Number mean: ", kMost = "max: ";
    const std::string text = file_content(log);
    double largest = 0.0;
    for (std::size_t at = text.find(kLine); at != std::string::npos;
         at = text.find(kLine, at + 1)) {
        const std::size_t most = text.find(kMost, at);
        if (most == std::string::npos) break;
        largest = std::max(largest, std::strtod(text.c_str() + most + kMost.size(), nullptr));
    }
    return largest;
}

/// Above it, steps of time may be too long for a pulsatile flow.
constexpr double kSafeCourant = 5.0;

/// Runs the solver. \throw AlgorithmFailure that names the remedy if its steps of time are too long
void solve(const FlowCase& flow, int processes, FlowWatcher& watcher, const Progress& progress) {
    try {
        if (processes > 1) return run_divided(flow, processes, watcher, progress);
        run_solver(
            flow.folder, {solver_of(flow.record), "-case", flow.folder.string()},
            solver_of(flow.record), [&] { watcher.look(); }, progress);
    } catch (const AlgorithmFailure& error) {
        const double courant = largest_courant(flow.folder / solver_log(flow.record));
        if (!flow.record.waveform || courant < kSafeCourant) throw;
        throw AlgorithmFailure("the flow diverges at a Courant number of" +
                               formatted(courant, " %.2g") + ": export it with more than the " +
                               std::to_string(flow.record.waveform->steps) +
                               " openfoam.steps in a period (" + error.what() + ")");
    }
}

/// True if the last iteration is written whole, and nothing is left to be done.
bool is_finished(const FlowCase& flow, const FlowRun& run) {
    return run.converged && run.iterations > 0 &&
           flow.record.steps_until(last_whole_time(flow.folder).value_or(0.0)) == run.iterations;
}

}  // namespace

std::string solver_log(const FlowRecord& record) {
    return "log." + solver_of(record);
}

bool has_reached_residuals(const fs::path& folder) {
    const fs::path log = folder / "log.simpleFoam";
    return fs::is_regular_file(log) &&
           file_content(log).find("SIMPLE solution converged") != std::string::npos;
}

FlowRun run_flow(const FlowCase& flow, const FlowRunOptions& options,
                 const std::function<void(const std::string&)>& tell, const Progress& progress) {
    FlowRun run = flow_run_of(flow, options.limits);
    if (is_finished(flow, run)) {
        tell("the flow was solved before, in " +
             counted(std::size_t(run.iterations), flow.record.waveform ? "step" : "iteration"));
        return run;
    }
    require_openfoam(flow.record);
    const auto begin = std::chrono::steady_clock::now();
    take_up(flow.folder, progress);
    if (const std::optional<double> time = last_whole_time(flow.folder))
        tell("going on after " + std::string(flow.record.waveform ? "step " : "iteration ") +
             std::to_string(flow.record.steps_until(*time)));
    const int processes = useful_processes(flow.record, options.processes);
    tell(counted(flow.record.cells, "cell") + ", " +
         counted(std::size_t(processes), "process", "processes"));
    FlowWatcher watcher(flow, options.limits, progress.part(kDivided, kJoined));
    solve(flow, processes, watcher, progress);
    write_file(flow.folder / "case.foam", "");  // for ParaView
    run = flow_run_of(flow, options.limits);
    run.processes = processes;
    run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    if (!last_whole_time(flow.folder))
        throw AlgorithmFailure(solver_of(flow.record) + " ended without a result: see " +
                               solver_log(flow.record));
    if (flow.record.waveform) run.courant = largest_courant(flow.folder / solver_log(flow.record));
    return run;
}

}  // namespace vesselbench
