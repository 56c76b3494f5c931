#include <algorithm>
#include <chrono>
#include <iostream>

#include <nlohmann/json.hpp>

#include "geometry/kernel/amounts.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/surface_distance.h"
#include "geometry/kernel/wording.h"
#include "workbench/case/argument_texts.h"
#include "workbench/case/arguments.h"
#include "workbench/case/json_text.h"
#include "workbench/case/operation.h"
#include "workbench/commands/commands.h"
#include "workbench/commands/console/console.h"
#include "workbench/commands/console/messages.h"
#include "workbench/operations/shared/foreign_surface.h"
#include "workbench/prepare/prepared_purposes.h"
#include "workbench/project/project.h"
#include "workbench/suggest/processing_subject.h"
#include "workbench/suggest/search_subject.h"
#include "workbench/suggest/suggestion_search.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

/// The arguments found by the search, without the fixed ones.
Json found_json(const SearchSpace& space, const ParameterSet& set) {
    Json json;
    for (std::size_t i = 0; i < set.size(); ++i)
        if (space.parameters[i].unit.empty())
            json[space.parameters[i].name] = static_cast<int>(set[i]);
        else
            json[space.parameters[i].name] = set[i];
    return json;
}

Json measures_json(const QualityMeasures& original, const QualityMeasures& measures) {
    Json json = {{"error_mm", measures.error},
                 {"error_thesis_mm", measures.error_thesis},
                 {"curvature_mm", measures.curvature},
                 {"curvature_abs_mm", measures.curvature_abs},
                 {"volume_mm3", measures.volume},
                 {"volume_change_percent", volume_change_percent(original, measures)}};
    if (measures.triangles > 0.0) {
        json["triangles"] = static_cast<std::size_t>(measures.triangles);
        json["equiangle_skewness"] = measures.skewness;
    }
    return json;
}

Json suggestion_json(SuggestionSearch& search, double tau, const Suggestion& suggestion) {
    Json json = {{"tau", tau},
                 {"leave_as_is", does_nothing(search.space(), suggestion.values)},
                 {"parameters", found_json(search.space(), suggestion.values)},
                 {"score", suggestion.score},
                 {"terms",
                  {{target_name(search.form()), suggestion.terms.target},
                   {"error", suggestion.terms.error},
                   {"volume", suggestion.terms.volume}}}};
    json.update(measures_json(search.original(), suggestion.measures));
    return json;
}

/// Mean distance of a changed surface's vertices from the true surface [mm].
double distance_from(const SurfaceDistance& truth, const Surface& surface) {
    double sum = 0.0;
    for (const SurfacePoint& closest : truth.closest_points(surface.points()))
        sum += closest.distance;
    return sum / static_cast<double>(std::max<std::size_t>(1, surface.vertex_count()));
}

Json grid_json(SuggestionSearch& search, const SuggestOptions& options, const Progress& progress) {
    std::optional<SurfaceDistance> truth;
    if (!options.truth.empty())
        truth = distance_to(read_foreign_surface(options.truth, options.subject.units));
    Json list = Json::array();
    for (const ParameterSet& set : search.coarse_sets()) {
        const auto measures = search.measures(set, progress);
        if (!measures) continue;
        Json one = {{"parameters", found_json(search.space(), set)}};
        one.update(measures_json(search.original(), *measures));
        if (truth) one["truth_mm"] = distance_from(*truth, search.changed(set, progress));
        list.push_back(std::move(one));
    }
    return list;
}

std::string set_text(const SearchSpace& space, const ParameterSet& set) {
    std::string text;
    for (std::size_t i = 0; i < set.size(); ++i)
        text += (i == 0 ? "" : " ") + space.parameters[i].name + "=" + formatted(set[i], "%g");
    return text;
}

/// "lambda 0 ... 1, iterations 0 ... 50"
std::string ranges_text(const SearchSpace& space) {
    std::string text;
    for (const SearchParameter& parameter : space.parameters) {
        std::vector<double> values = parameter.values;
        if (parameter.idle == 0.0 && parameter.unit == "mm") values.erase(values.begin());
        text += (text.empty() ? "" : ", ") + parameter.name + " " + formatted(values.front());
        if (values.size() > 1) text += " ... " + formatted(values.back());
    }
    return text;
}

void print_suggestions(SuggestionSearch& search, const SearchSubject& subject,
                       const std::vector<std::pair<double, Suggestion>>& found) {
    std::vector<std::vector<std::string>> rows = {
        {"tau", "suggestion", "curvature", "mean distance [mm]", "volume", "score"}};
    const bool counts = search.original().triangles > 0.0;
    if (counts) rows.front().emplace_back("triangles");
    for (const auto& [tau, one] : found) {
        const bool nothing = does_nothing(search.space(), one.values);
        rows.push_back(
            {formatted(tau, "%g"),
             nothing ? "do not " + subject.operation->name : set_text(search.space(), one.values),
             formatted(curvature_percent(search.original(), one.measures), "%.1f") + " %",
             formatted(one.measures.error),
             formatted(volume_change_percent(search.original(), one.measures), "%+.2f") + " %",
             formatted(one.score, "%.4f")});
        if (counts) rows.back().push_back(formatted(one.measures.triangles, "%.0f"));
    }
    std::cout << as_columns(rows);
    const Suggestion& first = found.front().second;
    if (does_nothing(search.space(), first.values)) return;
    const Arguments arguments = typed_arguments(subject, search.space(), first.values);
    std::string words = subject.is_project ? subject.name : "PROJECT";
    words += " " + subject.operation->name;
    for (const Parameter& parameter : subject.operation->parameters)
        if (const auto at = arguments.values().find(parameter.name); at != arguments.values().end())
            words += " " + parameter.name + "=" + to_text(at->second);
    if (!subject.variant.empty()) words += " --variant " + subject.variant;
    std::cout << "\nvesselbench apply " << words << "\n";
}

