// Preparing a case that was prepared: what is missing is made, and nothing twice.

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <thread>
#include <vector>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/support/shapes.h"
#include "tests/window/case_folder.h"
#include "tests/window/window_support.h"
#include "workbench/case/json_text.h"
#include "workbench/prepare/edits_recipe.h"
#include "workbench/prepare/recipe_document.h"
#include "workbench/window/case/document.h"
#include "workbench/window/case/rail.h"

using namespace vesselbench;
using namespace vesselbench::test;
using namespace std::chrono_literals;

namespace fs = std::filesystem;

namespace {

using Names = std::vector<std::string>;

void wait_for_rest(Document& document) {
    for (const auto end = std::chrono::steady_clock::now() + 60s;
         document.busy() && std::chrono::steady_clock::now() < end;
         std::this_thread::sleep_for(2ms))
        document.poll();
    REQUIRE_FALSE(document.busy());
}

void prepare(Document& document, const std::string& purpose, std::optional<Step> again_from = {}) {
    document.prepare(purpose, again_from);
    wait_for_rest(document);
    INFO((document.failure() ? document.failure()->text : "no failure"));
    REQUIRE_FALSE(document.failure());
}

bool told(const Document& document, const std::string& text) {
    return std::ranges::any_of(document.messages(), [&](const Message& message) {
        return message.text.find(text) != std::string::npos;
    });
}

/// Operations of the edits that a variant consists of.
Names operations_of(const Document& document, const std::string& variant) {
    Names names;
    for (const LogEntry& entry : document.snapshot()->log)
        if (is_part_of(entry.edit.place, variant)) names.push_back(entry.edit.operation);
    return names;
}

std::vector<EditRef> edits_of(const Document& document, const std::string& variant) {
    std::vector<EditRef> edits;
    for (const HistoryEntry& entry : document.snapshot()->history->line(variant))
        edits.push_back(entry.edit);
    return edits;
}

bool is_enabled(OffscreenShell& shell, const std::string& item) {
    return shell.has(item) && shell.app().ui().items().at(item).enabled;
}

}  // namespace

SCENARIO("A recipe is not made twice", "[window][prepare]") {
    const Names all = {"load-surface", "repair", "smooth", "subdivide"};
    Document document({.session = session_options(), .documents = temporary_folder()});
    document.open({.path = case_folder()});
    wait_for_rest(document);
    prepare(document, "cfd");
    REQUIRE(operations_of(document, "cfd") == all);
    const StateId state = document.snapshot()->history->current();
    const std::vector<EditRef> first = edits_of(document, "cfd");
    WHEN("the case is prepared for the same purpose") {
        CHECK(document.recipe("cfd").empty());
        prepare(document, "cfd");
        THEN("no edit is made, and a message says so") {
            CHECK(document.snapshot()->history->current() == state);
            CHECK(told(document, "Every edit of the recipe has been made"));
        }
    }
    WHEN("an edit is missing") {
        document.undo();
        wait_for_rest(document);
        prepare(document, "cfd");
        THEN("only that one is made") {
            CHECK(operations_of(document, "cfd") == all);
            const std::vector<EditRef> now = edits_of(document, "cfd");
            CHECK(std::equal(now.begin(), now.end() - 1, first.begin()));
            CHECK(now.back() != first.back());
        }
    }
    WHEN("it is prepared again from smoothing on") {
        const auto steps =
            repeatable_steps(document.to_prepare("cfd"), *document.snapshot(), "cfd");
        CHECK(steps == std::vector<Step>{Step::Smoothing, Step::Remeshing});
        prepare(document, "cfd", Step::Smoothing);
        THEN("these edits are new, and the earlier state is kept") {
            CHECK(operations_of(document, "cfd") == all);
            CHECK(edits_of(document, "cfd")[1] == first[1]);
            CHECK(edits_of(document, "cfd")[2] != first[2]);
            document.jump(state);
            wait_for_rest(document);
            CHECK(edits_of(document, "cfd") == first);
        }
    }
    WHEN("it is prepared for another purpose") {
        prepare(document, "rp");
        THEN("that one has edits of its own, and the first one's stay") {
            CHECK(document.variant() == "rp");
            CHECK(operations_of(document, "rp") ==
                  Names{"load-surface", "repair", "smooth", "decimate"});
            CHECK(edits_of(document, "cfd") == first);
            CHECK(pending_count(*document.snapshot(), "cfd") == 0);
            CHECK_FALSE(first_stale(*document.snapshot(), "cfd"));
        }
    }
}

SCENARIO("The dialog offers what is missing, or a step to start again from", "[window][prepare]") {
    const auto shell = test_shell();
    if (!shell) return;
    open_and_wait(*shell, case_folder().string());
    Document& document = shell->app().place().document;
    REQUIRE(shell->click_item("tool.prepare"));
    shell->frame();
    CHECK_FALSE(shell->has("prepare.extent"));
    REQUIRE(shell->click_item("prepare.run"));
    REQUIRE(wait_until_idle(*shell));
    const StateId state = document.snapshot()->history->current();
    REQUIRE(operations_of(document, "cfd").size() == 4);
    REQUIRE(shell->click_item("tool.prepare"));
    shell->frame();
    CHECK(shell->has("prepare.extent"));
    CHECK_FALSE(is_enabled(*shell, "prepare.run"));  // nothing is missing
    CHECK(document.snapshot()->history->current() == state);
}

