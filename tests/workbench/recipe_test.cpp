#include "workbench/prepare/recipe.h"

#include <stdexcept>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/kernel/errors.h"
#include "workbench/case/purposes.h"

using namespace vesselbench;
using Catch::Matchers::Contains;
using Json = nlohmann::ordered_json;

namespace {

std::vector<std::string> operations_of(const Recipe& recipe) {
    std::vector<std::string> names;
    for (const RecipeEntry& entry : recipe) names.push_back(entry.given.operation().name);
    return names;
}

void refused(const char* text, const std::string& why) {
    INFO(text);
    CHECK_THROWS_AS(recipe_from_json(Json::parse(text), {"surface", "cfd"}), UsageError);
    CHECK_THROWS_WITH(recipe_from_json(Json::parse(text), {"surface", "cfd"}), Contains(why));
}

}  // namespace

SCENARIO("A recipe is read from JSON", "[workbench][recipe]") {
    const Json list = Json::parse(R"([
        {"operation": "smooth", "arguments": {"iterations": 5, "lambda": "0.25"}, "step": "source"},
        {"operation": "fill-hole", "when": "rp"},
        {"operation": "extrude-opening", "when": ["surface", "no-mask"], "optional": true},
        {"operation": "fill-hole", "when": "surface", "unless_closed": true, "unless_made":
         {"operation": "smooth", "arguments": {"iterations": "5"}}}])");
    const Recipe recipe = recipe_from_json(list, {"surface", "cfd"});
    REQUIRE(operations_of(recipe) ==
            std::vector<std::string>{"smooth", "extrude-opening", "fill-hole"});
    CHECK(recipe[0].given->integer("iterations") == 5);
    CHECK(recipe[0].given->real("lambda") == 0.25);
    CHECK(recipe[0].step == Step::Source);
    CHECK(recipe[1].optional);
    CHECK_FALSE(recipe[1].unless_closed);
    CHECK(recipe[2].unless_closed);
    REQUIRE(recipe[2].unless_made.size() == 1);
    CHECK(recipe[2].unless_made[0].operation().name == "smooth");
    CHECK(recipe[2].unless_made[0]->integer("iterations") == 5);
    CHECK(recipe[1].unless_made.empty());
    CHECK_FALSE(recipe[1].step.has_value());
    CHECK(operations_of(recipe_from_json(list, {"image", "mask", "rp"})) ==
          std::vector<std::string>{"smooth", "fill-hole"});
}

SCENARIO("A recipe can require that reviewers accept the model", "[workbench][recipe]") {
    const Json list = Json::parse(R"([
        {"require": "accepted"}, {"operation": "smooth"},
        {"require": "accepted=3", "when": "rp"}, {"require": "accepted=2", "when": ["rp"]}])");
    CHECK(reviewers_required(list, {"surface", "cfd"}) == 1);
    CHECK(reviewers_required(list, {"surface", "rp"}) == 3);
    CHECK(reviewers_required(Json::parse(R"([{"operation": "smooth"}])"), {"rp"}) == 0);
    CHECK(operations_of(recipe_from_json(list, {"surface", "rp"})) ==
          std::vector<std::string>{"smooth"});
    refused(R"([{"require": "accept"}])", "require 'accept': give accepted");
    refused(R"([{"operation": "smooth"}, {"require": "accepted=0"}])", "entry 2");
    refused(R"([{"require": 2}])", "a text");
    refused(R"([{"require": "accepted", "operation": "smooth"}])", "operation");
    refused(R"([{"require": "accepted", "when": "today"}])", "today");
}

SCENARIO("An argument $purpose is the purpose's name", "[workbench][recipe]") {
    const Json list =
        Json::parse(R"([{"operation": "smooth", "arguments": {"preset": "$purpose"}}])");
    CHECK(recipe_from_json(list, {"surface", "planning"})[0].given->text("preset") == "planning");
    CHECK(recipe_from_json(list, {"image", "cfd"})[0].given->text("preset") == "cfd");
    CHECK_THROWS_WITH(recipe_from_json(list, {"image"}),
                      Contains("entry 1") && Contains("preset is $purpose"));
}

