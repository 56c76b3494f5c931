#include "workbench/prepare/prepare.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/pending_files.h"
#include "geometry/kernel/printable.h"
#include "geometry/kernel/whole_file.h"
#include "geometry/kernel/wording.h"
#include "geometry/vessel/openings/opening_axis.h"
#include "workbench/case/json_text.h"
#include "workbench/case/label_choice.h"
#include "workbench/case/purposes.h"
#include "workbench/export/products.h"
#include "workbench/flow/outlet_shares.h"
#include "workbench/operations/table.h"
#include "workbench/prepare/acceptance_gate.h"
#include "workbench/prepare/apply_recipe.h"
#include "workbench/prepare/case_files.h"
#include "workbench/prepare/end_question.h"
#include "workbench/prepare/extraction_entry.h"
#include "workbench/prepare/kept_recipe.h"
#include "workbench/prepare/marked_sac.h"
#include "workbench/prepare/model_check.h"
#include "workbench/prepare/prepare_report.h"
#include "workbench/prepare/prepared_purposes.h"
#include "workbench/prepare/recipe_document.h"
#include "workbench/prepare/recipe_warnings.h"
#include "workbench/prepare/refinements.h"
#include "workbench/prepare/refusal_report.h"
#include "workbench/prepare/result_folder.h"
#include "workbench/prepare/resume.h"
#include "workbench/prepare/resumed_recipe.h"
#include "workbench/prepare/vessel_question.h"
#include "workbench/report/requirements.h"
#include "workbench/review/provenance.h"
#include "workbench/session/export_record.h"
#include "workbench/session/source_counterpart.h"
#include "workbench/session/stored_texts.h"

