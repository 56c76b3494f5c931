// What a preparation that stops offers, as lists of arguments.

#include <algorithm>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/formats/surface_file.h"
#include "geometry/kernel/diagnosed_error.h"
#include "tests/support/paths.h"
#include "tests/support/program.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_facts.h"
#include "workbench/operations/table.h"
#include "workbench/prepare/refusal_report.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Json = nlohmann::ordered_json;
using Words = std::vector<std::string>;

namespace {

ProgramRun run(const Words& arguments) {
    return run_program(program_path(), arguments);
}

/// The diagnostics that the program prints when it stops.
Json diagnostics_of(const ProgramRun& stopped) {
    INFO(stopped.err);
    REQUIRE(stopped.exit_code != 0);
    return Json::parse(stopped.out).at("diagnostics");
}

Words command_of(const Json& diagnostic, std::size_t remedy) {
    const Json& commands = diagnostic.at("remedies").at(remedy).at("commands");
    REQUIRE(commands.size() == 1);
    return commands.front().get<Words>();
}

/// Runs a command as it is offered.
int exit_code_of(Words command) {
    REQUIRE(command.front() == "vesselbench");
    command.erase(command.begin());
    const ProgramRun done = run(command);
    UNSCOPED_INFO(done.err);
    return done.exit_code;
}

bool has(const Words& command, const std::string& word) {
    return std::ranges::count(command, word) > 0;
}

RecipeEntry entry_of(const std::string& operation) {
    return {.given = GivenArguments(find_operation(operation))};
}

}  // namespace

SCENARIO("A question about the unit offers a command for each answer", "[workbench][remedies]") {
    const std::string folder = temporary_folder(), out = folder + "/out";
    write_unitless(open_tube(1.0, 12.0, 24, 40), folder + "/tube.off");
    const ProgramRun asked =
        run({"prepare", folder + "/tube.off", "--for", "planning", "--out", out, "--name", "case 7",
             "--set", "smooth.iterations=3", "--json"});
    CHECK(asked.exit_code == 2);
    const Json question = diagnostics_of(asked).at(0);
    CHECK(question["code"] == "unit-in-doubt");
    CHECK(question["operation"] == "load-surface");
    REQUIRE(question["remedies"].size() == 2);
    CHECK(question["remedies"][0]["arguments"]["units"] == "mm");
    CHECK(question["remedies"][1]["arguments"]["units"] == "cm");
    const Words answer = command_of(question, 0);
    CHECK(has(answer, "load-surface.units=mm"));
    CHECK(has(answer, "smooth.iterations=3"));
    CHECK(has(answer, "case 7"));
    CHECK_FALSE(has(answer, "--resume"));
    CHECK(exit_code_of(answer) == 0);
}

SCENARIO("A question about a body offers a command that resumes with the answer",
         "[workbench][remedies]") {
    // A tube that stands on a plate.
    const Surface plate = mapped(cube(1.0), [](const Vec3& p) {
        return Vec3(60.0 * p.x() - 30.0, 60.0 * p.y() - 30.0, 2.0 * p.z() - 1.5);
    });
    const std::string folder = temporary_folder(), out = folder + "/out";
    write_surface(merged(closed_tube(4.0, 40.0, 28, 36), plate), folder + "/tube.stl");
    const Json question = diagnostics_of(run({"prepare", folder + "/tube.stl", "--for", "rp",
                                              "--out", out, "--units", "mm", "--json"}))
                              .at(0);
    CHECK(question["code"] == "body-no-vessel");
    const Words answer = command_of(question, 0);
    CHECK(has(answer, "--resume"));
    CHECK(has(answer, "repair.bodies=vessel"));
    CHECK(exit_code_of(answer) == 0);
}

SCENARIO("A command that resumes keeps the settings that are still to come, but what it replaces",
         "[workbench][remedies]") {
    const DiagnosedFailure doubt(
        Diagnostic{.code = "end-in-doubt",
                   .operation = "clip-opening",
                   .words = {{"doubts", "there is one"}},
                   .remedies = {{.arguments = {{"closed", "4,5,6"}, {"open", "1,2,3"}}}}});
    const PrepareOptions options{
        .input = {.input = "a.nrrd", .label = "artery"},
        .purpose = "cfd",
        .arguments = {"repair.bodies=vessel", "clip-opening.open_ends=2",
                      "clip-opening.vessel=vein", "clip-opening.close_ends=4", "remesh.edge=0.3"},
        .out = "out"};
    const Recipe rest = {entry_of("clip-opening"), entry_of("remesh")};
    const Words command = command_of(refused_json(options, doubt, rest).at(0), 0);
    CHECK(command == Words{"vesselbench", "prepare", "a.nrrd", "--label", "artery", "--for", "cfd",
                           "--out", "out", "--resume", "--set", "clip-opening.vessel=vein", "--set",
                           "remesh.edge=0.3", "--set", "clip-opening.closed=4,5,6", "--set",
                           "clip-opening.open=1,2,3"});
}
