#include <filesystem>

#include <catch2/catch.hpp>

#include "tests/support/program.h"
#include "tests/support/skip.h"

using namespace vesselbench::test;

// Hidden: run by the scenario below in a program of their own.
TEST_CASE("skips and is sound", "[.][skipping-sound]") {
    skip("no moon");
}

TEST_CASE("skips and fails", "[.][skipping-failed]") {
    skip("no moon");
    CHECK(1 == 2);
}

TEST_CASE("skips nothing", "[.][skipping-nothing]") {
    CHECK(1 == 1);
}

SCENARIO("A skipped test counts as skipped, a failed one as failed", "[workbench][skipping]") {
    const std::string self = std::filesystem::read_symlink("/proc/self/exe").string();
    const auto run = [&](const std::string& tag) {
        return run_program(self, {tag}, "unset VESSELBENCH_SKIPS;");
    };
    const ProgramRun sound = run("[skipping-sound]"), failed = run("[skipping-failed]");
    CHECK(sound.exit_code == kSkippedExitCode);
    CHECK_THAT(sound.out, Catch::Matchers::Contains("skipped: no moon"));
    CHECK(failed.exit_code != 0);
    CHECK(failed.exit_code != kSkippedExitCode);
    CHECK(run("[skipping-nothing]").exit_code == 0);
}
