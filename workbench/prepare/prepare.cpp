#include "workbench/prepare/prepare.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/pending_files.h"
#include "geometry/kernel/whole_file.h"
#include "workbench/case/json_text.h"
#include "workbench/export/products.h"
#include "workbench/operations/table.h"
#include "workbench/prepare/apply_recipe.h"
#include "workbench/prepare/model_check.h"
#include "workbench/prepare/prepare_report.h"
#include "workbench/session/stored_recipes.h"

namespace vesselbench {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Fraction of the progress for the edits; the rest is for reports and files.
constexpr double kEditsShare = 0.8;

/// Removes a project that is empty because its first edit failed.
void remove_project(const fs::path& project) {
    std::error_code ignored;
    for (const char* suffix : {"", "-wal", "-shm", "-journal"})
        fs::remove(project.string() + suffix, ignored);
}

/// Removes all traces of a run on an unusable input.
void clear_away(const fs::path& project, bool new_folder) {
    remove_project(project);
    std::error_code ignored;
    if (new_folder) fs::remove(project.parent_path(), ignored);  // keeps a folder that is not empty
}

/// An earlier project is kept as project.1.vbench, project.2.vbench ...
void keep_earlier_project(const fs::path& project, const Teller& tell) {
    if (!fs::exists(project)) return;
    fs::path other;
    for (int number = 1; other.empty() || fs::exists(other); ++number)
        other = project.parent_path() / ("project." + std::to_string(number) + ".vbench");
    std::error_code error;
    for (const char* suffix : {"", "-wal"})
        if (fs::exists(project.string() + suffix))
            fs::rename(project.string() + suffix, other.string() + suffix, error);
    if (error) throw IoError("the existing 'project.vbench' cannot be renamed: " + error.message());
    tell("the existing project.vbench was renamed to " + other.filename().string());
}

Json recipe_json_from(const PrepareOptions& options, const Input& input) {
    if (!options.recipe.empty()) {
        try {
            return json_from_file(options.recipe);
        } catch (const InvalidInput& error) {
            throw UsageError(std::string("recipe: ") + error.what());
        }
    }
    return own_recipe(input, options.purpose);
}

/// The recipe preceded by the edit that loads the input, with its files and units filled in.
Recipe recipe_for(const PrepareOptions& options, const Input& input) {
    const RecipeUse use = recipe_use(input, options.purpose);
    const Json json = recipe_json_from(options, input);
    Recipe recipe = json.is_null() ? default_recipe(use) : recipe_from_json(json, use);
    const RecipeEntry loading = loading_entry(input);
    if (recipe.empty() || &recipe.front().given.operation() != &loading.given.operation())
        recipe.insert(recipe.begin(), loading);
    else
        recipe.front().given.set(loading.given);
    set_arguments(recipe, options.arguments);
    // No entry runs if a later one cannot.
    for (const RecipeEntry& entry : recipe) check_complete(entry.given);
    return recipe;
}

bool is_edit_of(const LogEntry& made, const RecipeEntry& entry, const std::string& variant) {
    const Step step = entry.step.value_or(entry.given.operation().usual_step);
    return made.edit.operation == entry.given.operation().name && made.edit.place.step == step &&
           (made.edit.place.variant.empty() || made.edit.place.variant == variant);
}

/// The entries after the last one that has an edit in the log, in the recipe's order.
Recipe rest_of(Recipe recipe, const std::vector<LogEntry>& log, const std::string& variant) {
    std::size_t done = 0;
    auto from = log.begin();
    for (std::size_t i = 0; i < recipe.size(); ++i) {
        const auto found = std::find_if(from, log.end(), [&](const LogEntry& made) {
            return is_edit_of(made, recipe[i], variant);
        });
        if (found == log.end()) continue;
        from = found + 1;
        done = i + 1;
    }
    recipe.erase(recipe.begin(), recipe.begin() + static_cast<std::ptrdiff_t>(done));
    return recipe;
}

Session resumed(const fs::path& project) {
    Session session = Session::open(project, {.find = find_operation});
    if (!session.read_only_reason().empty()) throw IoError(session.read_only_reason());
    return session;
}

/// So that a reopened project still has them.
void keep_recipes(const fs::path& project, const Input& input) {
    if (input.recipes) store_recipes(project, input.recipes->dump());
}

/// True if the recipe leaves it to clip-opening which ends it opens where, and removes nothing
/// afterwards: a vessel that is missing then is missing unasked.
bool decides_by_itself(const Recipe& recipe, Recipe::const_iterator cut) {
    for (const char* asked : {"tip", "distance", "radii", "planes"})
        if (cut->given->has(asked)) return false;
    return std::none_of(cut + 1, recipe.end(), [](const RecipeEntry& entry) {
        const std::string& name = entry.given.operation().name;
        return name == "remove-branch" || name == "crop" || name == "clip-opening";
    });
}

/// Applies the recipe; a model that has lost vessels, or an opening in a vessel's side, is an
/// error.
std::vector<std::string> apply_checked(Session& session, const Recipe& recipe,
                                       const std::string& variant, const Teller& tell,
                                       const Progress& progress) {
    const auto cut = std::ranges::find_if(
        recipe, [](const RecipeEntry& entry) { return entry.given.operation().recipe.cuts_ends; });
    if (cut == recipe.end() || cut == recipe.begin() || !decides_by_itself(recipe, cut))
        return apply_recipe(session, recipe, variant, tell, progress);
    const double size = static_cast<double>(recipe.size());
    const double until = static_cast<double>(cut - recipe.begin()) / size;
    auto warnings = apply_recipe(session, Recipe(recipe.begin(), cut), variant, tell,
                                 progress.part(0.0, until));
    const Surface before = surface_of(session.scene(variant));
    const auto add = [&](const Recipe& part, double from, double to) {
        const auto more = apply_recipe(session, part, variant, tell, progress.part(from, to));
        warnings.insert(warnings.end(), more.begin(), more.end());
    };
    add({*cut}, until, until + 1.0 / size);
    check_openings(before, surface_of(session.scene(variant)));
    add(Recipe(cut + 1, recipe.end()), until + 1.0 / size, 0.98);
    check_vessels(before, surface_of(session.scene(variant)), progress.part(0.98, 1.0));
    return warnings;
}

PrepareSummary write_results(Session& session, const PrepareOptions& options, PreparedCase prepared,
                             const Progress& progress) {
    PendingFiles files;
    progress.report(0.0, "writing the products");
    prepared.products =
        write_products(files, options.out, prepared.scene, options.purpose, prepared.flow);
    const PreparedReport report = prepare_report(session, prepared, progress.part(0.3, 1.0));
    files.add_text(options.out / "report.json", report.document.dump(2) + "\n");
    files.add_text(options.out / "report.html",
                   report_html(report.document, report.pictures, report.sections));
    progress.check_cancelled();
    files.commit();
    return {prepared.products, report.warnings};
}

}  // namespace

