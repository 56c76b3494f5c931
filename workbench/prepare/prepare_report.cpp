#include "workbench/prepare/prepare_report.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/kernel/catalogue.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/surface_distance.h"
#include "geometry/kernel/triangle_shape.h"
#include "geometry/vessel/ends/end_choice.h"
#include "geometry/vessel/openings/openings.h"
#include "workbench/case/argument_texts.h"
#include "workbench/case/diagnostic_json.h"
#include "workbench/case/diagnostic_words.h"
#include "workbench/case/json_text.h"
#include "workbench/case/measure_json.h"
#include "workbench/case/point_json.h"
#include "workbench/case/purposes.h"
#include "workbench/case/version.h"
#include "workbench/findings/find_findings.h"
#include "workbench/operations/shared/context_weights.h"
#include "workbench/operations/shared/opening_json.h"
#include "workbench/operations/table.h"
#include "workbench/prepare/marked_sac.h"
#include "workbench/prepare/model_figures.h"
#include "workbench/prepare/recipe_run.h"
#include "workbench/report/log_json.h"
#include "workbench/report/report_pictures.h"
#include "workbench/report/requirements.h"
#include "workbench/review/finding_items.h"
#include "workbench/review/review.h"
#include "workbench/session/source_counterpart.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

Json distances_json(const Positions& points, const Surface& reference) {
    if (points.empty()) return nullptr;
    std::vector<double> distances;
    double sum = 0.0;
    for (const SurfacePoint& found : distance_to(reference).closest_points(points)) {
        distances.push_back(found.distance);
        sum += found.distance;
    }
    std::ranges::sort(distances);
    const std::size_t count = distances.size();
    Json json = distance_json(sum / static_cast<double>(count), distances.back(),
                              distances[count - 1 - count / 20]);
    json["points"] = count;
    return json;
}

/// The role of the edit's operation in a recipe.
const RecipePart& part_of(const LogEntry& entry) {
    return find_operation(entry.edit.operation).recipe;
}

/// \param part role of the edit's operation
std::optional<EditId> last_edit(const std::vector<LogEntry>& edits, bool RecipePart::*part) {
    std::optional<EditId> last;
    for (const LogEntry& entry : edits)
        if (part_of(entry).*part) last = entry.edit.edit.id;
    return last;
}

/// An object; empty if the edit reported nothing.
Json report_of(const ResultRecord& result) {
    Json report = Json::parse(result.report, nullptr, false);
    return report.is_object() ? report : Json::object();
}

/// What the edit that made the volume mesh states of it; null if none did.
Json volume_mesh_json(const std::vector<LogEntry>& edits, const char* what) {
    Json stated;
    for (const LogEntry& entry : edits)
        if (part_of(entry).makes_volume_mesh && entry.result)
            stated = report_of(*entry.result).value(what, Json());
    return stated;
}

Json flow_json(const FlowSummary& summary, const CfdParameters& flow) {
    Json inlets = Json::array();
    for (const InletFlow& inlet : summary.inlets)
        inlets.push_back({{"name", inlet.name},
                          {"area_mm2", inlet.area},
                          {"diameter_mm", inlet.diameter},
                          {"flow_cm3_s", inlet.flow},
                          {"mean_velocity_m_s", inlet.mean_velocity},
                          {"reynolds", inlet.reynolds}});
    Json json = {{"density_kg_m3", flow.density},
                 {"viscosity_pa_s", viscosity_at_shear(flow)},
                 {"flow_cm3_s", flow.flow},
                 {"profile", flow.profile == InflowProfile::Plug ? "plug" : "parabolic"},
                 {"inlets", inlets},
                 {"outlets", summary.outlets}};
    if (flow.viscosity_model == ViscosityModel::Carreau) json["viscosity_model"] = "Carreau";
    for (const GivenOutflow& outlet : summary.outflows)
        json["outflows_cm3_s"][outlet.name] = outlet.flow;
    if (flow.waveform)
        json["waveform"] = {{"kind", flow.waveform->synthetic ? "synthetic" : "file"},
                            {"period_s", flow.waveform->period()},
                            {"periods", flow.periods},
                            {"steps_per_period", flow.steps}};
    if (flow.split) json["split"] = *flow.split == FlowSplit::Cubes ? "cubes" : "area";
    return json;
}

