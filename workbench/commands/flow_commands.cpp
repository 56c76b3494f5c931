#include "workbench/commands/flow_commands.h"

#include <memory>

namespace vesselbench {

namespace {

constexpr const char* kFolderHelp =
    "A folder that `prepare --for cfd` wrote, or an OpenFOAM case that `export` wrote";

constexpr const char* kRunFooter =
    "OpenFOAM (Debian's package openfoam) runs until the pressures, flows and the mean wall shear\n"
    "stress change by less than 0.2 % over 50 iterations with residuals below 1e-3, or until the\n"
    "case's own residuals (openfoam.residual) or iterations (openfoam.iterations) are reached. A "
    "run\nthat was stopped goes on. Exit code 1 if the flow has not converged.\n\n"
    "  vesselbench prepare aneurysm --for cfd --out case\n"
    "  vesselbench run case";

constexpr const char* kResultsFooter =
    "--out FOLDER gets results.json, methods.txt, history.csv, wall.vtp (arrays wall_shear_pa,\n"
    "wall_shear_stress_pa, pressure_pa), wall.glb and pictures; report.html of a preparation gets "
    "a\nsection. Exit code 1 if the flow has not converged.\n\n"
    "  vesselbench results case\n"
    "  vesselbench results case --out figures";

CLI::App& add_flow_command(CommandLine& line, const char* name, const char* summary,
                           const std::shared_ptr<FlowArguments>& options,
                           int (*run)(const FlowArguments&, const Progress&)) {
    CLI::App& command = add_command(line, name, summary,
                                    [options, &line, run] { return run(*options, line.progress); });
    command.add_option("FOLDER", options->folder, kFolderHelp)->required()->type_name("");
    add_json(command, options->json);
    return command;
}

}  // namespace

void add_flow_commands(CommandLine& line) {
    const auto running = std::make_shared<FlowArguments>();
    CLI::App& run =
        add_flow_command(line, "run", "Run the flow of a case with OpenFOAM", running, &run_case);
    run.add_option("--processes", running->processes,
                   "That share the work (default: as many as the machine has cores)")
        ->check(CLI::Range(1, 1024).description(""))
        ->type_name("N");
    run.add_option("--out", running->out,
                   "Folder that gets the results (default: results in the case's folder)")
        ->type_name("FOLDER");
    run.footer(kRunFooter);
    const auto reading = std::make_shared<FlowArguments>();
    CLI::App& results = add_flow_command(
        line, "results", "Read the results of a flow: wall shear stress, pressures, flows", reading,
        &show_results);
    results.add_option("--out", reading->out, "Folder that gets the results; created if missing")
        ->type_name("FOLDER");
    results.footer(kResultsFooter);
}

}  // namespace vesselbench
