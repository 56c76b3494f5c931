#include "workbench/commands/recipe_commands.h"

#include <memory>

#include "geometry/kernel/wording.h"
#include "workbench/case/purposes.h"
#include "workbench/prepare/recipe_document.h"

namespace vesselbench {

namespace {

constexpr const char* kFooter =
    "  list        the bundled recipes\n"
    "  show R      the text of a recipe; with --json what it comes to, with all of its entries\n"
    "  check R     all mistakes in a recipe, by line\n"
    "  diff A B    what differs between two recipes, with defaults filled in\n"
    "  schema      the JSON Schema of recipes, for editors\n"
    "R, A and B are files, bundled recipes, or projects (.vbench), which keep the recipe they "
    "were\n"
    "given. 'log PROJECT --recipe' writes a project's edits as a recipe.\n"
    "Exit code 1 if recipes differ, 3 if a recipe has mistakes.\n"
    "\n"
    "  vesselbench recipe show tree-cfd > ours.json\n"
    "  vesselbench recipe check ours.json\n"
    "  vesselbench recipe diff tree-cfd ours.json";

}  // namespace

void add_recipe_commands(CommandLine& line) {
    const auto options = std::make_shared<RecipeOptions>();
    CLI::App& command = add_command(line, "recipe", "List, show, check and compare recipes",
                                    [options] { return use_recipes(*options); });
    command.add_option("ACTION", options->action, "list, show, check, diff or schema")
        ->required()
        ->type_name("")
        ->check(CLI::IsMember(recipe_actions()).description(""));
    command
        .add_option("RECIPE", options->recipes,
                    "A file, a project, or one of " + joined(bundled_recipe_names()))
        ->type_name("");
    command
        .add_option("--for", options->purpose,
                    "Of a project, the recipe for this purpose (default: the only one)")
        ->type_name(joined(purpose_names(), "|"));
    add_json(command, options->json);
    command.footer(kFooter);
}

}  // namespace vesselbench