Json openings_json(const Surface& surface, const std::vector<PatchMeasures>& patches) {
    Json openings = Json::array();
    for (const PatchMeasures& patch : patches)
        if (patch.kind != PatchKind::Wall)
            openings.push_back(opening_json(surface, patch, Keys::Plain));
    return openings;
}

/// By inlet, turn of the vessel just inside it [deg], where it can be measured.
std::map<std::string, double> inlet_bends(const Json& openings) {
    std::map<std::string, double> bends;
    for (const Json& opening : openings)
        if (opening["kind"] == "inlet" && opening["bend_deg"].is_number())
            bends[opening["name"]] = opening["bend_deg"];
    return bends;
}

void add_quality(Json& report, const Scene& source, const Surface& surface) {
    report["quality"]["before"] = source.surface ? measure_json(measure(*source.surface)) : Json();
    const SurfaceMeasures after = measure(surface);
    report["quality"]["after"] = measure_json(after);
    // Caps are judged apart from the wall.
    report["quality"]["wall"] = triangle_shape_json(wall_shape(surface));
    report["openings"] = openings_json(surface, after.patches);
}

/// How near the model comes to each neighbour, and where.
Json neighbours_json(const Scene& scene) {
    Json json;
    const Positions& points = scene.surface->points();
    for (const auto& [name, neighbour] : scene.neighbours) {
        const std::vector<double> distances = distances_from_neighbour(neighbour, points);
        const auto nearest = std::ranges::min_element(distances);
        const Vec3& place = points[static_cast<std::size_t>(nearest - distances.begin())];
        json[name] = {{"distance_mm", *nearest}, {"place_mm", point_json(rounded_place(place))}};
    }
    return json;
}

/// \return warnings
std::vector<Diagnostic> add_flow(Json& report, const PreparedCase& prepared,
                                 const std::vector<LogEntry>& edits) {
    report["volume_mesh"] = volume_mesh_json(edits, "quality");
    if (Json layers = volume_mesh_json(edits, "layers"); !layers.is_null())
        report["wall_layers"] = std::move(layers);
    const FlowSummary summary =
        flow_summary(*prepared.scene.surface, prepared.flow, inlet_bends(report["openings"]));
    report["flow"] = flow_json(summary, prepared.flow);
    return summary.warnings;
}

/// A later edit's section replaces an earlier one of the same key.
void add_section(PreparedReport& report, const ReportSection& section, const ResultRecord& result) {
    if (std::ranges::find(report.sections, section.key, &ReportSection::key) ==
        report.sections.end())
        report.sections.push_back(section);
    report.document[section.key] = report_of(result);
}

/// The last edit that opened all ends says what became of each.
void add_ends(Json& document, const ResultRecord& result) {
    const Json report = Json::parse(result.report, nullptr, false);
    if (!report.is_object() || !report.contains("ends")) return;
    if (!document.contains("ends") || report["ends"].size() > 1) document["ends"] = report["ends"];
}

/// Of the list that add_ends() made.
std::vector<ClosedEnd> closed_ends(const Json& document) {
    std::vector<ClosedEnd> closed;
    if (!document.contains("ends")) return closed;
    for (const Json& end : document["ends"]) {
        const auto place = end["place_mm"].get<std::array<double, 3>>();
        if (end["fate"] == to_string(EndFate::Closed))
            closed.push_back({{place[0], place[1], place[2]}, end["diameter_mm"]});
    }
    return closed;
}

