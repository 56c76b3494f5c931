#include "workbench/prepare/prepare.h"

#include <algorithm>
#include <functional>
#include <iostream>
#include <utility>

#include <nlohmann/json.hpp>

#include "geometry/kernel/catalogue.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/pending_files.h"
#include "geometry/kernel/printable.h"
#include "workbench/case/diagnostic_json.h"
#include "workbench/case/diagnostic_words.h"
#include "workbench/case/json_text.h"
#include "workbench/case/purposes.h"
#include "workbench/colours/shown_measure.h"
#include "workbench/commands/commands.h"
#include "workbench/commands/console/messages.h"
#include "workbench/commands/flow_commands.h"
#include "workbench/export/products.h"
#include "workbench/flow/results_json.h"
#include "workbench/operations/table.h"
#include "workbench/prepare/acceptance_gate.h"
#include "workbench/prepare/case_files.h"
#include "workbench/prepare/end_settings.h"
#include "workbench/prepare/marked_sac.h"
#include "workbench/prepare/prepared_purposes.h"
#include "workbench/prepare/vessel_question.h"
#include "workbench/report/log_json.h"
#include "workbench/review/acceptance.h"
#include "workbench/review/provenance.h"
#include "workbench/review/record_gate.h"
#include "workbench/review/review.h"
#include "workbench/session/export_record.h"
#include "workbench/session/source_counterpart.h"
#include "workbench/session/stored_texts.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

/// The fraction of the progress of `prepare --run` for the model; the rest is for the flow.
constexpr double kPreparing = 0.3;

Json prepared_json(const PrepareArguments& arguments, const PrepareSummary& made) {
    std::vector<std::string> warnings, notes;
    for (const Diagnostic& warning : made.warnings)
        (is_note(warning) ? notes : warnings).push_back(worded_with_operation(warning));
    return {{"purpose", arguments.purpose},
            {"folder", arguments.out},
            {"project", kProjectFile},
            {"reports", {"report.json", "report.html"}},
            {"products", made.products},
            {"not_met", made.not_met},
            {"print", made.print.empty() ? Json() : Json(made.print)},
            {"warnings", warnings},
            {"notes", notes},
            {"diagnostics", reported_json(made.warnings)}};
}

/// The paths, then what the model misses, and last the verdict on a print.
void print_prepared(const PrepareArguments& arguments, const Purpose& purpose,
                    const PrepareSummary& made) {
    const std::filesystem::path out = arguments.out;
    std::string what = purpose.result + ":";
    what.resize(std::string("report:      ").size(), ' ');
    std::cout << what << (out / purpose.result_file).string()
              << "\nreport:      " << (out / "report.html").string()
              << "\nproject:     " << (out / kProjectFile).string() << "\n";
    for (const std::string& text : made.not_met) std::cout << "not met:     " << text << "\n";
    if (!made.print.empty()) std::cout << "print:       " << made.print << "\n";
}

/// The rest of `prepare --run`. \return the exit code
int solve_prepared(const PrepareArguments& arguments, Json document, const Progress& progress) {
    const FlowResults results = solved_flow({.folder = arguments.out}, progress);
    if (arguments.json) {
        document["results"] = results_json(results);
        std::cout << text_from_json(document, 2) << "\n";
    } else {
        std::cout << "\n";
        print_flow_table(results);
    }
    return results.converged ? 0 : 1;
}

/// \throw IoError if the file is one that the project was made from
void refuse_source(const Session& session, const std::string& file) {
    if (session.is_source(file))
        throw IoError("'" + std::filesystem::path(file).filename().string() +
                      "' is a source of this project: it is not replaced; give another name");
}

/// \throw UsageError unless the file's format takes what is asked for
void check_shown(const ExportArguments& arguments) {
    if (!arguments.colour.empty()) check_takes_colour(arguments.file);
    if (arguments.images != "off") check_takes_page(arguments.file, "--images");
    if (!arguments.title.empty()) check_takes_page(arguments.file, "--title");
    if (!arguments.text.empty()) check_takes_page(arguments.file, "--text");
    require_utf8(arguments.title, "--title");
    require_utf8(arguments.text, "--text");
}

/// What the file shows besides the scene.
ViewerContents shown_contents(const ExportArguments& arguments, const Session& session,
                              const std::string& variant, const Scene& scene,
                              const Progress& progress) {
    ViewerContents shown{.title = arguments.title.empty() ? shown_name(session) : arguments.title,
                         .text = arguments.text,
                         .purpose = model_title(variant),
                         .colour = {},
                         .slices = arguments.images == "slices"};
    if (!arguments.colour.empty()) shown.colour = shown_measure(scene, arguments.colour, progress);
    if (shown.slices && !scene.image)
        throw InvalidInput("--images slices: the project has no image");
    return shown;
}

/// \throw UsageError unless the name is UTF-8
InputOptions input_options(const InputArguments& arguments, const std::string& name) {
    require_utf8(name, "--name");
    return {arguments.input, arguments.mask,   arguments.units, arguments.neighbours, name,
            arguments.label, arguments.mask_is};
}

}  // namespace