Json work_json(const MeasureSource::Work& work, double seconds) {
    return {{"evaluations", work.evaluations},
            {"runs", work.runs},
            {"sweeps", work.sweeps},
            {"seconds", seconds}};
}

/// The score given by the user, or the operation's usual one.
ScoreForm form_for(const SuggestOptions& options, const SearchSubject& subject) {
    if (options.score.empty()) return usual_score(subject);
    const ScoreForm form = score_form_from(options.score);
    if (form == ScoreForm::Compact && subject.smoothing)
        throw UsageError("--score compact is for operations that change the number of triangles");
    if (form == ScoreForm::Thesis && !subject.smoothing)
        throw UsageError("--score thesis is for " + joined(searched_operations(searches_filter)) +
                         ": its error needs the same triangles");
    return form;
}

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void print_json(SuggestionSearch& search, const SearchSubject& subject,
                const SuggestOptions& options,
                const std::vector<std::pair<double, Suggestion>>& found, const Json& work,
                const Progress& progress) {
    Json json = {{"source", subject.name},
                 {"operation", subject.operation->name},
                 {"score_form", to_string(search.form())},
                 {"search", options.search},
                 {"device", search.chosen().on_gpu ? "gpu" : "cpu"},
                 {"vertices", surface_of(subject.scene).vertex_count()},
                 {"mean_edge_mm", search.mean_edge()},
                 {"original", measures_json(search.original(), search.original())}};
    if (const std::string& filter = subject.operation->search.filter_parameter; !filter.empty())
        json[filter] = subject.arguments.text(filter);
    json["suggestion"] = suggestion_json(search, found.front().first, found.front().second);
    const Arguments arguments = arguments_of(subject, search.space(), found.front().second.values);
    for (const auto& [name, value] : arguments.values())
        json["suggestion"]["arguments"][name] = to_json(value);
    for (std::size_t i = 1; i < found.size(); ++i)
        json["presets"].push_back(suggestion_json(search, found[i].first, found[i].second));
    json["work"] = work;
    if (options.grid) json["grid"] = grid_json(search, options, progress);
    std::cout << text_from_json(json, 2) << "\n";
}

}  // namespace

SubjectOptions with_prepared_variant(SubjectOptions options) {
    if (options.variant.empty() && is_project_file(options.source))
        options.variant = prepared_purposes(options.source).last;
    return options;
}

void suggest_parameters(const SuggestOptions& options, const Progress& progress) {
    if (options.grid && !options.json) throw UsageError("--grid needs --json");
    if (!options.truth.empty() && !(options.json && options.grid))
        throw UsageError("--truth needs --json --grid: it adds a distance to each set");
    const SearchSubject subject = search_subject(with_prepared_variant(options.subject), progress);
    const auto start = std::chrono::steady_clock::now();
    SuggestionSearch search(subject, form_for(options, subject), search_way_from(options.search),
                            options.grid);
    std::vector<std::pair<double, Suggestion>> found;
    found.emplace_back(options.tau, search.suggest(options.tau, progress.part(0.1, 0.6)));
    const Json work = work_json(search.work(), seconds_since(start));
    for (double done = 0.6; const double tau : kPresetTaus) {
        found.emplace_back(tau, search.suggest(tau, progress.part(done, done + 0.13)));
        done += 0.13;
    }
    for (const std::string& note : subject.notes) remark(note);
    if (subject.smoothing && subject.smoothing->device == DeviceChoice::Gpu &&
        !search.chosen().reason.empty())
        remark("device=gpu: fell back to the CPU, because " + search.chosen().reason);
    if (options.json) return print_json(search, subject, options, found, work, progress);
    std::cout << subject.name << (subject.state.empty() ? "" : ", " + subject.state) << ": "
              << counted(surface_of(subject.scene).vertex_count(), "vertex", "vertices")
              << ", mean edge " << formatted(search.mean_edge()) << " mm; " << change_text(subject)
              << ", score " << to_string(search.form()) << "\n\n";
    print_suggestions(search, subject, found);
    std::cout << "\ncurvature: integral of |H|, relative to the original's; mean distance: "
              << (subject.smoothing ? "of each vertex from the original around its start\n"
                                    : "both ways, to the original surface\n")
              << "searched: " << ranges_text(search.space()) << "; " << work["evaluations"]
              << " parameter sets, "
              << (subject.smoothing ? work["sweeps"].dump() + " iterations, " : "")
              << duration_text(work["seconds"].get<double>())
              << (search.chosen().on_gpu ? " on " + search.chosen().device_name : "") << "\n";
}

}  // namespace vesselbench