SCENARIO("An argument $mask is the wall that was drawn, unless the mask limits intensities",
         "[workbench][recipe]") {
    const auto extraction = [](const std::string& arguments, const RecipeUse& use) {
        return recipe_from_json(
            Json::parse(R"([{"operation": "extract-surface", "arguments": )" + arguments + "}]"),
            use)[0];
    };
    const std::string asked = R"({"method": "$mask"})";
    CHECK(extraction(asked, {"image", "cfd"}).given->text("method") == "auto");
    CHECK(extraction(asked, {"image", "mask", "cfd"}).given->text("method") == "auto");
    const RecipeEntry drawn = extraction(asked, {"image", "mask", kDrawnMask});
    CHECK(drawn.given->text("method") == "wall");
    CHECK(drawn.if_drawn);
    const RecipeEntry wanted = extraction(asked, {"image", "mask", kWallMask});
    CHECK(wanted.given->text("method") == "wall");
    CHECK_FALSE(wanted.if_drawn);
    for (const char* other : {R"("threshold": 700)", R"("iso": 0)", R"("dilation": 2)"})
        CHECK(extraction(R"({"method": "$mask", )" + std::string(other) + "}",
                         {"image", "mask", kDrawnMask})
                  .given->text("method") == "auto");
}

SCENARIO("An entry may be replaced by one of several edits", "[workbench][recipe]") {
    const Recipe recipe = recipe_from_json(Json::parse(R"([{"operation": "smooth", "unless_made": [
            {"operation": "smooth"}, {"operation": "repair", "arguments": {}}]}])"),
                                           {"surface", "cfd"});
    REQUIRE(recipe[0].unless_made.size() == 2);
    CHECK(recipe[0].unless_made[1].operation().name == "repair");
    CHECK(recipe_from_json(recipe_to_json(recipe), {"surface"})[0].unless_made.size() == 2);
    refused(R"([{"operation": "smooth", "unless_made": [1]}])", "unless_made");
}

SCENARIO("Surfaces are smoothed less than images, whatever they are for", "[workbench][recipe]") {
    for (const Purpose& purpose : purposes()) {
        INFO(purpose.name);
        const auto first_smooth = [&](const char* input) {
            for (const RecipeEntry& entry : default_recipe({input, purpose.name}))
                if (entry.given.operation().name == "smooth") return entry.given;
            throw std::logic_error("the recipe does not smooth");
        };
        CHECK(first_smooth("surface")->text("preset") == purpose.name);
        CHECK(first_smooth("surface")->integer("iterations") == 5);
        CHECK(first_smooth("image")->text("preset") == purpose.name);
        CHECK_FALSE(first_smooth("image")->has("iterations"));
    }
}

SCENARIO("Images for surgery simulation are smoothed everywhere", "[workbench][recipe]") {
    for (const char* purpose : {"planning", "simulation"})
        for (const RecipeEntry& entry : default_recipe({"image", purpose})) {
            if (entry.given.operation().name != "smooth") continue;
            CHECK(entry.given->flag("staircase") == (std::string(purpose) == "planning"));
            CHECK(entry.unless_made.empty() == (std::string(purpose) != "planning"));
        }
}

SCENARIO("A recipe that cannot be followed is refused before anything is done",
         "[workbench][recipe]") {
    refused(R"({"operation": "smooth"})", "list");
    refused(R"([{"operation": "smoth"}])", "did you mean 'smooth'");
    refused(R"([{"operation": "smooth"}, {"arguments": {}}])", "entry 2");
    refused(R"([{"operation": "smooth", "argument": {}}])", "did you mean 'arguments'");
    refused(R"([{"operation": "smooth", "arguments": {"lambda": "much"}}])", "'lambda'");
    refused(R"([{"operation": "smooth", "arguments": {"lambda": [1, 2]}}])", "'lambda'");
    refused(R"([{"operation": "smooth", "step": "smoothin"}])", "did you mean 'smoothing'");
    refused(R"([{"operation": "smooth", "when": "today"}])", "today");
    refused(R"([{"operation": 7}])", "entry 1");
    refused(R"([{"operation": "smooth", "unless_made": {"arguments": {}}}])", "unless_made");
    refused(R"([{"operation": "smooth", "unless_made": {"operation": "smooth", "after": 1}}])",
            "after");
    // Another use of the recipe must not fail later.
    refused(R"([{"operation": "smooth", "when": "image", "arguments": {"lambda": "much"}}])",
            "'lambda'");
    refused(R"([7])", "entry 1");
}

