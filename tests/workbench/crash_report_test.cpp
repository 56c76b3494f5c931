#include "workbench/commands/console/crash_report.h"

#include <csignal>
#include <fstream>
#include <iterator>
#include <thread>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/formats/surface_file.h"
#include "tests/support/child_process.h"
#include "tests/support/paths.h"
#include "tests/support/program.h"
#include "tests/support/shapes.h"
#include "tests/support/skip.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;
using Catch::Matchers::EndsWith;
using namespace std::chrono_literals;

namespace {

/// Runs a long command with this state folder and lets it crash. \return its exit code
int crash(const std::string& state, int signal) {
    const std::string folder = temporary_folder(), project = folder + "/secret.vbench";
    write_surface(fine_tube(10.0, 80.0, 240), folder + "/tube.vtp");
    REQUIRE(run_program(program_path(), {"new", project, folder + "/tube.vtp", "--units", "mm"})
                .exit_code == 0);
    ChildProcess program("/usr/bin/env",
                         {"XDG_STATE_HOME=" + state, program_path(), "apply", project, "smooth",
                          "filter=mean-curvature-flow", "iterations=5000"});
    // SIGBUS, too: a child that does not yet run the program has the handlers of the tests.
    const auto is_ready = [&] { return program.handles(SIGBUS) && program.handles(signal); };
    for (int tries = 0; tries < 10000 && !is_ready(); ++tries) std::this_thread::sleep_for(1ms);
    REQUIRE(is_ready());
    program.signal(signal);
    return program.wait();
}

std::string content(const std::filesystem::path& file) {
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

SCENARIO("A crash leaves a report that names no file and stays here", "[workbench][crash]") {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    return skip("sanitizers report crashes themselves");
#endif
    const int signal = GENERATE(SIGSEGV, SIGABRT);
    const std::string state = temporary_folder();
    CHECK(crash(state, signal) == 128 + signal);  // as without the report
    const auto reports = crash_reports(state + "/vesselbench");
    REQUIRE(reports.size() == 1);
    const std::string text = content(reports.front());
    CHECK_THAT(text, Contains("command: apply") && Contains("calls, the last one first"));
    CHECK_THAT(text, Contains(signal == SIGSEGV ? "SIGSEGV" : "SIGABRT"));
    CHECK_THAT(text, !Contains("secret") && !Contains("tube"));
    CHECK(std::filesystem::status(reports.front()).permissions() ==
          (std::filesystem::perms::owner_read | std::filesystem::perms::owner_write));
    THEN("the doctor and the next window tell of it, the window once") {
        const ProgramRun doctor =
            run_program("/usr/bin/env", {"XDG_STATE_HOME=" + state, program_path(), "doctor"});
        CHECK_THAT(doctor.out, Contains("please report what happened"));
        CHECK(untold_crash(state + "/vesselbench") == reports.front());
        CHECK_FALSE(untold_crash(state + "/vesselbench"));
    }
}

SCENARIO("Where nothing crashed there is nothing to tell", "[workbench][crash]") {
    const std::string state = temporary_folder();
    CHECK(crash_reports(state + "/none").empty());
    CHECK_FALSE(untold_crash(state + "/none"));
}