namespace vesselbench {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Fraction of the progress for the edits, and until the shares of the outlets are known; the rest
/// is for reports and files.
constexpr double kEditsShare = 0.8;
constexpr double kOutletsShare = 0.85;

/// \throw UsageError if a result would replace what it is made from
void refuse_own_input(const PrepareOptions& options, const Input& input) {
    const std::vector<std::string> names = result_names(options.purpose);
    std::vector<fs::path> sources = {input.file, input.mask, options.recipe};
    for (const RecipeEntry& entry : input.neighbours)
        sources.emplace_back(entry.given->optional_text("file").value_or(""));
    for (const fs::path& source : sources)
        for (const std::string& name : names) {
            std::error_code ignored;
            if (!source.empty() && fs::equivalent(options.out / name, source, ignored))
                throw UsageError("'" + name +
                                 "' is an input, and a result of the same name would replace it: "
                                 "give another --out");
        }
}

/// Openings with their diameters; empty if there are none.
std::string openings_text(const Surface& surface) {
    std::vector<std::string> texts;
    for (std::size_t p = 0; p < surface.patches.size(); ++p)
        if (surface.patches[p].kind != PatchKind::Wall)
            texts.push_back(surface.patches[p].name +
                            formatted(patch_shape(surface, p).diameter(), " (%.3g mm)"));
    return joined(texts);
}

/// None: no recipe was given.
std::optional<RecipeDocument> given_recipe(const PrepareOptions& options) {
    if (options.recipe.empty()) return std::nullopt;
    RecipeDocument recipe = find_recipe(options.recipe);
    require_purpose(recipe, options.purpose);
    return recipe;
}

/// The recipe preceded by the edit that loads the input, with its files and units filled in.
Recipe recipe_for(const PrepareOptions& options, const Input& input, const Json& json) {
    Recipe recipe = input_recipe(input, options.purpose, json);
    set_arguments(recipe, options.arguments);
    add_entries(recipe, refinements(options.refinements));
    // No entry runs if a later one cannot.
    for (const RecipeEntry& entry : recipe) check_complete(entry.given);
    return recipe;
}

/// By the recipe; the built-in one asks for none.
std::size_t reviewers_asked(const PrepareOptions& options, const Input& input, const Json& json) {
    return json.is_null() ? 0 : reviewers_required(json, recipe_use(input, options.purpose));
}

/// The folder's project: a new one, for which an earlier one is renamed while no other process can
/// open it for writing, or the one that is resumed.
Session opened_project(const PrepareOptions& options, const Teller& tell) {
    const fs::path project = options.out / kProjectFile;
    const SessionOptions how{.author = options.author, .find = find_operation};
    if (options.resume) return resumed(project, how);
    return Session::create(project, how, [&] { keep_earlier(project, tell); });
}

/// The case's folder as a path from the project's; empty if it is not in there: a project does not
/// lead out of its folder, and does not say what other folders are called.
std::string case_folder_from(const fs::path& project, const Input& input) {
    std::error_code error;
    const fs::path way =
        fs::relative(input.folder, fs::absolute(project).parent_path(), error).generic_string();
    const bool inside = !error && !way.empty() && *way.begin() != "..";
    return inside && is_utf8(way.string()) ? way.string() : "";
}

/// So that a reopened project has them.
void keep_recipes(const fs::path& project, const Input& input) {
    if (!input.recipes) return;
    store_text(project, StoredText::Recipes, input.recipes->dump());
    store_text(project, StoredText::CaseFolder, case_folder_from(project, input));
}

/// So that what is made of the project later shows no file's name either.
void keep_name(const fs::path& project, const Input& input) {
    if (input.is_renamed) store_text(project, StoredText::InputName, input.name);
}

/// The input, with the name that a project which is resumed was given unless there is a new one.
InputOptions named_input(const PrepareOptions& options) {
    InputOptions input = options.input;
    const fs::path project = options.out / kProjectFile;
    if (options.resume && input.name.empty() && fs::exists(project))
        input.name = stored_text(project, StoredText::InputName);
    return input;
}

/// What a resumed preparation does first, unless edits of the recipe follow.
/// \param log of the purpose
void tell_rest(const ResumedRecipe& resumed, const std::vector<LogEntry>& log, const Teller& tell) {
    for (const std::string& remark : resumed.remarks) tell.warn(plain_text(remark));
    if (!resumed.rest.empty()) return;
    const auto pending =
        static_cast<std::size_t>(std::ranges::count(log, EditStatus::Pending, &LogEntry::status));
    tell(all_made_text(resumed) + ": " +
         (pending == 0 ? "" : "running " + counted(pending, "pending edit") + ", then ") +
         "writing the results");
}

/// What is left of the recipe in the folder's project. The report warns of what differs.
/// \param options without the settings of the flow
/// \throw UsageError if it cannot be made there
Recipe rest_in(Session& session, const Recipe& recipe, const PrepareOptions& options,
               PreparedCase& prepared, const Teller& tell) {
    refuse_other_input(session, prepared.input);
    const ResumedRecipe here = resumed_recipe(recipe, *session.snapshot(), options.purpose,
                                              prepared_purposes(options.out / kProjectFile).done);
    if (!here.refusal.empty()) throw UsageError("--resume: " + here.refusal);
    const std::vector<LogEntry> log = session.log(options.purpose);
    refuse_late_settings(options.arguments, here.rest, log);
    tell_rest(here, log, tell);
    for (const std::string& remark : here.remarks) prepared.warnings.push_back(plain_text(remark));
    return here.rest;
}

/// What was given of the flow, if it is of use; a resumed preparation says where it is from.
void tell_flow(const PrepareOptions& options, const FlowSettings& flow, const Teller& tell) {
    const std::string text = flow.text();
    if (!options.resume || text.empty() || !find_purpose(options.purpose).simulates_flow) return;
    const bool changed = std::ranges::any_of(options.arguments, [](const std::string& argument) {
        return argument.starts_with("openfoam.");
    });
    tell((changed ? "flow: " : "flow as before: ") + text);
}

/// Of a flow that the outlets share along the centerlines, before a mesh is made of the surface.
/// \throw AlgorithmFailure if an outlet gets none
void check_outlets(Session& session, const PreparedCase& prepared, const Progress& progress) {
    if (prepared.flow.outlets != OutletFlow::Bifurcations ||
        !find_purpose(prepared.purpose).simulates_flow)
        return;
    std::vector<LogEntry> made = session.log(prepared.purpose);
    std::erase_if(made, [](const LogEntry& entry) {
        return !entry.result || entry.edit.place.step >= Step::Product;
    });
    if (made.empty()) return;
    const Scene scene = session.scene_after(made.back().edit.edit.id, progress.silent());
    try {
        static_cast<void>(
            with_outlet_shares(flow_in_vessel(prepared.flow, made), surface_of(scene), progress));
    } catch (const InvalidInput& error) {
        throw AlgorithmFailure(error.what());  // the model lacks something the case needs
    }
}

/// Applies what is left of the recipe and runs pending edits, in the order of the case. A model
/// that has lost vessels, an opening in a vessel's side, or an outlet without a share of the flow
/// is an error as early as it can be seen, and so is an edit that no longer applies.
/// \return a warning of the checks
std::optional<Diagnostic> make_model(Session& session, const Recipe& recipe,
                                     const PrepareOptions& options, const PreparedCase& prepared,
                                     const Teller& tell, const Progress& progress) {
    ModelChecks checks(session, options.purpose);
    const Progress quiet = progress.silent();
    const RecipeWatch watch{.before =
                                [&](Step step, const Progress& before) {
                                    if (step < Step::Product) return;
                                    checks.surface_final(quiet);
                                    check_outlets(session, prepared, before);
                                },
                            .after =
                                [&](const LogEntry& edit) {
                                    if (edit.status == EditStatus::Stale)
                                        refuse_stale_edits({edit});
                                    checks.after(edit, quiet);
                                },
                            .warned =
                                [&](const RecipeWarning& warning) {
                                    keep_warning(options.out / kProjectFile, warning);
                                }};
    const double until =
        static_cast<double>(recipe.size()) / static_cast<double>(recipe.size() + 1);
    run_recipe(session, recipe, options.purpose, tell, progress.part(0.0, until), watch);
    run_pending(session, options.purpose, Step::Review, tell, progress.part(until, 0.99), watch);
    checks.surface_final(quiet);
    if (checks.warning()) tell.warn(*checks.warning());
    return checks.warning();
}

/// Earlier results of another purpose are not of this model.
void tell_remaining(const std::vector<std::string>& names, const Teller& tell) {
    if (!names.empty())
        tell.warn({.code = names.size() == 1 ? "earlier-result" : "earlier-results",
                   .words = {{"files", enumerated(names)}}});
}

void write_products(PendingFiles& files, Session& session, const PrepareOptions& options,
                    PreparedCase& prepared, const Progress& progress) {
    const ExportOptions how{
        .flow = prepared.flow,
        .provenance = provenance(session, options.purpose, review_of(session, options.purpose)),
        .ends = made_ends(session, options.purpose, progress.silent()),
        .neck = recorded_neck(session.log(options.purpose))};
    const std::vector<std::string> names = product_names(options.purpose);
    const auto done = [&](std::size_t count) {
        return static_cast<double>(count) / static_cast<double>(names.size());
    };
    for (std::size_t i = 0; i < names.size(); ++i) {
        const Progress one = progress.part(done(i), done(i + 1));
        one.report(0.0, "writing the products");
        export_scene(files, options.out / names[i], prepared.scene, how, one);
        prepared.products.push_back(names[i]);
    }
}

/// \throw AlgorithmFailure if the project's file cannot be made whole
void fold_log(const Session& session) {
    try {
        session.fold_log();
    } catch (const IoError& error) {
        throw AlgorithmFailure(error.what());  // the input is good
    }
}

/// "smoothness: at most 1 % of ..."
std::vector<std::string> missed_requirements(const Json& report) {
    std::vector<std::string> texts;
    for (const Json& row : report.value("requirements", Json::array()))
        if (row.at("judgement") == to_string(Judgement::NotMet))
            texts.push_back(row.at("requirement").get<std::string>() + ": " +
                            row.at("limit").get<std::string>());
    return texts;
}

std::string print_verdict(const Json& report) {
    return report.value("print", Json::object()).value("headline", "");
}

PrepareSummary write_results(Session& session, const PrepareOptions& options, PreparedCase prepared,
                             const Teller& tell, const Progress& progress) {
    const std::vector<std::string> names = result_names(options.purpose);
    const std::vector<std::string> earlier = earlier_results(options.out);
    keep_irreplaceable(options.out, names, tell);
    prepared.earlier_results = remaining_results(options.out, names, earlier);
    PendingFiles files;
    write_products(files, session, options, prepared, progress.part(0.0, 0.3));
    const PreparedReport report = prepare_report(session, prepared, progress.part(0.3, 1.0));
    files.add_mark(options.out / "report.html",
                   report_html(report.document, report.pictures, report.sections));
    files.add_mark(options.out / "report.json", text_from_json(report.document, 2) + "\n");
    progress.check_cancelled();
    keep_others(options.out, names, earlier, tell);
    files.commit();
    for (const std::string& product : prepared.products)
        record_export(session, options.out / product, options.purpose);
    fold_log(session);
    tell_remaining(prepared.earlier_results, tell);
    return {prepared.products, report.warnings, missed_requirements(report.document),
            print_verdict(report.document)};
}

/// report.json of a preparation that stopped, and how to go on.
void write_refusal(const PrepareOptions& options, const std::exception& error, const Recipe& rest,
                   const Teller& tell) {
    const std::vector<std::string> names = {"report.json"};
    const std::vector<std::string> earlier = earlier_results(options.out);
    keep_others(options.out, names, earlier, tell);
    const Json report =
        refusal_json(options, error, remaining_results(options.out, names, earlier), rest);
    write_file(options.out / names.front(), text_from_json(printable_json(report), 2) + "\n");
    tell(std::string("the completed edits are kept in ") + kProjectFile +
         "; report.json lists what was found; --resume continues there, also after a manual edit");
}

/// Makes what is missing of the model, and writes the results.
PrepareSummary finished(Session& session, const Recipe& rest, const PrepareOptions& options,
                        PreparedCase prepared, const Teller& tell, const Progress& progress) {
    const std::optional<Diagnostic> warning =
        make_model(session, rest, options, prepared, tell, progress.part(0.0, kEditsShare));
    for (Diagnostic& kept : kept_warnings(options.out / kProjectFile, session, options.purpose))
        prepared.warnings.push_back(std::move(kept));
    if (warning) prepared.warnings.push_back(*warning);
    prepared.scene = session.scene(options.purpose);
    const std::vector<LogEntry> log = session.log(options.purpose);
    prepared.flow = flow_in_vessel(prepared.flow, log);
    refuse_stale_edits(log);
    end_purpose(options.out / kProjectFile, options.purpose);
    fold_log(session);
    const std::string openings = openings_text(surface_of(prepared.scene));
    if (!openings.empty()) tell("openings: " + openings);
    try {
        pass_gate(session, options.purpose, prepared.reviewers, options.out, tell,
                  progress.silent());
        if (prepared.scene.volume_mesh)
            prepared.flow =
                with_outlet_shares(std::move(prepared.flow), *prepared.scene.volume_mesh,
                                   progress.part(kEditsShare, kOutletsShare));
        return write_results(session, options, std::move(prepared), tell,
                             progress.part(kOutletsShare, 1.0));
    } catch (const InvalidInput& error) {
        throw AlgorithmFailure(error.what());  // the model lacks something the product needs
    }
}

/// What the project keeps of its preparation beside the edits.
/// \return the number of reviewers who have to accept the model
std::size_t begin_project(const PrepareOptions& options, const Input& input,
                          const std::optional<RecipeDocument>& given, const Json& recipe_json,
                          const FlowSettings& flow) {
    const fs::path project = options.out / kProjectFile;
    if (!options.resume) keep_recipes(project, input);
    if (given) keep_recipe(project, options.purpose, *given);
    keep_name(project, input);
    begin_purpose(project, options.purpose);
    if (!flow.stored().empty()) store_text(project, StoredText::Flow, flow.stored());
    return kept_reviewers(project, options.purpose, reviewers_asked(options, input, recipe_json));
}

bool is_diagnosed(const std::exception& error) {
    return dynamic_cast<const Diagnosed*>(&error) != nullptr;
}

/// The vessel is not chosen among the labels: there is no model yet to go on with.
bool lacks_label(const std::exception& error) {
    return is_diagnosed(error) && diagnostics_of(error).front().code == kLabelUnchosen;
}

/// Of a preparation that stopped: the project, if there is an edit in it, and how to go on.
void keep_what_was_made(Session& session, const PrepareOptions& options, const Recipe& recipe,
                        bool any_edit, const std::exception& error, const Teller& tell) {
    const Recipe rest = resumed_recipe(recipe, *session.snapshot(), options.purpose, {}).rest;
    if (options.refused && is_diagnosed(error)) options.refused(refused_json(options, error, rest));
    const bool unusable =
        dynamic_cast<const UnusableSource*>(&error) != nullptr || lacks_label(error);
    if (unusable ? !options.resume : !any_edit) return session.discard();
    if (unusable) return;
    if (is_diagnosed(error)) return write_refusal(options, error, rest, tell);
    if (dynamic_cast<const UsageError*>(&error) != nullptr) return;
    tell("the completed edits are kept in " + std::string(kProjectFile) +
         "; the results were not written; --resume continues there, also after a manual edit");
}

}  // namespace

