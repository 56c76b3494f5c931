#define CATCH_CONFIG_RUNNER
#include <catch2/catch.hpp>

#include "tests/support/one_thread.h"
#include "tests/support/skip.h"

// A failure is a failure whatever was skipped before it.
int main(int argc, char* argv[]) {
    using namespace vesselbench::test;
    const int result = Catch::Session().run(argc, argv);
    if (result == 0 && anything_skipped()) return kSkippedExitCode;
    return result == kSkippedExitCode ? 1 : result;
}
