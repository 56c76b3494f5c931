#include <array>
#include <filesystem>
#include <iostream>

#include <nlohmann/json.hpp>

#include "geometry/formats/format.h"
#include "geometry/kernel/edges.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/pending_files.h"
#include "geometry/kernel/wording.h"
#include "gpu/png.h"
#include "smoothing/quality/sensitivity.h"
#include "workbench/case/json_text.h"
#include "workbench/commands/commands.h"
#include "workbench/commands/console/messages.h"
#include "workbench/report/quality_gallery.h"
#include "workbench/report/quality_svg.h"
#include "workbench/suggest/search_subject.h"
#include "workbench/suggest/suggestion_search.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

BarOrder order_from(const std::string& name) {
    if (name == "parameter") return BarOrder::Parameter;
    if (name == "measure") return BarOrder::Measure;
    throw UsageError("--sort: '" + name + "' is unknown: use parameter or measure");
}

bool is_gallery(const std::string& out) {
    return lower_suffix(out) == ".png";
}

void check(const QualityOptions& options) {
    if (options.out.empty() && !options.json)
        throw UsageError("give an output: --out graphs.svg, bars.svg or gallery.png, or --json");
    for (const std::string& out : options.out)
        if (lower_suffix(out) != ".svg" && !is_gallery(out))
            throw UsageError("--out: '" + out + "' ends neither in .svg nor in .png");
    static_cast<void>(order_from(options.sort));
}

bool wants_bars(const std::string& out) {
    return fs::path(out).stem().string().find("bar") != std::string::npos;
}

QualityTitle title_of(const SearchSubject& subject, double tau) {
    return {subject.name + (subject.state.empty() ? "" : ", " + subject.state) + ", " +
                counted(surface_of(subject.scene).vertex_count(), "vertex", "vertices"),
            change_text(subject), tau};
}

Json json_of(const SensitivityAnalysis& analysis) {
    Json json = {{"scale",
                  {{"strong", analysis.scale.strong},
                   {"curvature_abs_mm", analysis.scale.curvature_abs},
                   {"curvature_zero_mm", analysis.scale.curvature_zero},
                   {"error_mm", analysis.scale.error},
                   {"volume_mm3", analysis.scale.volume},
                   {"original_volume_mm3", analysis.scale.original_volume},
                   {"triangles", analysis.scale.triangles}}},
                 {"curves", Json::array()}};
    for (const QualityCurve& curve : analysis.curves) {
        Json one = {{"parameter", curve.name},
                    {"unit", curve.unit},
                    {"current", curve.current},
                    {"suggested", curve.suggested},
                    {"points", Json::array()}};
        for (const CurvePoint& point : curve.points)
            if (point.measures)
                one["points"].push_back({{"value", point.value},
                                         {"curvature", point.scaled.curvature},
                                         {"error", point.scaled.error},
                                         {"volume", point.scaled.volume},
                                         {"triangles", point.scaled.triangles},
                                         {"skewness", point.scaled.skewness},
                                         {"score", point.score}});
        json["curves"].push_back(std::move(one));
    }
    return json;
}

SensitivityAnalysis analysis_of(const SearchSubject& subject, double tau,
                                const Progress& progress) {
    const ChosenEngine chosen = engine_for(subject);
    const SearchSpace space = space_for(subject, chosen, true);
    ParameterSearch search =
        search_for(subject, chosen, space, {.form = usual_score(subject), .tau = tau});
    const ParameterSet now = given_set(subject, space, progress.part(0.0, 0.1));
    return sensitivity(search, now, CurveValues::All, progress.part(0.1, 1.0));
}

/// The target and the parameters, as lines that fit below a model.
std::vector<std::string> caption(double tau, const SearchSpace& space, const ParameterSet& set) {
    constexpr std::size_t kMostLetters = 34;
    std::vector<std::string> lines = {"tau " + formatted(tau, "%g")};
    if (does_nothing(space, set)) return {lines.front() + ": leave it as it is"};
    lines.emplace_back();
    for (std::size_t i = 0; i < set.size(); ++i) {
        const std::string word = space.parameters[i].name + " " + formatted(set[i], "%g");
        std::string& line = lines.back();
        if (line.empty())
            line = word;
        else if (line.size() + 2 + word.size() <= kMostLetters)
            line += ", " + word;
        else
            lines.push_back(word);
    }
    return lines;
}

/// The surface for drawing: in some files the triangles face inward.
Surface outward(const Surface& surface, double volume) {
    return volume >= 0.0 ? surface : flipped(surface);
}

std::string gallery_of(const SearchSubject& subject, const QualityOptions& options,
                       const Progress& progress) {
    SuggestionSearch search(subject, usual_score(subject), SearchWay::Automatic);
    std::vector<GalleryModel> models;
    for (const double tau : kPresetTaus) {
        const double done = static_cast<double>(models.size()) / kPresetTaus.size();
        const Suggestion found =
            search.suggest(tau, progress.part(done, done + 1.0 / kPresetTaus.size()));
        const QualityMeasures& original = search.original();
        auto lines = caption(tau, search.space(), found.values);
        lines.push_back("volume " +
                        formatted(volume_change_percent(original, found.measures), "%+.2f") +
                        " %, curvature " +
                        formatted(curvature_percent(original, found.measures), "%.0f") + " %");
        lines.push_back("mean distance " + formatted(found.measures.error, "%.2g") + " mm");
        if (found.measures.triangles > 0.0)
            lines.push_back(formatted(found.measures.triangles, "%.0f") + " triangles");
        models.push_back(
            {outward(search.changed(found.values, progress), original.volume), std::move(lines)});
    }
    std::optional<Vec3> at;
    if (!options.at.empty()) at = Vec3(options.at[0], options.at[1], options.at[2]);
    return png(quality_gallery(outward(surface_of(subject.scene), search.original().volume), models,
                               subject.name + ", " + change_text(subject) +
                                   ": suggestions for low, medium and high targets",
                               at));
}

}  // namespace

void draw_quality(const QualityOptions& options, const Progress& progress) {
    check(options);
    const SearchSubject subject = search_subject(with_prepared_variant(options.subject), progress);
    for (const std::string& note : subject.notes) remark(note);
    std::optional<SensitivityAnalysis> analysis;
    const auto figures = [&]() -> const SensitivityAnalysis& {
        if (!analysis) analysis = analysis_of(subject, options.tau, progress.part(0.1, 0.6));
        return *analysis;
    };
    PendingFiles files;
    for (const std::string& out : options.out) {
        const QualityTitle title = title_of(subject, options.tau);
        files.add_text(out, is_gallery(out) ? gallery_of(subject, options, progress.part(0.6, 0.9))
                            : wants_bars(out)
                                ? quality_bars_svg(figures(), title, order_from(options.sort))
                                : quality_graphs_svg(figures(), title));
    }
    const std::string json = options.json ? text_from_json(json_of(figures()), 2) + "\n" : "";
    files.commit();
    std::cout << json;
    if (options.json) return;
    for (const std::string& out : options.out) std::cout << "wrote " << out << "\n";
}

}  // namespace vesselbench
