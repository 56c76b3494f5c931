#pragma once

#include <optional>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "workbench/commands/command_parser.h"
#include "workbench/flow/flow_results.h"

namespace vesselbench {

struct FlowArguments {
    std::string folder;  ///< a case, or of a preparation
    int processes = 0;   ///< 0: as many as are useful
    std::string out;     ///< folder that gets the results; empty: of `results`, none
    bool json = false;
};

/// Solves the flow of a case, and writes the results into "results" in its folder, or into `out`.
/// Warns if it has not converged.
[[nodiscard]] FlowResults solved_flow(const FlowArguments& arguments, const Progress& progress);

/// Prints the figures as a table, and what of them was written.
void print_flow_table(const FlowResults& results);

/// Runs a case. \return the exit code: 1 if the flow has not converged
int run_case(const FlowArguments& arguments, const Progress& progress);

/// Reads a case's results. \return the exit code: 1 if the flow has not converged
int show_results(const FlowArguments& arguments, const Progress& progress);

/// Adds `run` and `results`.
void add_flow_commands(CommandLine& line);

}  // namespace vesselbench