PrepareSummary prepare(const PrepareOptions& options, const Teller& tell,
                       const Progress& progress) {
    const fs::path project = options.out / kProjectFile;
    if (options.resume && !fs::exists(project))
        throw UsageError("--resume: there is no project.vbench in '" +
                         options.out.filename().string() + "' to go on with");
    Input input = resolve_input(named_input(options), progress.part(0.0, 0.02));
    if (options.resume) take_kept_recipes(input, project);
    take_settings_of_mask(input, options.arguments);
    PrepareOptions for_recipe = options;
    FlowSettings flow(options.resume ? stored_text(project, StoredText::Flow) : "");
    flow.take(for_recipe.arguments);
    const std::optional<RecipeDocument> given = given_recipe(options);
    const Json recipe_json = given ? given->entries : own_recipe(input, options.purpose);
    const Recipe recipe = recipe_for(for_recipe, input, recipe_json);
    refuse_own_input(options, input);
    const ResultFolder folder(options.out);
    Session session = opened_project(options, tell);
    bool any_edit = options.resume;
    const Teller noting(
        [&](const std::string& text) {
            any_edit = true;
            tell(text);
        },
        [&](const Diagnostic& warning) {
            any_edit = true;
            tell.warn(warning);
        });
    try {
        PreparedCase prepared{
            .purpose = options.purpose, .input = input, .flow = flow.parameters()};
        Recipe rest = recipe;
        if (options.resume) {
            rest = rest_in(session, recipe, for_recipe, prepared, tell);
            tell_flow(options, flow, tell);
        }
        prepared.reviewers = begin_project(options, input, given, recipe_json, flow);
        return finished(session, rest, options, std::move(prepared), noting,
                        progress.part(0.02, 1.0));
    } catch (const std::exception& error) {
        keep_what_was_made(session, options, recipe, any_edit, error, tell);
        if (options.question)
            write_end_question(session, recipe, options, error, progress.silent());
        throw;
    }
}

Session start_project(const fs::path& project, const Input& input, SessionOptions options,
                      const Teller& tell, const Progress& progress) {
    const Recipe loading = loading_entries(input);
    Session session = Session::create(project, std::move(options));
    try {
        keep_recipes(project, input);
        keep_name(project, input);
        apply_recipe(session, loading, "", tell, progress);
    } catch (const std::exception&) {
        session.discard();
        throw;
    }
    return session;
}

void new_project(const fs::path& project, const InputOptions& options, const std::string& author,
                 const Teller& tell, const Progress& progress) {
    const Input input = resolve_input(options, progress.part(0.0, 0.3));
    Session session = start_project(project, input, {.author = author, .find = find_operation},
                                    tell, progress.part(0.3, 1.0));
    fold_log(session);
    const Scene scene = session.scene("");
    if (takes_unchosen_labels({}, scene))
        tell("labels, of which extract-surface labels=N takes some:" +
             label_list(scene.segmentation.segments, label_sizes(label_image(scene))));
}

}  // namespace vesselbench
