#pragma once

#include <string>

namespace vesselbench::test {

/// Exit code of a test program that skipped something and had no failure; ctest counts it as
/// skipped (SKIP_RETURN_CODE).
inline constexpr int kSkippedExitCode = 77;

/// Counts the running scenario as skipped unless one of its checks fails. The reason is printed,
/// and added to the file that the environment variable VESSELBENCH_SKIPS names, if any
/// (scripts/test prints that file before ctest's summary). The scenario continues: return from it
/// if needed.
void skip(const std::string& reason);

/// Whether skip() was called.
[[nodiscard]] bool anything_skipped();

}  // namespace vesselbench::test
