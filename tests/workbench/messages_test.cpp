#include <fstream>
#include <iterator>

#include <catch2/catch.hpp>

#include "geometry/formats/surface_file.h"
#include "tests/support/beginning.h"
#include "tests/support/paths.h"
#include "tests/support/program.h"
#include "tests/support/shapes.h"
#include "workbench/commands/console/progress_line.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;
using Catch::Matchers::EndsWith;
using Catch::Matchers::Matches;
using Catch::Matchers::StartsWith;

namespace {

std::string content(const std::string& file) {
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), {}};
}

std::string tube_project(const std::string& folder) {
    write_surface(fine_tube(2.0, 10.0, 24), folder + "/tube.vtp");
    REQUIRE(run_program(program_path(),
                        {"new", folder + "/tube.vbench", folder + "/tube.vtp", "--units", "mm"})
                .exit_code == 0);
    return folder + "/tube.vbench";
}

/// What a command writes to a terminal.
std::string on_terminal(const std::string& command, const std::string& environment = "") {
    return run_program("/usr/bin/env", {"-u", "NO_COLOR", "TERM=xterm", "sh", "-c",
                                        environment + " script -qec '" + program_path() + " " +
                                            command + "' /dev/null"})
        .out;
}

}  // namespace

SCENARIO("The time left follows from the speed so far", "[workbench][messages]") {
    CHECK_FALSE(remaining_time(0.5, 1.0));    // too early
    CHECK_FALSE(remaining_time(0.01, 60.0));  // too little is done
    CHECK(remaining_time(0.25, 10.0).value() == Approx(30.0));
    CHECK(progress_text(0.25, "remesh", 10.0) == " 25 %  remesh, about 30 s left");
    CHECK(progress_text(0.25, "remesh", 1.0) == " 25 %  remesh");
    CHECK(progress_text(0.5, "remesh", 3000.0) == " 50 %  remesh, about 50 min left");
    CHECK_THAT(progress_bar(0.5, "remesh", 1.0, 80),
               StartsWith("[############............]  50 %  remesh"));
    CHECK(progress_bar(0.5, "remesh of a long name", 1.0, 40).size() <= 43);
    CHECK_THAT(progress_bar(7.0, "a\033b", 1.0, 80), Contains("100 %  a\\x1bb"));
}

SCENARIO("Messages can be left out, and kept in a file", "[workbench][messages]") {
    static const Beginning beginning(tube_project);
    const std::string project = beginning.again(), folder = beginning.folder();
    const std::string log = folder + "/with spaces.log";
    const std::vector<std::string> failing = {"apply", project, "fill-hole", "at=0,0,0", "-q"};
    GIVEN("--quiet") {
        const std::vector<std::string> loud = {
            "prepare", folder + "/tube.vtp", "--units", "mm",
            "--for",   "planning",           "--out",   folder + "/out"};
        std::vector<std::string> quiet = loud;
        quiet.back() += "2";
        quiet.insert(quiet.end(), {"--quiet", "--log", log});
        const ProgramRun told = run_program(program_path(), loud);
        const ProgramRun silent = run_program(program_path(), quiet);
        CHECK_THAT(told.err, Contains("source: repair"));
        CHECK(silent.exit_code == 0);
        CHECK(silent.err.empty());
        CHECK_THAT(silent.out, Contains("report.html"));
        THEN("the log has what was left out, with its time") {
            CHECK_THAT(content(log), Contains("Z source: repair"));
            CHECK_THAT(content(log), Contains("Z begin: vesselbench prepare ") &&
                                         Contains("--log '" + log + "'") &&
                                         EndsWith("Z end: exit code 0\n"));
            CHECK_THAT(content(log),
                       Matches("20\\d\\d-\\d\\d-\\d\\dT\\d\\d:\\d\\d:\\d\\dZ begin: (.|\n)*"));
        }
    }
    GIVEN("a failure") {
        std::vector<std::string> logged = failing;
        logged.insert(logged.end(), {"--log", log});
        const ProgramRun run = run_program(program_path(), logged);
        CHECK(run.exit_code != 0);
        CHECK_THAT(run.err, StartsWith("vesselbench: "));
        CHECK_THAT(content(log), Contains("Z vesselbench: "));
        const std::string first = content(log);
        (void)run_program(program_path(), logged);
        CHECK_THAT(content(log), StartsWith(first));  // appended to
        CHECK(content(log).size() > first.size());
    }
    GIVEN("a log that cannot be written") {
        const ProgramRun run = run_program(program_path(), {"log", project, "--log", folder});
        CHECK(run.exit_code == 3);
        CHECK_THAT(run.err, Contains("cannot be written"));
    }
}

SCENARIO("Only a terminal gets colours, and none where they are not wanted",
         "[workbench][messages]") {
    const std::string wrong = "log missing.vbench";
    CHECK_THAT(on_terminal(wrong), Contains("\033[1;31mvesselbench: \033[0m"));
    CHECK_THAT(on_terminal(wrong, "NO_COLOR=1"), !Contains("\033[") && Contains("vesselbench: "));
    CHECK_THAT(on_terminal(wrong, "TERM=dumb"), !Contains("\033[") && Contains("vesselbench: "));
    CHECK_THAT(run_program(program_path(), {"log", "missing.vbench"}).err, !Contains("\033["));
}

SCENARIO("A terminal shows a bar, which makes room for what is written", "[workbench][messages]") {
    const std::string folder = temporary_folder();
    const std::string shown = on_terminal("phantom aneurysm --out " + folder + "/phantom");
    CHECK_THAT(shown, Contains("[####"));
    const std::size_t bar = shown.rfind(" %  "), erased = shown.rfind("\r\033[K");
    REQUIRE(bar != std::string::npos);
    REQUIRE(erased != std::string::npos);
    CHECK(erased > bar);
    CHECK(shown.size() > erased + 3);  // and then the result
}
