#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace vesselbench {

/// From here on a signal that means a crash (SIGSEGV, SIGABRT, ...) writes a text file into the
/// folder, names it on stderr, and then ends the program as it would have without it. The file
/// holds the program's version, the system's, the signal and the calls that led to it; no name of a
/// file, no argument but the command's name, and nothing of a model. It is sent nowhere.
/// \param command that is run, such as "prepare"
void report_crashes(const std::filesystem::path& folder, const std::string& command);

/// The files that crashes have left in the folder, the newest first.
[[nodiscard]] std::vector<std::filesystem::path> crash_reports(const std::filesystem::path& folder);

/// The newest of them, if no earlier call has returned it: the folder keeps which one that was.
[[nodiscard]] std::optional<std::filesystem::path> untold_crash(
    const std::filesystem::path& folder);

}  // namespace vesselbench
