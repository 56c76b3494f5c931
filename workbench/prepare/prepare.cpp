#include "workbench/prepare/prepare.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/pending_files.h"
#include "geometry/kernel/whole_file.h"
#include "geometry/kernel/wording.h"
#include "workbench/case/argument_texts.h"
#include "workbench/export/products.h"
#include "workbench/operations/table.h"
#include "workbench/prepare/prepare_report.h"
#include "workbench/report/log_json.h"

namespace vesselbench {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Fraction of the progress for the edits; the rest is for reports and files.
constexpr double kEditsShare = 0.8;

/// The loaded surface cannot be repaired: the input is bad, not the recipe.
class UnusableSource : public InvalidInput {
public:
    using InvalidInput::InvalidInput;
};

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
        const std::string name = fs::path(options.recipe).filename().string();
        try {
            return Json::parse(file_content(options.recipe));
        } catch (const nlohmann::json::exception& error) {
            throw UsageError("recipe '" + name + "' is not valid JSON: " + error.what());
        }
    }
    if (!input.recipes) return nullptr;
    if (input.recipes->is_array()) return *input.recipes;
    return input.recipes->value(options.purpose, Json());
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

std::string told(const LogEntry& entry) {
    const std::string seconds = formatted(entry.result ? entry.result->duration : 0.0, "%.1f s");
    const std::string change = entry.result ? change_text(entry.result->change) : "";
    return to_string(entry.edit.place.step) + ": " + entry.edit.operation + " (" + seconds + ")" +
           (change.empty() ? "" : ": " + change);
}

/// Where an operation that keeps the volume changes it by more than this [-], the surface is too
/// coarse for it.
constexpr double kNoticedChange = 0.03;

/// What a user should know of an edit beside its own warnings; else empty.
std::string noticed(const LogEntry& entry) {
    const std::string& remedy = find_operation(entry.edit.operation).recipe.volume_remedy;
    if (remedy.empty() || !entry.result) return "";
    const SurfaceChange& change = entry.result->change;
    if (!change.volume_before || !change.volume_after || *change.volume_before <= 0) return "";
    const double ratio = *change.volume_after / *change.volume_before;
    if (std::abs(ratio - 1.0) <= kNoticedChange) return "";
    return entry.edit.operation + " changed the volume by " +
           formatted(100.0 * (ratio - 1.0), "%.1f") + " %: " + remedy;
}

/// Applies one entry. \return a warning in addition to the edit's own; empty if there is none
std::string apply_entry(Session& session, const RecipeEntry& entry, const std::string& variant,
                        const Teller& tell, const Progress& progress) {
    const Operation& operation = entry.given.operation();
    try {
        const LogEntry done =
            session.apply(entry.given, {.step = entry.step, .variant = variant}, progress);
        tell(told(done));
        if (done.result)
            for (const std::string& warning : done.result->warnings)
                tell("warning: " + operation.name + ": " + warning);
        const std::string warning = noticed(done);
        if (!warning.empty()) tell("warning: " + warning);
        return warning;
    } catch (const InvalidInput& error) {
        // The loaded data was accepted: from here on, the operation is to blame.
        if (operation.usual_step == Step::Source) throw;
        throw AlgorithmFailure(error.what());
    } catch (const AlgorithmFailure& error) {
        if (operation.recipe.proves_source) throw UnusableSource(error.what());
        if (entry.otherwise) {
            RecipeEntry second = entry;
            second.otherwise.reset();
            second.given.set(*entry.otherwise);
            std::string changed;
            for (const auto& [name, value] : (*entry.otherwise)->values())
                changed += (changed.empty() ? "" : " ") + name + "=" + to_text(value);
            const std::string warning =
                operation.name + " with " + changed + " instead: " + error.what();
            tell("warning: " + warning);
            const std::string more = apply_entry(session, second, variant, tell, progress);
            return more.empty() ? warning : warning + "; " + more;
        }
        if (!entry.optional) throw;
        const std::string warning = operation.name + " was skipped: " + error.what();
        tell("warning: " + warning);
        return warning;
    }
}

bool is_left_out(Session& session, const RecipeEntry& entry, const std::string& variant) {
    return entry.unless_closed &&
           surface_of(session.scene(variant)).topology->boundary_loops().empty();
}

std::vector<std::string> apply_recipe(Session& session, const Recipe& recipe,
                                      const std::string& variant, const Teller& tell,
                                      const Progress& progress) {
    std::vector<std::string> warnings;
    const double share = 1.0 / static_cast<double>(recipe.size());
    for (std::size_t i = 0; i < recipe.size(); ++i) {
        if (is_left_out(session, recipe[i], variant)) continue;
        const double from = share * static_cast<double>(i);
        const std::string warning =
            apply_entry(session, recipe[i], variant, tell, progress.part(from, from + share));
        if (!warning.empty()) warnings.push_back(warning);
    }
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
    const Recipe recipe = recipe_for(for_recipe, input);
    const bool new_folder = !fs::exists(options.out);
    make_folder(options.out);
    const fs::path project = options.out / "project.vbench";
    keep_earlier_project(project, tell);
    bool any_edit = false;
    try {
        Session session = Session::create(project, {.find = find_operation});
        const Teller noting = [&](const std::string& text) {
            any_edit = true;
            tell(text);
        };
        prepared.warnings = apply_recipe(session, recipe, options.purpose, noting,
                                         progress.part(0.02, kEditsShare));
        prepared.scene = session.scene(options.purpose);
        try {
            return write_results(session, options, std::move(prepared),
                                 progress.part(kEditsShare, 1.0));
        } catch (const InvalidInput& error) {
            throw AlgorithmFailure(error.what());  // the model lacks something the product needs
        }
    } catch (const UnusableSource&) {
        clear_away(project, new_folder);
        throw;
    } catch (const std::exception&) {
        if (!any_edit)
            clear_away(project, new_folder);
        else
            tell("the completed edits are kept in " + project.filename().string() +
                 "; no other file was written");
        throw;
    }
}

void new_project(const fs::path& project, const InputOptions& options, const Teller& tell,
                 const Progress& progress) {
    const Input input = resolve_input(options, progress.part(0.0, 0.3));
    const RecipeEntry loading = loading_entry(input);
    Session session = Session::create(project, {.find = find_operation});
    try {
        apply_entry(session, loading, "", tell, progress.part(0.3, 1.0));
    } catch (const std::exception&) {
        remove_project(project);
        throw;
    }
}

}  // namespace vesselbench