/// An end's number; 0: it has none, or is of an earlier version.
int number_of(const Json& end) {
    const Json number = end.value("number", Json());
    return number.is_number() ? number.get<int>() : 0;
}

/// The number of the end that became an opening; 0: it has none.
int number_of(const Json& ends, const Json& opening) {
    const auto end = std::ranges::find_if(
        ends, [&](const Json& one) { return one.value("opening", Json()) == opening; });
    return end == ends.end() ? 0 : number_of(*end);
}

/// An end that stayed closed and would have a share of the flow.
bool is_notable(const Json& end) {
    const Json share = end.value("flow_share", Json());
    return end["fate"] == to_string(EndFate::Closed) && share.is_number() &&
           share.get<double>() > kLeastShare;
}

/// The openings of the model, and notable ends that stayed closed.
std::vector<EndMark> end_marks(const Json& document) {
    const auto place_in = [](const Json& json) {
        const auto [x, y, z] = json.get<std::array<double, 3>>();
        return Vec3(x, y, z);
    };
    const Json ends = document.value("ends", Json::array());
    std::vector<EndMark> marks;
    for (const Json& opening : document["openings"])
        marks.push_back({place_in(opening["centroid"]), number_of(ends, opening["name"]),
                         opening["kind"] == "inlet" ? ShownRole::Inlet : ShownRole::Outlet});
    for (const Json& end : ends)
        if (is_notable(end))
            marks.push_back({place_in(end["place_mm"]), number_of(end), ShownRole::Closed});
    return marks;
}

/// Without OpenGL, a warning says why there are none.
void add_pictures(PreparedReport& report, const Surface& surface,
                  const std::optional<PictureSource>& source) {
    try {
        report.pictures = report_pictures(surface, source, end_marks(report.document));
    } catch (const GpuUnavailable& error) {
        report.warnings.push_back({.code = "no-pictures", .words = {{"reason", error.what()}}});
    }
}

/// The name of a file that was read, unless the input has another one.
std::string shown_file(const Input& input, const std::string& name) {
    return input.is_renamed && !name.empty() ? input.name : name;
}

Json step_json(const LogEntry& entry, const Input& input) {
    Json step = log_json(entry);
    for (const Parameter& parameter : find_operation(entry.edit.operation).parameters)
        for (const char* part : {"given", "resolved", "report"}) {
            if (parameter.type != ParameterType::File || !step.contains(part)) continue;
            const auto file = step[part].find(parameter.name);
            if (file != step[part].end() && file->is_string())
                *file = shown_file(input, file->get<std::string>());
        }
    return step;
}

void add_steps(PreparedReport& report, const std::vector<LogEntry>& edits, const Input& input) {
    report.document["steps"] = Json::array();
    for (const LogEntry& entry : edits) {
        report.document["steps"].push_back(step_json(entry, input));
        if (!entry.result) continue;
        for (Diagnostic& warning : warnings_of(entry))
            report.warnings.push_back(std::move(warning));
        if (part_of(entry).cuts_ends) add_ends(report.document, *entry.result);
        if (const auto& section = part_of(entry).report_section)
            add_section(report, *section, *entry.result);
    }
}

/// The section of an edit that marked a sac's neck has the figures of this model.
void add_sac(PreparedReport& report, const std::vector<LogEntry>& edits, const Surface& surface) {
    const auto marked = marked_neck(edits);
    if (!marked) return;
    std::string key;
    for (const LogEntry& entry : edits)
        if (entry.result && marked_neck(entry.edit.operation, entry.result->resolved))
            if (const auto& section = part_of(entry).report_section) key = section->key;
    const ModelSac sac = measured_sac(surface, *marked, Keys::WithUnits);
    report.document.erase(key);
    if (sac.figures) report.document[key] = sac.figures->table;
    // The edit may have warned of the same plane.
    if (sac.warning &&
        std::ranges::count(report.warnings, sac.warning->code, &Diagnostic::code) == 0)
        report.warnings.push_back(*sac.warning);
}

