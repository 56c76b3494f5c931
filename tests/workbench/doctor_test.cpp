#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/support/paths.h"
#include "tests/support/program.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;
using Json = nlohmann::ordered_json;

namespace {

/// The doctor's row, with these changes of the environment.
Json row(const std::string& check, std::vector<std::string> environment = {}) {
    environment.insert(environment.end(), {program_path(), "doctor", "--json"});
    const ProgramRun run = run_program("/usr/bin/env", environment);
    REQUIRE(run.exit_code == 0);
    const Json report = Json::parse(run.out);
    for (const Json& found : report["checks"])
        if (found["check"] == check) return found;
    FAIL("no check of " << check);
    return {};
}

}  // namespace

SCENARIO("The doctor says what is there, and how to get what is missing", "[workbench][doctor]") {
    CHECK(row("bundled case")["ok"] == true);
    CHECK(row("display", {"DISPLAY=:77"})["value"] == ":77");
    const Json display = row("display", {"-u", "DISPLAY", "-u", "WAYLAND_DISPLAY"});
    CHECK(display["ok"] == false);
    CHECK_THAT(display["lacking"].get<std::string>(), Contains("command line works without it"));
    const Json flow = row("OpenFOAM", {"PATH=/nowhere"});
    CHECK(flow["ok"] == false);
    CHECK_THAT(flow["lacking"].get<std::string>(), Contains("apt install openfoam"));
    const Json cgns = row("CGNS");  // the package that builds need brings its library
    CHECK(cgns["ok"] == true);
    CHECK(cgns["value"] == "found");
    THEN("the text has the same") {
        const ProgramRun text = run_program(
            "/usr/bin/env", {"-u", "DISPLAY", "-u", "WAYLAND_DISPLAY", program_path(), "doctor"});
        CHECK(text.exit_code == 0);
        CHECK_THAT(text.out, Contains("memory") && Contains("! the window cannot open here"));
    }
}
