// What a preparation that stops offers, as lists of arguments.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/formats/surface_file.h"
#include "geometry/kernel/diagnosed_error.h"
#include "tests/support/program.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_facts.h"
#include "workbench/operations/table.h"
#include "workbench/prepare/recipe_run.h"
#include "workbench/prepare/refusal_report.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Json = nlohmann::ordered_json;
using Words = std::vector<std::string>;

namespace {

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

SCENARIO("A wall with two sides is asked about with a command for each", "[workbench][remedies]") {
    const Surface inner = mapped(closed_tube(3.0, 38.0, 28, 36),
                                 [](const Vec3& p) { return Vec3(p + Vec3(0, 0, 1)); });
    const std::string folder = temporary_folder(), out = folder + "/out";
    write_surface(merged(closed_tube(4.0, 40.0, 28, 36), inner), folder + "/wall.stl");
    for (const std::string purpose : {"cfd", "rp"}) {
        CAPTURE(purpose);
        const Json question =
            diagnostics_of(run({"prepare", folder + "/wall.stl", "--for", purpose, "--out",
                                out + purpose, "--units", "mm", "--json"}))
                .at(0);
        CHECK(question["code"] == "wall-has-two-sides");
        CHECK(has(command_of(question, 0), "repair.wall=lumen"));
        CHECK(has(command_of(question, 1), "repair.wall=outer"));
    }
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

SCENARIO("An input that cannot be used is refused with a code, and says what to do elsewhere",
         "[workbench][remedies]") {
    const std::string folder = temporary_folder();
    const auto refusal = [&](const std::string& name, const std::string& text) {
        std::ofstream(folder + "/" + name) << text;
        const ProgramRun stopped = run({"prepare", folder + "/" + name, "--for", "rp", "--units",
                                        "mm", "--out", folder + "/out", "--json"});
        CHECK(stopped.exit_code == 3);
        CHECK_FALSE(std::filesystem::exists(folder + "/out/project.vbench"));
        const Json document = Json::parse(stopped.out);
        CHECK_THAT(document.at("error").get<std::string>(), Catch::Contains("again"));
        REQUIRE_FALSE(document.at("diagnostics").empty());
        return document.at("diagnostics").at(0);
    };
    GIVEN("a damaged file") {
        const Json damaged = refusal("faces.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n0\n");
        CHECK(damaged["code"] == "file-not-read");
    }
    GIVEN("points without triangles") {
        CHECK(refusal("points.off", "OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n")["code"] ==
              "file-without-triangles");
    }
    GIVEN("an image that is none") {
        CHECK(refusal("image.nrrd", "NRRD0004\ntype: short\n")["code"] == "file-not-read");
    }
    GIVEN("a Moebius strip") {
        std::string strip = "OFF\n80 80 0\n";
        for (int i = 0; i < 40; ++i) {
            const double turn = i * 2.0 * std::numbers::pi / 40.0;
            for (const double side : {-2.0, 2.0}) {
                const double radius = 10.0 + side * std::cos(0.5 * turn);
                strip += std::to_string(radius * std::cos(turn)) + " " +
                         std::to_string(radius * std::sin(turn)) + " " +
                         std::to_string(side * std::sin(0.5 * turn)) + "\n";
            }
        }
        for (int i = 0; i < 40; ++i) {
            const int a = 2 * i, b = 2 * i + 1;
            const int c = i < 39 ? a + 2 : 1, d = i < 39 ? b + 2 : 0;
            strip += "3 " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(c) +
                     "\n3 " + std::to_string(b) + " " + std::to_string(d) + " " +
                     std::to_string(c) + "\n";
        }
        CHECK(refusal("strip.off", strip)["code"] != "");
    }
}

SCENARIO("A source of which nothing is kept is prepared again, with the answer",
         "[workbench][remedies]") {
    const UnusableSource none(
        Diagnostic{.code = "vessel-within-noise",
                   .figures = {{"loops", 200.0}},
                   .remedies = {{.operation = "extract-surface", .arguments = {{"closing", "1"}}},
                                {.operation = "load-image", .arguments = {{"mask", ""}}}}});
    const PrepareOptions options{.input = {.input = "a.nrrd"}, .purpose = "cfd", .out = "out"};
    const Json refused = refused_json(options, none, {entry_of("smooth")});
    const Words again = command_of(refused.at(0), 0);
    CHECK(has(again, "extract-surface.closing=1"));
    CHECK_FALSE(has(again, "--resume"));
    CHECK_FALSE(refused.at(0).at("remedies").at(1).contains("commands"));
}
