// The files in which recipes are written and shared: comments, mistakes, bundled ones, the schema.

#include "workbench/prepare/recipe_document.h"

#include <set>

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "tests/support/program.h"
#include "tests/support/shapes.h"
#include "tests/support/skip.h"
#include "workbench/case/purposes.h"
#include "workbench/prepare/recipe.h"
#include "workbench/prepare/recipe_diff.h"
#include "workbench/prepare/recipe_schema.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;
using Json = nlohmann::ordered_json;
using Texts = std::vector<std::string>;

namespace {

Texts faults_in(const std::string& text) {
    RecipeFaults faults;
    (void)read_recipe(text, "a.json", faults);
    Texts texts;
    for (const RecipeFault& fault : faults) texts.push_back(text_of(fault));
    return texts;
}

Texts operations_of(const Json& entries) {
    Texts names;
    for (const Json& entry : entries) names.push_back(entry.value("operation", "require"));
    return names;
}

/// Each is refused by the schema and by the program.
const Texts kBad = {
    "7",
    R"({})",
    R"({"operation": "smooth"})",
    R"([7])",
    R"([{"operation": "smoth"}])",
    R"([{"arguments": {}}])",
    R"([{"operation": 7}])",
    R"([{"operation": "smooth", "argument": {}}])",
    R"([{"operation": "smooth", "arguments": []}])",
    R"([{"operation": "smooth", "arguments": {"iteration": 5}}])",
    R"([{"operation": "smooth", "arguments": {"iterations": 5.5}}])",
    R"([{"operation": "smooth", "arguments": {"iterations": true}}])",
    R"([{"operation": "smooth", "arguments": {"iterations": "many"}}])",
    R"([{"operation": "smooth", "arguments": {"lambda": 1.5}}])",
    R"([{"operation": "smooth", "arguments": {"staircase": 1}}])",
    R"([{"operation": "smooth", "arguments": {"filter": "laplacian"}}])",
    R"([{"operation": "smooth", "otherwise": {"lambda": -1}}])",
    R"([{"operation": "smooth", "step": "smoothin"}])",
    R"([{"operation": "smooth", "step": "product"}])",
    R"([{"operation": "smooth", "when": "today"}])",
    R"([{"operation": "smooth", "when": ["cfd", "no-day"]}])",
    R"([{"operation": "smooth", "optional": "yes"}])",
    R"([{"operation": "smooth", "unless_closed": 1}])",
    R"([{"operation": "smooth", "unless_made": {"arguments": {}}}])",
    R"([{"operation": "smooth", "unless_made": {"operation": "smooth", "after": 1}}])",
    R"([{"operation": "remove-branch", "arguments": {"tip": [1, 2]}}])",
    R"([{"operation": "crop", "arguments": {"box": "here"}}])",
    R"([{"operation": "remesh", "arguments": {"edge": 0}}])",
    R"([{"operation": "brush-smooth", "arguments": {"dabs": [{"point": [0, 0, 0]}]}}])",
    R"([{"require": "accept"}])",
    R"([{"require": "accepted=0"}])",
    R"([{"require": "accepted", "operation": "smooth"}])",
    R"({"entries": {}})",
    R"({"entries": [], "for": "cfx"})",
    R"({"entries": [], "title": 3})",
    R"({"entries": [], "about": ""})",
    R"({"on": "nothing"})",
    R"({"entries": [], "change": []})",
    R"({"on": "prepare", "change": [{"operation": "remseh"}]})",
    R"({"on": "prepare", "change": [{"operation": "remesh", "when": "cfd"}]})"};

const Texts kGood = {
    "[]",
    R"([{"operation": "smooth", "arguments": {"iterations": "5", "lambda": "0.25", "staircase": "true"}}])",
    R"([{"operation": "smooth", "arguments": {"preset": "$purpose"}, "when": "no-cfd"}])",
    R"([{"operation": "remove-branch", "arguments": {"tip": "1,2,3"}}])",
    R"([{"operation": "crop", "arguments": {"box": [0, 0, 0, 1, 1, 1]}}])",
    R"([{"operation": "extract-surface", "arguments": {"labels": [7, 8], "threshold": "midway"}}])",
    R"([{"require": "accepted=2", "when": ["image", "rp"]}])",
    R"({"$schema": "recipe.schema.json", "title": "a", "for": ["cfd", "rp"], "entries": []})",
    R"({"on": "prepare", "entries": [{"operation": "decimate"}]})"};

}  // namespace

