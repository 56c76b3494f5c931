#include <filesystem>
#include <iostream>

#include <nlohmann/json.hpp>

#include "geometry/kernel/amounts.h"
#include "geometry/kernel/wording.h"
#include "workbench/case/diagnostic_words.h"
#include "workbench/case/json_text.h"
#include "workbench/commands/console/console.h"
#include "workbench/commands/console/messages.h"
#include "workbench/commands/flow_commands.h"
#include "workbench/flow/flow_run.h"
#include "workbench/flow/methods_text.h"
#include "workbench/flow/results_files.h"
#include "workbench/flow/results_json.h"

namespace vesselbench {

namespace {

namespace fs = std::filesystem;

/// The fraction of the progress for the solver; the rest is for reading and writing results.
constexpr double kSolving = 0.95;

void warn_unless_converged(const FlowResults& results) {
    if (!results.converged)
        warn("the flow has not converged after " + time_name(results.time) + " iterations" +
             formatted(results.settling.residual, " (residual %.1e") +
             formatted(100.0 * results.settling.change, ", figures still change by %.2g %%): ") +
             "its figures are not to be used; openfoam.iterations allows more");
}

void keep_results(const FlowResults& results, const fs::path& folder, const Progress& progress) {
    const WrittenResults written = write_flow_results(results, folder, progress);
    for (const Diagnostic& warning : written.warnings) warn(worded_with_operation(warning));
    remark("results: " + folder.string() + " (" + joined(written.names) + ")");
}

void tell_flow_run(const FlowRun& run) {
    if (run.seconds <= 0.0) return;
    remark((run.converged ? "solved in " : "ended after ") +
           counted(static_cast<std::size_t>(run.iterations),
                   run.courant > 0.0 ? "step" : "iteration") +
           ", " + duration_text(run.seconds) +
           (run.courant > 0.0 ? formatted(run.courant, ", largest Courant number %.2g") : ""));
}

void print_results(const FlowResults& results, bool json) {
    if (json)
        std::cout << text_from_json(results_json(results), 2) << "\n";
    else
        print_flow_table(results);
}

}  // namespace

FlowResults solved_flow(const FlowArguments& arguments, const Progress& progress) {
    const FlowCase flow = find_flow_case(arguments.folder);
    tell_flow_run(
        run_flow(flow, {.processes = arguments.processes}, &remark, progress.part(0.0, kSolving)));
    FlowResults results = read_flow_results(flow);
    keep_results(results, arguments.out.empty() ? flow.folder / "results" : fs::path(arguments.out),
                 progress.part(kSolving, 1.0));
    warn_unless_converged(results);
    return results;
}

void print_flow_table(const FlowResults& results) {
    std::vector<std::vector<std::string>> rows = {
        {results.cycle ? "pulsatile flow, last period" : "steady flow", "", "", ""}};
    for (const FlowFigure& figure : flow_figures(results))
        rows.push_back(
            {figure.name, formatted(figure.value, "%.4g"), figure.unit, figure.definition});
    std::cout << as_columns(rows) << "\n";
    rows = {{"opening", "kind", "flow [cm^3/s]", "mean pressure [Pa]"}};
    for (const OpeningFigures& opening : results.openings)
        rows.push_back({opening.recorded.name, to_string(opening.recorded.kind),
                        formatted(opening.flow, "%.4g"), formatted(opening.pressure, "%.4g")});
    std::cout << as_columns(rows);
}

int run_case(const FlowArguments& arguments, const Progress& progress) {
    const FlowResults results = solved_flow(arguments, progress);
    print_results(results, arguments.json);
    return results.converged ? 0 : 1;
}

int show_results(const FlowArguments& arguments, const Progress& progress) {
    const FlowResults results = read_flow_results(find_flow_case(arguments.folder));
    if (!arguments.out.empty()) keep_results(results, arguments.out, progress);
    warn_unless_converged(results);
    print_results(results, arguments.json);
    if (!arguments.json) std::cout << "\n" << as_columns({{"methods", methods_text(results)}});
    return results.converged ? 0 : 1;
}

}  // namespace vesselbench
