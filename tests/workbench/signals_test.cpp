#include <chrono>
#include <csignal>
#include <thread>

#include <catch2/catch.hpp>

#include "geometry/formats/surface_file.h"
#include "tests/support/child_process.h"
#include "tests/support/paths.h"
#include "tests/support/program.h"
#include "tests/support/shapes.h"

using namespace vesselbench::test;
using namespace std::chrono_literals;

namespace {

/// Output beyond this waits for its reader: `operations --json` is longer.
constexpr int kPage = 4096;

/// A project with a surface that takes seconds to smooth.
std::string tube_project() {
    const std::string folder = temporary_folder(), project = folder + "/tube.vbench";
    vesselbench::write_surface(fine_tube(10.0, 80.0, 240), folder + "/tube.vtp");
    REQUIRE(run_program(program_path(), {"new", project, folder + "/tube.vtp", "--units", "mm"})
                .exit_code == 0);
    return project;
}

std::vector<std::string> long_edit(const std::string& project) {
    return {"apply", project, "smooth", "filter=mean-curvature-flow", "iterations=5000"};
}

/// Waits until the program listens to all stop signals, for 10 s at most.
bool listens(const ChildProcess& program) {
    const auto all = [&] {
        return program.handles(SIGINT) && program.handles(SIGTERM) && program.handles(SIGHUP);
    };
    for (int tries = 0; tries < 10000 && !all(); ++tries) std::this_thread::sleep_for(1ms);
    return all();
}

/// Two signals that arrive together, as coreutils' timeout sends them.
void signal_twice(ChildProcess& program, int first, int second) {
    program.signal(SIGSTOP);
    program.signal(first);
    program.signal(second);
    program.signal(SIGCONT);
}

void read_all(ChildProcess& program) {
    while (!program.line().empty()) {
    }
}

}  // namespace

SCENARIO("Signals that come together stop a command in order", "[workbench][signals]") {
    const std::string project = tube_project();
    const std::pair<int, int> both =
        GENERATE(std::pair(SIGTERM, SIGHUP), std::pair(SIGINT, SIGTERM));
    ChildProcess program(program_path(), long_edit(project));
    REQUIRE(listens(program));
    signal_twice(program, both.first, both.second);
    CHECK(program.wait() == 1);
    CHECK(run_program(program_path(), {"log", project}).out.find("smooth") == std::string::npos);
}

SCENARIO("A repeated signal is ignored, a later one ends the program at once",
         "[workbench][signals]") {
    ChildProcess program(program_path(), {"operations", "--json"}, kPage);
    REQUIRE(program.line() == "{");  // from here on it waits for its reader, and cannot stop
    signal_twice(program, SIGTERM, SIGHUP);
    WHEN("no other signal comes") {
        read_all(program);
        THEN("it ends as a command that cannot be stopped") {
            CHECK(program.wait() == 0);
        }
    }
    WHEN("another one comes after 2 s") {
        std::this_thread::sleep_for(4s);
        program.signal(SIGINT);
        THEN("the program ends") {
            CHECK(program.wait() == 128 + SIGINT);
        }
    }
}

SCENARIO("Signals that the program was started to ignore stay ignored", "[workbench][signals]") {
    ChildProcess program(
        "/bin/sh",
        {"-c", "trap '' INT HUP; exec \"$0\" \"$@\"", program_path(), "operations", "--json"},
        kPage);
    REQUIRE(program.line() == "{");
    CHECK(program.handles(SIGTERM));
    CHECK_FALSE(program.handles(SIGINT));
    CHECK_FALSE(program.handles(SIGHUP));
    signal_twice(program, SIGINT, SIGHUP);
    read_all(program);
    CHECK(program.wait() == 0);
}
