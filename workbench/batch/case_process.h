#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "geometry/kernel/progress.h"

namespace vesselbench {

/// What a case may take.
struct CaseLimits {
    double time_s = 3600.0;   ///< of the clock [s]; 0: no limit
    double memory_gib = 0.0;  ///< resident, of its processes together [GiB]; 0: no limit

    bool operator==(const CaseLimits&) const = default;
};

enum class CaseEnding {
    Ended,
    Killed,  ///< by a signal that this program did not send
    TimeLimit,
    MemoryLimit
};

/// How a run of this program ended.
struct CaseRun {
    CaseEnding ending = CaseEnding::Ended;
    int exit_code = 0;  ///< 128 + signal if it died of one
    std::string out;    ///< standard output
    double seconds = 0.0;
    double peak_mib = 0.0;  ///< largest resident memory seen [MiB], looked at every 25 ms
};

/// Runs this program with other arguments, in a process group of its own that ends with this
/// process, however that ends.
/// \param log file that gets its standard error; what is in it stays
/// \throw IoError if it cannot be started; Cancelled, after it is killed
[[nodiscard]] CaseRun run_program_limited(const std::vector<std::string>& arguments,
                                          const std::filesystem::path& log,
                                          const CaseLimits& limits, const Progress& progress);

/// In a process that run_program_limited() started: takes the two arguments off that it was given
/// for this, and sees that it ends with its parent. Does nothing in any other.
void enter_case_process(int& argc, char**& argv);

}  // namespace vesselbench