std::vector<std::string> with_ends(std::vector<std::string> settings, const EndArguments& ends) {
    for (const auto& [what, texts] :
         {std::pair{"inlet", &ends.inlets}, {"open", &ends.open}, {"close", &ends.close}})
        for (std::string& setting : end_settings(what, *texts))
            settings.push_back(std::move(setting));
    if (!ends.vessel.empty()) settings.push_back("clip-opening.vessel=" + ends.vessel);
    if (ends.accept_doubts) settings.emplace_back("clip-opening.accept_doubts=true");
    return settings;
}

int prepare_case(const PrepareArguments& arguments, const Progress& progress,
                 const std::function<void(std::string)>& refused) {
    const Purpose& purpose = find_purpose(arguments.purpose);
    if (arguments.run && !purpose.simulates_flow)
        throw UsageError("--run solves a flow: it is not for --for " + purpose.name);
    const std::string project = (std::filesystem::path(arguments.out) / kProjectFile).string();
    const Teller tell(&remark, [&](const Diagnostic& warning) {
        const Audience reader{.project = project, .preparing = true};
        const std::string text = worded_with_operation(warning, reader);
        is_note(warning) ? remark("note: " + text) : warn(text);
    });
    const PrepareSummary made =
        prepare({.input = input_options(arguments.input, arguments.name),
                 .purpose = arguments.purpose,
                 .recipe = arguments.recipe,
                 .arguments = with_ends(arguments.settings, arguments.ends),
                 .refinements = arguments.refinements,
                 .out = arguments.out,
                 .resume = arguments.resume,
                 .author = arguments.author,
                 .question = arguments.question,
                 .refused = [&](const Json& json) { refused(text_from_json(json)); }},
                tell, progress.part(0.0, arguments.run ? kPreparing : 1.0));
    const Json document = prepared_json(arguments, made);
    if (!arguments.json)
        print_prepared(arguments, purpose, made);
    else if (!arguments.run)
        std::cout << text_from_json(document, 2) << "\n";
    return arguments.run ? solve_prepared(arguments, document, progress.part(kPreparing, 1.0)) : 0;
}

void make_project(const NewArguments& arguments, const Progress& progress) {
    new_project(arguments.project, input_options(arguments.input, arguments.name), arguments.author,
                remark, progress);
    if (!arguments.json) return void(std::cout << "made " << arguments.project << "\n");
    Json edits = Json::array();
    const Session session = Session::open(arguments.project, {.find = find_operation});
    for (const LogEntry& entry : session.log()) edits.push_back(log_json(entry));
    std::cout << text_from_json(Json({{"project", arguments.project}, {"edits", edits}}), 2)
              << "\n";
}

void export_project(const ExportArguments& arguments, const Progress& progress) {
    check_export_name(arguments.file);
    check_export_place(arguments.file);
    check_shown(arguments);
    const std::size_t reviewers =
        arguments.required.empty() ? 0 : required_reviewers(arguments.required, "--require");
    Session session = Session::open(arguments.project, {.find = find_operation});
    std::vector<std::string> settings = arguments.settings;
    FlowSettings flow(stored_text(arguments.project, StoredText::Flow));
    flow.take(settings);
    if (!settings.empty())
        throw UsageError("--set '" + settings.front() +
                         "': export accepts only openfoam.parameter=value");
    refuse_source(session, arguments.file);
    const std::string variant =
        variant_of(arguments.project, arguments.variant, *session.snapshot()->history);
    const Scene scene = session.scene(variant, progress.part(0.0, 0.6));
    const std::vector<LogEntry> log = session.log(variant);
    std::vector<EnteredVerdicts> verdicts =
        entered_verdicts(session.project(), arguments.signers, progress);
    if (!arguments.signers.empty()) {
        require_signed_bytes(session.project(), verdicts, progress);
        verdicts = signed_or_rejecting(std::move(verdicts));
    }
    const Review review = review_of(session.project(), log, verdicts);
    require_acceptance(session, arguments.project, variant, reviewers, review);
    for (const LogEntry& entry : log)
        if (entry.status == EditStatus::Stale)
            remark("warning: edit " + std::to_string(entry.edit.edit.id) + " " +
                   printable(entry.edit.operation) +
                   " no longer applies and is not in the model: " + entry.reason);
    const ExportOptions options{
        .flow = flow_in_vessel(flow.parameters(), log),
        .provenance = provenance(session, variant, review),
        .shown = shown_contents(arguments, session, variant, scene, progress.part(0.6, 0.7)),
        .ends = made_ends(session, variant, progress.silent()),
        .neck = recorded_neck(log)};
    PendingFiles files;
    export_scene(files, arguments.file, scene, options, progress.part(0.7, 1.0));
    progress.check_cancelled();
    files.commit();
    if (!record_export(session, arguments.file, variant))
        remark("warning: the export is not recorded: " + session.read_only_reason());
    if (!arguments.json) return void(std::cout << "wrote " << arguments.file << "\n");
    Json json = {{"file", arguments.file}, {"variant", variant}, {"review", review_words(review)}};
    if (scene.surface) json["triangles"] = scene.surface->triangle_count();
    if (scene.volume_mesh) json["tetrahedra"] = scene.volume_mesh->tetrahedra.size();
    if (scene.volume_mesh && !scene.volume_mesh->prisms.empty())
        json["prisms"] = scene.volume_mesh->prisms.size();
    std::cout << text_from_json(json, 2) << "\n";
}

}  // namespace vesselbench
