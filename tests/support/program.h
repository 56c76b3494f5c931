#pragma once

#include <string>
#include <vector>

namespace vesselbench::test {

/// The result of a run of the program.
struct ProgramRun {
    int exit_code = -1;  ///< 128 + signal if it was killed
    std::string out;
    std::string err;
};

/// Runs the program with these arguments (no shell quoting needed) and waits for it.
/// \param limits shell commands before it, such as "ulimit -f 10;"
[[nodiscard]] ProgramRun run_program(const std::string& program,
                                     const std::vector<std::string>& arguments,
                                     const std::string& limits = "");

/// Runs vesselbench itself.
ProgramRun run(const std::vector<std::string>& arguments, const std::string& limits = "");

/// Names in a folder, sorted; empty if there is no such folder.
[[nodiscard]] std::vector<std::string> names_in(const std::string& folder);

/// Writes a small text file.
void write_text(const std::string& file, const std::string& text);

}  // namespace vesselbench::test