SCENARIO("A recipe may have comments and words about itself", "[workbench][recipe]") {
    const RecipeDocument recipe = recipe_document(R"({
        "$schema": "recipe.schema.json",  // "of editors", [
        "title": "Ours", "description": "// no comment", "for": ["cfd"],
        /* two "lines
           { of it */ /* and more */
        "entries": [{"operation": "repair"}]
    })",
                                                  "ours.json");
    CHECK(recipe.title == "Ours");
    CHECK(recipe.description == "// no comment");
    CHECK(operations_of(recipe.entries) == Texts{"repair"});
    CHECK_NOTHROW(require_purpose(recipe, "cfd"));
    CHECK_THROWS_WITH(require_purpose(recipe, "rp"),
                      Contains("'ours.json' is for cfd, not for rp"));
    CHECK(operations_of(recipe_document("// a list\n[{\"operation\": \"repair\"}]", "a").entries) ==
          Texts{"repair"});
}

SCENARIO("All mistakes in a recipe are found, each with its line", "[workbench][recipe]") {
    const Texts faults = faults_in(R"([
  {"operation": "smoth"},  // misspelt
  {"operation": "smooth", "arguments": {"lambda": 3,
                                        "iteration": 4}},
  {"require": "accept"}
])");
    REQUIRE(faults.size() == 4);
    CHECK_THAT(faults[0], Contains("line 2, entry 1") && Contains("did you mean 'smooth'"));
    CHECK_THAT(faults[1], Contains("line 3, entry 2") && Contains("'lambda'"));
    CHECK_THAT(faults[2], Contains("line 4, entry 2") && Contains("did you mean 'iterations'"));
    CHECK_THAT(faults[3], Contains("line 5, entry 3") && Contains("accepted=N"));
    CHECK_THROWS_WITH(recipe_document("[{\"operation\": \"smoth\"}, 7]", "a"),
                      Contains("line 1, entry 1") && Contains("and 1 more mistake"));
    CHECK_THAT(faults_in("[\n  {,}\n]").at(0), Contains("a.json, line 2, column 4"));
}

SCENARIO("A recipe can be a bundled one with changes", "[workbench][recipe]") {
    const RecipeDocument plain = bundled_recipe(kDefaultRecipe);
    const RecipeDocument recipe = recipe_document(R"({"on": "prepare",
        "change": [{"operation": "smooth", "step": "smoothing", "arguments": {"iterations": 9}}],
        "entries": [{"operation": "decimate", "step": "openings"}]})",
                                                  "a");
    int changed = 0;
    for (const Json& entry : recipe.entries)
        if (entry.value("operation", "") == "smooth") {
            const bool is_late = !entry.contains("step");
            CHECK((entry["arguments"].value("iterations", 0) == 9) == is_late);
            changed += is_late ? 1 : 0;
        }
    CHECK(changed == 1);
    Texts names = operations_of(recipe.entries);
    const auto added = std::ranges::find(names, "decimate");
    REQUIRE(added != names.end());
    CHECK(*(added - 1) == "extrude-opening");  // the last of its step
    names.erase(added);
    CHECK(names == operations_of(plain.entries));
    CHECK_THAT(faults_in(R"({"on": "prepare", "change": [{"operation": "decimate"}]})").at(0),
               Contains("change 1") && Contains("no decimate"));
}