SCENARIO("Every purpose is a word of recipes", "[workbench][recipe]") {
    for (const Purpose& purpose : purposes()) {
        const Json list = {{{"operation", "smooth"}, {"when", purpose.name}}};
        CHECK(recipe_from_json(list, {"surface", purpose.name}).size() == 1);
        CHECK(recipe_from_json(list, {"surface"}).empty());
        CHECK(&find_purpose(purpose.name) == &purpose);
    }
    CHECK_THROWS_WITH(find_purpose("cfx"),
                      Contains("--for 'cfx'") && Contains("did you mean 'cfd'"));
}

SCENARIO("What --set asks for by name is not replaced otherwise", "[workbench][recipe]") {
    const auto replaces_after = [](const std::string& text) {
        Recipe recipe = recipe_from_json(Json::parse(R"([{"operation": "tetrahedralize",
            "arguments": {"layers": 4}, "otherwise": {"layers": 0}}])"),
                                         {});
        set_arguments(recipe, std::vector{text});
        return recipe[0].otherwise.has_value();
    };
    CHECK(replaces_after("tetrahedralize.cells=50000"));
    CHECK_FALSE(replaces_after("tetrahedralize.layers=2"));
}

SCENARIO("--set changes a recipe's arguments", "[workbench][recipe]") {
    Recipe recipe = recipe_from_json(
        Json::parse(R"([{"operation": "smooth"}, {"operation": "smooth", "step": "source"}])"), {});
    const std::vector<std::string> texts = {"smooth.iterations=7"};
    set_arguments(recipe, texts);
    CHECK(recipe[0].given->integer("iterations") == 7);
    CHECK(recipe[1].given->integer("iterations") == 7);
    const auto wrong = [&](const std::string& text, const std::string& why) {
        const std::vector<std::string> one = {text};
        CHECK_THROWS_AS(set_arguments(recipe, one), UsageError);
        CHECK_THROWS_WITH(set_arguments(recipe, one), Contains(why));
    };
    wrong("iterations=7", "operation.parameter=value");
    wrong("smooth.iterations", "operation.parameter=value");
    wrong("smooth.iteration=7", "did you mean 'iterations'");
    wrong("fill-hole.continuity=1", "the recipe has no fill-hole");
    wrong("load-surface.file=other.stl", "the input itself is given");
}

SCENARIO("The built-in recipe fits every use", "[workbench][recipe]") {
    for (const std::string input : {"surface", "image"})
        for (const std::string purpose : {"cfd", "rp"})
            for (const bool mask : {false, true}) {
                RecipeUse use = {input, purpose};
                if (mask) use.push_back("mask");
                const auto names = operations_of(default_recipe(use));
                INFO(input << " " << purpose);
                CHECK(std::ranges::count(names, "remesh") == 1);
                // A print gets no tubes unless asked.
                CHECK(std::ranges::count(names, "extrude-opening") == (purpose == "cfd" ? 1 : 0));
                for (const RecipeEntry& entry : default_recipe(use))
                    if (entry.given.operation().name == "remesh") {
                        CHECK(entry.given->has("print_resolution") == (purpose == "rp"));
                        CHECK(entry.given->is_word("radius", "rays") == (purpose == "rp"));
                    }
                CHECK(std::ranges::count(names, "extract-surface") == (input == "image" ? 1 : 0));
                CHECK(names.back() == (purpose == "cfd" ? "tetrahedralize" : "print-check"));
            }
}

SCENARIO("A recipe that is written is read again", "[workbench][recipe]") {
    for (const Purpose& purpose : purposes())
        for (const char* source : {"image", "surface"}) {
            const Recipe recipe = default_recipe({source, purpose.name});
            const Json written = recipe_to_json(recipe);
            INFO(written.dump());
            const Recipe again = recipe_from_json(written, {"surface"});
            REQUIRE(again.size() == recipe.size());
            CHECK(recipe_to_json(again) == written);
            for (std::size_t i = 0; i < recipe.size(); ++i) {
                const Arguments &before = recipe[i].given, &after = again[i].given;
                CHECK(before == after);
                CHECK(step_of(again[i]) == step_of(recipe[i]));
                CHECK(again[i].otherwise.has_value() == recipe[i].otherwise.has_value());
            }
        }
}
