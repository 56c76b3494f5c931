#pragma once

#include <optional>
#include <string>
#include <vector>

namespace vesselbench::test {

struct CommandRun {
    int exit_code = 0;
    std::string output;  ///< stdout and stderr
};

/// Runs an external program with OpenFOAM's environment, in `folder` if one is given. Empty if
/// there is no such program: the scenario counts as skipped.
[[nodiscard]] std::optional<CommandRun> run_command(const std::string& program,
                                                    const std::vector<std::string>& arguments,
                                                    const std::string& folder = {});

}  // namespace vesselbench::test