SCENARIO("Bundled recipes can be followed, and each is another one", "[workbench][recipe]") {
    const Texts names = bundled_recipe_names();
    REQUIRE(names.size() == 5);
    for (const std::string& name : names) {
        INFO(name);
        const RecipeDocument recipe = bundled_recipe(name);
        CHECK(recipe.title.empty() == (name == kDefaultRecipe));
        for (const std::string& purpose : purpose_names())
            if (recipe.purposes.empty() || recipe.purposes.front() == purpose)
                for (const char* input : {"surface", "image"})
                    CHECK_FALSE(recipe_from_json(recipe.entries, {input, purpose}).empty());
        for (const std::string& other : names)
            CHECK(recipe_differences(recipe, bundled_recipe(other)).empty() == (name == other));
    }
    CHECK_THROWS_WITH(find_recipe("tree-cdf"), Contains("did you mean 'tree-cfd'"));
}

SCENARIO("A recipe's name is that of a bundled one, and a path that of a file",
         "[workbench][recipe]") {
    const std::string file = temporary_folder() + "/tree-cfd";
    write_text(file, R"([{"operation": "repair"}])");
    CHECK(find_recipe(file).entries.size() == 1);
    CHECK(find_recipe("tree-cfd").entries.size() > 1);
}

SCENARIO("Defaults that are given and the form of values make no other recipe",
         "[workbench][recipe]") {
    const auto differences = [](const char* a, const char* b) {
        Texts texts;
        for (const auto& one : recipe_differences(recipe_document(a, "a"), recipe_document(b, "b")))
            texts.push_back(text_of(one));
        return texts;
    };
    CHECK(
        differences(R"([{"operation": "remesh", "arguments": {"gradation": 1.5, "edge": "0.2"}}])",
                    R"({"title": "b", "entries": [
                          {"operation": "remesh", "step": "remeshing", "arguments": {"edge": 0.2}}]})")
            .empty());
    CHECK(differences(R"([{"operation": "remesh", "when": "cfd"}, {"operation": "repair"}])",
                      R"([{"operation": "remesh", "arguments": {"gradation": 1.2}}])") ==
          Texts{"changed: remesh, entry 1: gradation 1.5 (default) -> 1.2; when cfd -> always",
                "removed: repair, entry 2"});
    CHECK(differences(
              R"([{"operation": "repair"}, {"operation": "remesh"}, {"operation": "smooth"}])",
              R"([{"operation": "remesh"}, {"operation": "smooth"}, {"operation": "repair"},
                          {"require": "accepted"}])") ==
          Texts{"moved: repair, entry 1 -> 3", "added: require, entry 4"});
}

SCENARIO("What the schema refuses, the program refuses", "[workbench][recipe]") {
    for (const std::string& text : kBad) {
        INFO(text);
        CHECK_FALSE(faults_in(text).empty());
    }
    for (const std::string& text : kGood) {
        INFO(text);
        CHECK(faults_in(text) == Texts());
    }
    if (run_program("/usr/bin/python3", {"-c", "import jsonschema"}).exit_code != 0)
        return skip("python3-jsonschema is not installed");
    const auto parsed = [](const std::string& text) {
        return Json::parse(text, nullptr, true, true);
    };
    Json texts = {{"schema", recipe_schema()}, {"good", Json::array()}, {"bad", Json::array()}};
    for (const std::string& text : kGood) texts["good"].push_back(parsed(text));
    for (const std::string& name : bundled_recipe_names())
        texts["good"].push_back(parsed(bundled_recipe(name).text));
    for (const std::string& text : kBad) texts["bad"].push_back(parsed(text));
    const std::string file = temporary_folder() + "/texts.json";
    write_text(file, texts.dump());
    const ProgramRun run = run_program("/usr/bin/python3", {"-c", R"(
import json, sys
from jsonschema import Draft202012Validator as Validator
texts = json.load(open(sys.argv[1]))
Validator.check_schema(texts["schema"])
validator = Validator(texts["schema"])
wrong = [recipe for recipe in texts["good"] if not validator.is_valid(recipe)]
wrong += [recipe for recipe in texts["bad"] if validator.is_valid(recipe)]
print(*map(json.dumps, wrong), sep="\n", end="")
)",
                                                            file});
    INFO(run.err);
    CHECK(run.exit_code == 0);
    CHECK(run.out == "");
}