/// What looks wrong on the model and was not dismissed.
void add_findings(Json& report, const std::vector<Finding>& findings) {
    report["findings"] = Json::array();
    for (const Finding& finding : findings) report["findings"].push_back(finding_json(finding));
}

/// A model that nobody has reviewed has no such section.
void add_review(Json& report, const Review& review) {
    if (review.files == 0) return;
    report["review"] = {{"state", review_words(review)}};
    for (const ReviewedEdit& edit : review.edits)
        for (const GivenVerdict& given : edit.verdicts)
            report["review"]["edit " + std::to_string(edit.edit.id) + " " + edit.operation]
                  [given.reviewer] =
                      to_string(given.verdict) + (given.outdated ? ", outdated" : "");
}

}  // namespace

PreparedReport prepare_report(Session& session, const PreparedCase& prepared,
                              const Progress& progress) {
    const std::vector<LogEntry> edits = session.log(prepared.purpose);
    const Surface& surface = surface_of(prepared.scene);
    PreparedReport made{.warnings = prepared.warnings};
    Json& report = made.document;
    report = {{"program_version", version()},
              {"purpose", prepared.purpose},
              {"units", "mm"},
              {"units_text", find_purpose(prepared.purpose).simulates_flow
                                 ? "Lengths are in millimetres; openfoam/ is in metres."
                                 : "Lengths are in millimetres."},
              {"input",
               {{"name", prepared.input.name},
                {"kind", prepared.input.is_image ? "image" : "surface"},
                {"mask", shown_file(prepared.input, prepared.input.mask.filename().string())}}},
              {"warnings", Json::array()},
              {"notes", Json::array()}};
    add_steps(made, edits, prepared.input);
    add_sac(made, edits, surface);
    add_review(report, review_of(session, prepared.purpose));
    const auto source_edit = last_edit(edits, &RecipePart::makes_source);
    const Scene source = source_edit ? session.scene_after(*source_edit) : Scene{};
    progress.report(0.1, "measuring");
    add_quality(report, source, surface);
    const std::vector<MadeEnd> ends = made_ends(session, prepared.purpose);
    report["requirements"] = requirements_json(requirements_of(
        find_purpose(prepared.purpose), model_figures(source, prepared.scene, ends, edits)));
    const std::vector<std::uint8_t> comparable = comparable_vertices(surface, ends);
    const Positions compared = comparable_points(surface, comparable);
    if (source.surface) {
        report["distance_to_source"] = distances_json(compared, *source.surface);
        report["distance_to_source"]["source_mean_edge_mm"] = mean_edge_length(*source.surface);
        report["distance_from_source"] = distances_json(source.surface->points(), surface);
    }
    if (prepared.input.exact)
        report["distance_to_exact"] = distances_json(compared, *prepared.input.exact);
    if (!prepared.scene.neighbours.empty()) report["neighbours"] = neighbours_json(prepared.scene);
    if (find_purpose(prepared.purpose).simulates_flow)
        for (const Diagnostic& warning : add_flow(report, prepared, edits))
            made.warnings.push_back(warning);
    add_findings(report, open_findings(session, edits, progress.part(0.4, 0.5)));
    progress.report(0.5, "drawing");
    std::optional<PictureSource> compared_with;
    if (source.surface)
        compared_with.emplace(
            PictureSource{*source.surface, comparable, closed_ends(made.document)});
    add_pictures(made, surface, compared_with);
    for (const Diagnostic& warning : made.warnings)
        report[is_note(warning) ? "notes" : "warnings"].push_back(worded_with_operation(warning));
    report["diagnostics"] = reported_json(made.warnings);
    report["products"] = prepared.products;
    report["earlier_results"] = prepared.earlier_results;
    report = printable_json(std::move(report));
    return made;
}

}  // namespace vesselbench
