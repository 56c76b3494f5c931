#pragma once

#include <cstddef>
#include <string>

#include "workbench/batch/case_process.h"
#include "workbench/batch/manifest.h"
#include "workbench/commands/command_parser.h"

namespace vesselbench {

struct BatchArguments {
    std::string cases;  ///< a manifest or a folder
    std::string purpose;
    std::string out;
    CaseColumns columns;
    CaseLimits limits;
    std::string engine = "local";  ///< "local" or "slurm"
    std::size_t jobs = 0;          ///< 0: 1 at a time here, on a cluster as many as it allows
    std::string answers;           ///< file of what was answered on the page; empty: none
    std::string task;              ///< run this case alone, as a task of a cluster's job; empty: no
    bool retry = false;
    bool dry_run = false;
    bool json = false;
};

/// Prepares many cases, each in a process of its own.
/// \return true if every case has its model
bool prepare_cases(const BatchArguments& arguments, const Progress& progress);

/// Adds batch.
void add_cohort_commands(CommandLine& line);

}  // namespace vesselbench
