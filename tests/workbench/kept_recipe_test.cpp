// A project keeps the recipe that it was prepared with.

#include "workbench/prepare/kept_recipe.h"

#include <filesystem>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/formats/surface_file.h"
#include "tests/support/program.h"
#include "tests/support/shapes.h"
#include "workbench/operations/table.h"
#include "workbench/prepare/input.h"
#include "workbench/session/session.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;
using Json = nlohmann::ordered_json;
using Names = std::vector<std::string>;

namespace {

Names operations_in(const std::string& project) {
    Names names;
    const Json log = Json::parse(run({"log", project, "--json"}).out);
    for (const Json& edit : log["edits"]) names.push_back(edit["operation"]);
    return names;
}

}  // namespace

SCENARIO("Resuming without the recipe follows the one that was given", "[workbench][prepare]") {
    const std::string folder = temporary_folder(), out = folder + "/out",
                      project = out + "/project.vbench";
    write_surface(closed_tube(2.0, 20.0, 32, 40), folder + "/tube.stl");
    write_text(folder + "/recipe.json", R"([
        {"operation": "repair"}, {"operation": "smooth", "arguments": {"iterations": 3}}])");
    const std::vector<std::string> prepare = {"prepare", folder + "/tube.stl", "--units", "mm",
                                              "--for",   "planning",           "--out",   out};
    auto first = prepare;
    first.insert(first.end(), {"--recipe", folder + "/recipe.json"});
    REQUIRE(run(first).exit_code == 0);
    const Names made = {"load-surface", "repair", "smooth"};
    REQUIRE(operations_in(project) == made);
    auto again = prepare;
    again.emplace_back("--resume");
    const ProgramRun resumed = run(again);
    INFO(resumed.err);
    CHECK(resumed.exit_code == 0);
    CHECK_THAT(resumed.err, Contains("every edit of the recipe has been made"));
    CHECK(operations_in(project) == made);
    THEN("another recipe that is given replaces it") {
        write_text(folder + "/other.json", R"([{"operation": "repair"}, {"operation": "smooth"},
                                               {"operation": "remesh"}])");
        auto other = again;
        other.insert(other.end(), {"--recipe", folder + "/other.json"});
        REQUIRE(run(other).exit_code == 0);
        CHECK(operations_in(project).back() == "remesh");
        REQUIRE(run({"undo", project}).exit_code == 0);
        REQUIRE(run(again).exit_code == 0);
        CHECK(operations_in(project).back() == "remesh");
    }
}

SCENARIO("Kept recipes stand in place of the input's own", "[workbench][prepare]") {
    const std::filesystem::path project = temporary_folder() + "/project.vbench";
    const Session session = Session::create(project, {.find = find_operation});
    const RecipeDocument given = recipe_document(R"([{"operation": "load-neighbour",
        "arguments": {"name": "bone", "file": "/somewhere/else/bone.stl"}}])",
                                                 "given.json");
    Input input;
    take_kept_recipes(input, project);
    CHECK_FALSE(input.recipes);
    keep_recipe(project, "cfd", given);
    CHECK_THAT(kept_recipe_text(project, "cfd"), !Contains("somewhere"));
    WHEN("it names no file") {
        const std::string text = "// ours\n[{\"operation\": \"repair\"}]  // and no more\n";
        keep_recipe(project, "rp", recipe_document(text, "ours.json"));
        THEN("its text is kept with its comments") {
            CHECK(kept_recipe_text(project, "rp") == text);
            CHECK(kept_purposes(project) == Names{"cfd", "rp"});
            take_kept_recipes(input, project);
            CHECK(own_recipe(input, "rp")[0]["operation"] == "repair");
        }
    }
    WHEN("the case has none") {
        take_kept_recipes(input, project);
        THEN("the purpose has the kept one, with its file beside the project") {
            const Json own = own_recipe(input, "cfd");
            CHECK(own[0]["arguments"]["file"] == (project.parent_path() / "bone.stl").string());
            CHECK(own_recipe(input, "rp").is_null());
        }
    }
    WHEN("the case has one for every purpose") {
        const Json every = Json::parse(R"([{"operation": "repair"}])");
        input.recipes = std::make_shared<const Json>(every);
        take_kept_recipes(input, project);
        CHECK(own_recipe(input, "cfd")[0]["operation"] == "load-neighbour");
        CHECK(own_recipe(input, "rp") == every);
    }
}
