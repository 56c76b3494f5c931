#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "geometry/kernel/progress.h"

namespace vesselbench {

/// The file of the program of this name in PATH; empty: there is none.
[[nodiscard]] std::filesystem::path installed_program(const std::string& name);

/// Runs a program of OpenFOAM's in a case's folder, its output in log.NAME there, and waits for its
/// end. What it starts ends with it, and it ends with this process.
/// \param command the program and its arguments
/// \param log NAME
/// \param watch called about five times a second
/// \throw AlgorithmFailure with the last lines of its output if it fails; InvalidInput if another
/// process writes the log; what `watch` throws; Cancelled; it is then killed
void run_solver(const std::filesystem::path& folder, const std::vector<std::string>& command,
                const std::string& log, const std::function<void()>& watch,
                const Progress& progress);

}  // namespace vesselbench