SCENARIO("The dialog opens at the purpose of the chosen variant", "[window][prepare]") {
    const auto shell = test_shell();
    if (!shell) return;
    open_and_wait(*shell, case_folder().string());
    Workplace& place = shell->app().place();
    prepare(place.document, "cfd");
    place.document.show_variant("rp");
    REQUIRE(wait_until_idle(*shell));
    REQUIRE(shell->click_item("tool.prepare"));
    shell->frame();
    REQUIRE_FALSE(place.recipe.forms().empty());
    CHECK(place.recipe.forms().back().operation().name == "decimate");
    REQUIRE(shell->click_item("prepare.cancel"));
    place.document.show_variant("cfd");
    REQUIRE(wait_until_idle(*shell));
    REQUIRE(shell->click_item("tool.prepare"));
    shell->frame();
    CHECK(place.recipe.forms().empty());  // nothing is missing
}

SCENARIO("Values of a recipe are changed before it runs", "[window][prepare]") {
    const auto shell = test_shell();
    if (!shell) return;
    open_and_wait(*shell, case_folder().string());
    Workplace& place = shell->app().place();
    REQUIRE(shell->click_item("tool.prepare"));
    shell->frame();
    CHECK_FALSE(is_enabled(*shell, "prepare.restore"));
    REQUIRE(shell->click_item("prepare.entry.2"));
    shell->frame();
    REQUIRE(shell->fill_item("prepare.field.iterations", "7"));
    WHEN("it is run") {
        REQUIRE(shell->click_item("prepare.run"));
        REQUIRE(wait_until_idle(*shell));
        const auto& log = place.document.snapshot()->log;
        const auto smooth = std::ranges::find(
            log, "smooth", [](const LogEntry& entry) { return entry.edit.operation; });
        REQUIRE(smooth != log.end());
        CHECK(smooth->edit.given.integer("iterations") == 7);
        CHECK(operations_of(place.document, "cfd") ==
              Names{"load-surface", "repair", "smooth", "subdivide"});
    }
    WHEN("it is saved") {
        REQUIRE(shell->click_item("prepare.save"));
        CHECK(place.question() == FileQuestion::SaveRecipe);
        const fs::path file = fs::path(temporary_folder()) / "own.json";
        place.answer(file);
        shell->frame();
        THEN("the file is a recipe with the changed value") {
            const Recipe recipe = recipe_from_json(json_from_file(file), {"surface", "rp"});
            REQUIRE(recipe.size() == 3);
            CHECK(recipe[1].given->integer("iterations") == 7);
            CHECK(shell->has("prepare.run"));
        }
    }
    WHEN("a value is wrong") {
        REQUIRE(shell->fill_item("prepare.field.iterations", "-7"));
        shell->frame();
        CHECK_FALSE(is_enabled(*shell, "prepare.run"));
        CHECK_FALSE(is_enabled(*shell, "prepare.save"));
        REQUIRE(shell->click_item("prepare.restore"));
        shell->frame();
        CHECK(is_enabled(*shell, "prepare.run"));
        CHECK(place.recipe.forms()[1].field("iterations").text == "3");
    }
}

SCENARIO("A recipe's draft keeps its changes while the same edits are to be made",
         "[window][prepare]") {
    const Recipe recipe = default_recipe({"surface", "rp"});
    const auto remesh = static_cast<std::size_t>(
        std::ranges::find(recipe, "remesh",
                          [](const RecipeEntry& entry) { return entry.given.operation().name; }) -
        recipe.begin());
    REQUIRE(remesh < recipe.size());
    RecipeDraft draft;
    draft.follow(recipe);
    REQUIRE(draft.forms().size() == recipe.size());
    CHECK_FALSE(draft.is_changed());
    CHECK(recipe_to_json(draft.recipe()) == recipe_to_json(recipe));
    draft.set(remesh, "gradation", "1.3");
    draft.follow(recipe);
    CHECK(draft.is_changed(remesh));
    const Recipe changed = draft.recipe();
    CHECK(changed[remesh].given->real("gradation") == 1.3);
    CHECK(changed[remesh].given->real("print_resolution") == 0.1);
    for (std::size_t i = 0; i < recipe.size(); ++i) {
        const Arguments &before = recipe[i].given, &after = changed[i].given;
        CHECK((before == after) == (i != remesh));
        CHECK(step_of(changed[i]) == step_of(recipe[i]));
    }
    draft.set(remesh, "gradation", "9");
    CHECK_FALSE(draft.error().empty());
    draft.follow(default_recipe({"surface", "cfd"}));
    CHECK_FALSE(draft.is_changed());
    CHECK(draft.error().empty());
}

SCENARIO("The edits of a case are saved as a recipe", "[window][prepare]") {
    const auto shell = test_shell();
    if (!shell) return;
    open_and_wait(*shell, case_folder().string());
    Workplace& place = shell->app().place();
    place.document.apply("repair", {}, Step::Source);
    REQUIRE(wait_until_idle(*shell));
    shell->frame();
    REQUIRE(shell->click_item("tool.save_recipe"));
    CHECK(place.question() == FileQuestion::SaveEdits);
    const fs::path file = fs::path(temporary_folder()) / "edits.json";
    place.answer(file);
    shell->frame();
    const RecipeDocument recipe = find_recipe(file.string());
    CHECK(recipe.text ==
          recipe_of_edits(*place.document.snapshot(), place.document.variant(), false));
    REQUIRE(recipe.entries.size() >= 1);
    CHECK(recipe.entries.back()["operation"] == "repair");
}