PrepareSummary prepare(const PrepareOptions& options, const Teller& tell,
                       const Progress& progress) {
    const Input input = resolve_input(options.input, progress.part(0.0, 0.02));
    PrepareOptions for_recipe = options;
    PreparedCase prepared{.purpose = options.purpose, .input = input};
    prepared.flow = take_flow_parameters(for_recipe.arguments);
    Recipe recipe = recipe_for(for_recipe, input);
    const bool new_folder = !fs::exists(options.out);
    make_folder(options.out);
    const fs::path project = options.out / "project.vbench";
    if (!options.resume) keep_earlier_project(project, tell);
    bool any_edit = options.resume;
    try {
        Session session =
            options.resume ? resumed(project) : Session::create(project, {.find = find_operation});
        if (options.resume)
            recipe = rest_of(std::move(recipe), session.log(), options.purpose);
        else
            keep_recipes(project, input);
        const Teller noting = [&](const std::string& text) {
            any_edit = true;
            tell(text);
        };
        prepared.warnings = apply_checked(session, recipe, options.purpose, noting,
                                          progress.part(0.02, kEditsShare));
        prepared.scene = session.scene(options.purpose);
        try {
            return write_results(session, options, std::move(prepared),
                                 progress.part(kEditsShare, 1.0));
        } catch (const InvalidInput& error) {
            throw AlgorithmFailure(error.what());  // the model lacks something the product needs
        }
    } catch (const UnusableSource&) {
        if (!options.resume) clear_away(project, new_folder);
        throw;
    } catch (const std::exception&) {
        if (!any_edit)
            clear_away(project, new_folder);
        else
            tell("the completed edits are kept in " + project.filename().string() +
                 "; no other file was written; --resume goes on there, also after an edit by hand");
        throw;
    }
}

Session start_project(const fs::path& project, const Input& input, SessionOptions options,
                      const Teller& tell, const Progress& progress) {
    const RecipeEntry loading = loading_entry(input);
    Session session = Session::create(project, std::move(options));
    try {
        keep_recipes(project, input);
        apply_recipe(session, {loading}, "", tell, progress);
    } catch (const std::exception&) {
        remove_project(project);
        throw;
    }
    return session;
}

void new_project(const fs::path& project, const InputOptions& options, const Teller& tell,
                 const Progress& progress) {
    const Input input = resolve_input(options, progress.part(0.0, 0.3));
    static_cast<void>(
        start_project(project, input, {.find = find_operation}, tell, progress.part(0.3, 1.0)));
}

}  // namespace vesselbench
