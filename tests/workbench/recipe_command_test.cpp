// The command `recipe`, bundled recipes in `prepare`, and a project's edits as a recipe.

#include <filesystem>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/formats/surface_file.h"
#include "tests/support/program.h"
#include "tests/support/scene_bits.h"
#include "tests/support/shapes.h"
#include "workbench/operations/table.h"
#include "workbench/prepare/kept_recipe.h"
#include "workbench/session/session.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;
using Json = nlohmann::ordered_json;
using Words = std::vector<std::string>;

namespace {

/// A recipe in a file.
std::string file_with(const std::string& text) {
    const std::string file = temporary_folder() + "/recipe.json";
    write_text(file, text);
    return file;
}

std::string tube_file() {
    const std::string file = temporary_folder() + "/tube.stl";
    write_surface(closed_tube(2.0, 20.0, 24, 40), file);
    return file;
}

/// \return the project
std::string prepared(const std::string& input, const std::string& purpose,
                     const std::string& recipe) {
    const std::string out = temporary_folder() + "/out";
    const ProgramRun made = run(
        {"prepare", input, "--units", "mm", "--for", purpose, "--recipe", recipe, "--out", out});
    INFO(made.err);
    REQUIRE(made.exit_code == 0);
    return out + "/project.vbench";
}

Json figures_of(const std::string& project) {
    return Json::parse(
        run({"measure", (std::filesystem::path(project).parent_path() / "surface.vtp").string(),
             "--json"})
            .out);
}

}  // namespace

SCENARIO("recipe check lists all mistakes", "[workbench][recipe]") {
    const std::string bad = file_with("[\n {\"operation\": \"smoth\"},\n 7]");
    const ProgramRun checked = run({"recipe", "check", bad});
    CHECK(checked.exit_code == 3);
    CHECK_THAT(checked.out, Contains("recipe.json, line 2, entry 1: ") && Contains("entry 2: "));
    const Json json = Json::parse(run({"recipe", "check", bad, "--json"}).out);
    REQUIRE(json["mistakes"].size() == 2);
    CHECK(json["mistakes"][0]["line"] == 2);
    CHECK_THAT(run({"recipe", "check", file_with("[7,]")}).out, StartsWith("recipe.json, line 1"));
    CHECK_THAT(run({"recipe", "diff", "tree-cfd", bad}).err, Contains("'recipe.json', line 2"));
    CHECK(run({"recipe", "check", "tree-cfd"}).exit_code == 0);
    CHECK(run({"recipe", "check"}).exit_code == 2);
    CHECK(run({"recipe", "tree-cfd"}).exit_code == 2);
    CHECK(run({"recipe", "check", "nowhere/a.json"}).exit_code == 3);
    CHECK(Json::parse(run({"recipe", "list", "--json"}).out)["recipes"].size() == 5);
    CHECK(Json::parse(run({"recipe", "schema"}).out).contains("$defs"));
}

SCENARIO("recipe diff compares bundled recipes, files and projects", "[workbench][recipe]") {
    const std::string ours = file_with(
        "// ours\n{\"on\": \"prepare\", \"change\": [{\"operation\": \"remesh\",\n"
        " \"arguments\": {\"gradation\": 1.2}}]}");
    CHECK(run({"recipe", "diff", "prepare", "prepare"}).exit_code == 0);
    const ProgramRun compared = run({"recipe", "diff", "prepare", ours, "--json"});
    CHECK(compared.exit_code == 1);
    const Json json = Json::parse(compared.out);
    REQUIRE(json["differences"].size() == 2);  // both entries of remesh
    CHECK(json["differences"][0]["values"][0]["b"] == "1.2");
    const std::string project = prepared(tube_file(), "planning", ours);
    CHECK(run({"recipe", "diff", ours, project}).exit_code == 0);
    CHECK(run({"recipe", "show", project}).out == run({"recipe", "show", ours}).out);
    CHECK_THAT(run({"recipe", "show", project, "--for", "rp"}).err, Contains("but for planning"));
}

SCENARIO("Each bundled recipe makes a sound model of a phantom", "[workbench][recipe]") {
    const auto [name, purpose] = GENERATE(table<std::string, std::string>({{"aneurysm-cfd", "cfd"},
                                                                           {"tree-cfd", "cfd"},
                                                                           {"solid-print", "rp"},
                                                                           {"fine-print", "rp"}}));
    INFO(name);
    const std::string project = prepared(tube_file(), purpose, name);
    const Json figures = figures_of(project);
    CHECK(figures["closed"] == true);
    CHECK(figures["self_intersections"] == 0);
    const std::filesystem::path out = std::filesystem::path(project).parent_path();
    CHECK(exists(out / (purpose == "cfd" ? "volume.vtu" : "print.stl")));
    CHECK(run({"recipe", "diff", name, project}).exit_code == 0);
    const std::string other = purpose == "cfd" ? "rp" : "cfd";
    CHECK_THAT(run({"prepare", tube_file(), "--for", other, "--recipe", name, "--out",
                    (out / "other").string()})
                   .err,
               Contains("is for " + purpose + ", not for " + other));
}

SCENARIO("prepare makes the same model with the recipe that log writes of it",
         "[workbench][recipe]") {
    const std::string input = tube_file();
    const std::string project = prepared(input, "rp", file_with(R"([
        {"operation": "repair"}, {"operation": "smooth", "arguments": {"iterations": 3}},
        {"operation": "remesh", "arguments": {"edge": 0.8}}, {"operation": "print-check"}])"));
    const auto edit = [&](const Words& arguments) {
        const ProgramRun done = run(arguments);
        INFO(done.err);
        REQUIRE(done.exit_code == 0);
    };
    // It makes the later edits run again, on other input.
    edit({"apply", project, "brush-inflate", "at=2,0,10", "radius=1.5", "--note",
          "a \"bleb\"\n{\"operation\": \"subdivide\"},"});  // a note is no entry
    edit({"apply", project, "subdivide"});
    edit({"undo", project});
    const Session made = Session::open(project, {.find = find_operation});
    const ProgramRun written = run({"log", project, "--recipe"});
    REQUIRE(written.exit_code == 0);
    CHECK_THAT(written.out,
               Contains("of this case: at") && Contains("// a \"bleb\" {\"operation\"") &&
                   !Contains("\n{\"operation\"") &&
                   !Contains("\n    {\"operation\": \"subdivide\"") && !Contains(input));
    const std::string recipe = file_with(written.out);
    CHECK(run({"recipe", "check", recipe}).exit_code == 0);
    const std::string again = prepared(input, "rp", recipe);
    Session first = Session::open(project, {.find = find_operation}),
            second = Session::open(again, {.find = find_operation});
    CHECK(bits_of(first.scene("rp")) == bits_of(second.scene("rp")));
    THEN("for other cases, the brush is left out") {
        const ProgramRun portable = run({"log", project, "--recipe", "--portable"});
        CHECK_THAT(portable.out, Contains("is left out: it is of this case (at)") &&
                                     !Contains("\"brush-inflate\"") && Contains("\"remesh\""));
        CHECK(run({"recipe", "check", file_with(portable.out)}).exit_code == 0);
    }
    CHECK(run({"log", project, "--portable"}).exit_code == 2);
}
