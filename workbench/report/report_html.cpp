#include "workbench/report/report_html.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "geometry/kernel/wording.h"
#include "workbench/case/listed_finding.h"
#include "workbench/case/purposes.h"
#include "workbench/report/base64.h"
#include "workbench/report/first_screen.h"
#include "workbench/report/rendered_template.h"
#include "workbench/report/report_template.h"
#include "workbench/report/report_texts.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

Json tiles(const Json& report) {
    const Json& after = member_of(member_of(report, "quality"), "after");
    Json tiles = Json::array();
    const auto add = [&](const char* name, const std::string& value) {
        tiles.push_back({{"name", name}, {"value", value}});
    };
    add("triangles", shown_text(member_of(after, "triangles")));
    add("volume [mm\u00B3]", shown_text(member_of(after, "volume")));
    add("openings", std::to_string(member_of(report, "openings").size()));
    if (report.contains("volume_mesh"))
        add(report["volume_mesh"].contains("prisms") ? "cells" : "tetrahedra",
            shown_text(member_of(report["volume_mesh"], "cells")));
    const Json& inlets = member_of(member_of(report, "flow"), "inlets");
    if (!inlets.empty()) add("Reynolds number", shown_text(member_of(inlets[0], "reynolds")));
    add("warnings", std::to_string(member_of(report, "warnings").size()));
    return tiles;
}

Json gallery(std::span<const ReportPicture> pictures) {
    Json list = Json::array();
    for (const ReportPicture& picture : pictures)
        list.push_back({{"title", picture.title}, {"png", base64(picture.png)}});
    return list;
}

std::string seconds_text(const Json& value) {
    return value.is_number() ? formatted(value.get<double>(), "%.1f") : shown_text(value);
}

std::string volume_text(const Json& change) {
    const Json &before = member_of(change, "volume_before_mm3"),
               &after = member_of(change, "volume_after_mm3");
    if (before.is_number() && after.is_number() && before.get<double>() > 0)
        return figure_text(100.0 * (after.get<double>() / before.get<double>() - 1.0)) + " %";
    const Json& reason = member_of(change, "no_volume_change");
    return reason.is_string() ? "- (" + shown_text(reason) + ")" : "-";
}

/// Records, such as the planes of cuts, are left to report.json.
std::string argument_shown(const Json& value) {
    const bool records = value.is_array() && !value.empty() && value.front().is_object();
    return records ? counted(value.size(), "record") : shown_text(value);
}

Json step_texts(const Json& step) {
    const Json& change = member_of(step, "change");
    std::vector<std::string> arguments;
    for (const auto& [name, value] : member_of(step, "resolved").items())
        arguments.push_back(name + "=" + argument_shown(value));
    Json texts = shown_texts(step, {"edit", "step", "operation"});
    texts.update(
        shown_texts(change, {"triangles_after", "mean_deviation_mm", "largest_deviation_mm"}));
    texts.update({{"arguments", joined(arguments)},
                  {"seconds", seconds_text(member_of(step, "duration_s"))},
                  {"volume", volume_text(change)}});
    return texts;
}

Json quality(const Json& report) {
    const Json& both = member_of(report, "quality");
    static const std::vector<std::pair<const char*, const char*>> names = {
        {"triangles", "triangles"},
        {"components", "components"},
        {"boundary_loops", "open rims"},
        {"closed", "closed"},
        {"manifold", "manifold"},
        {"self_intersections", "self-intersections"},
        {"genus", "genus"},
        {"area", "area [mm\u00B2]"},
        {"volume", "volume [mm\u00B3]"},
        {"edge_length", "edge length [mm]"},
        {"equiangle_skewness", "equiangle skewness [-], 0 is best"},
        {"radius_ratio", "radius ratio [-], 1 is best"},
        {"normal_curvature_deg", "mean normal curvature [deg]"},
        {"mean_curvature", "integral of the mean curvature [mm]"}};
    Json rows = Json::array();
    for (const auto& [key, name] : names)
        rows.push_back({{"name", name},
                        {"before", shown_text(member_of(member_of(both, "before"), key))},
                        {"after", shown_text(member_of(member_of(both, "after"), key))}});
    const Json& wall = member_of(both, "wall");
    if (wall.is_object())
        rows.push_back({{"name", "wall only: skewness, radius ratio"},
                        {"before", ""},
                        {"after", shown_text(wall)}});
    return rows;
}

bool is_for_flow(const Json& report) {
    const auto purpose = std::ranges::find(purposes(), report.value("purpose", ""), &Purpose::name);
    return purpose != purposes().end() && purpose->simulates_flow;
}

Json openings(const Json& report) {
    Json list = Json::array();
    for (const Json& patch : member_of(report, "openings")) {
        Json texts = shown_texts(
            patch, {"name", "kind", "diameter", "area", "normal", "flatness", "tilt_deg"});
        texts["end"] = end_number(report, member_of(patch, "name"));
        texts["centroid"] = place_argument(member_of(patch, "centroid"));
        list.push_back(std::move(texts));
    }
    return list;
}

/// Name and diameter in the model: "outlet_1, 3.2 mm"; empty for an end without an opening.
std::string opening_text(const Json& report, const Json& name) {
    if (name.is_null()) return "";
    for (const Json& patch : member_of(report, "openings"))
        if (member_of(patch, "name") == name && member_of(patch, "diameter").is_number())
            return shown_text(name) + ", " + shown_text(patch["diameter"]) + " mm";
    return shown_text(name);
}

/// What became of every vessel end, worst first.
Json ends(const Json& report) {
    Json list = Json::array();
    for (const Json& end : member_of(report, "ends")) {
        Json texts = shown_texts(end, {"number", "diameter_mm", "fate", "why"});
        texts["place"] = place_argument(member_of(end, "place_mm"));
        texts["opening"] = opening_text(report, member_of(end, "opening"));
        list.push_back(std::move(texts));
    }
    return list;
}

/// "brush-smooth at=1,2,3 radius=2"
std::string treatment_text(const Json& operation) {
    if (!operation.is_object()) return "-";
    std::string text = shown_text(member_of(operation, "name"));
    for (const auto& [name, value] : member_of(operation, "arguments").items())
        text += " " + name + "=" + shown_text(value);
    return text;
}

/// What a finding may be, a line each; none: it is no question.
Json readings(const Json& finding) {
    Json lines = Json::array();
    for (const Json& reading : member_of(finding, "readings"))
        lines.push_back(shown_text(member_of(reading, "text")));
    return lines;
}

/// "96 % that a branch ends blind and short"
std::string certainty_text(const Json& finding) {
    const Json& certainty = member_of(finding, "certainty");
    if (!certainty.is_number()) return shown_text(certainty);
    const std::string share = formatted(100.0 * certainty.get<double>(), "%.0f %%");
    const Json& of = member_of(finding, "certain_of");
    return of.is_string() ? share + " that " + shown_text(of) : share;
}

/// What looks wrong on the model, the worst first. \param listed those that are, or the
/// others
Json findings(const Json& report, bool listed) {
    Json list = Json::array();
    for (const Json& finding : member_of(report, "findings"))
        if (is_listed_finding(finding) == listed)
            list.push_back({{"title", shown_text(member_of(finding, "title"))},
                            {"id", shown_text(member_of(finding, "id"))},
                            {"text", shown_text(member_of(finding, "text"))},
                            {"readings", readings(finding)},
                            {"certainty", certainty_text(finding)},
                            {"treatment", readings(finding).empty()
                                              ? treatment_text(member_of(finding, "operation"))
                                              : "a question"}});
    return list;
}

/// The sheet of thesis Table 2.1.
Json requirements(const Json& report) {
    Json list = Json::array();
    for (const Json& row : member_of(report, "requirements")) {
        Json texts = shown_texts(
            row, {"requirement", "relevance", "figures", "limit", "reason", "judgement"});
        texts["class"] = judgement_class(member_of(row, "judgement"));
        list.push_back(std::move(texts));
    }
    return list;
}

/// Those of every report, beside the ones that operations declare.
const std::vector<ReportSection>& usual_sections() {
    static const std::vector<ReportSection> sections = {
        {.key = "review",
         .title = "Review",
         .about = "What reviewers said of the edits, as entered into the project when this report "
                  "was made."},
        {.key = "distance_to_source",
         .title = "Distance to the source surface",
         .about = "From the wall to the loaded or extracted surface, away from its "
                  "ends."},
        {.key = "distance_from_source",
         .title = "Distance from the source surface",
         .about =
             "From every vertex of the loaded or extracted surface to the model: ends that were "
             "cut off and parts that were lost are included."},
        {.key = "distance_to_exact",
         .title = "Distance to the exact surface",
         .about = "From the wall to the phantom's true surface, away from the ends."},
        {.key = "neighbours",
         .title = "Neighbours",
         .about = "Where the model comes nearest to each; 0: it touches or enters it."},
        {.key = "volume_mesh",
         .title = "Volume mesh",
         .about =
             "Non-orthogonality, skewness and aspect ratio as defined by OpenFOAM's checkMesh."},
        {.key = "wall_layers",
         .title = "Wall layers",
         .about = "Layers of prisms along the wall, together as thick as wished but where walls "
                  "are close or curved: limited is below 98 % of that, by the wall's area."},
        {.key = "flow",
         .title = "Flow",
         .about = "Flow in this model, derived from the flow parameters."}};
    return sections;
}

/// The parts of the report that are there, each as a table of names and values.
Json sections_of(const Json& report, std::span<const ReportSection> declared) {
    Json list = Json::array();
    for (const auto& sections : {std::span<const ReportSection>(usual_sections()), declared})
        for (const ReportSection& section : sections) {
            const Json& part = member_of(report, section.key);
            if (!part.is_object()) continue;
            Json rows = Json::array();
            for (const auto& [name, value] : part.items())
                rows.push_back({{"name", key_text(name)}, {"value", shown_text(value)}});
            list.push_back({{"title", section.title}, {"about", section.about}, {"rows", rows}});
        }
    return list;
}

/// Of a report from another version too, whose purpose may be unknown.
std::string title_of(const std::string& name) {
    const auto found = std::ranges::find(purposes(), name, &Purpose::name);
    return found != purposes().end() ? found->title : "Model";
}

}  // namespace

std::string report_html(const Json& report, std::span<const ReportPicture> pictures,
                        std::span<const ReportSection> sections) {
    Json steps = Json::array();
    for (const Json& step : member_of(report, "steps")) steps.push_back(step_texts(step));
    const std::size_t shown_first = std::min<std::size_t>(1, pictures.size());
    Json page = {
        {"input", shown_text(member_of(member_of(report, "input"), "name"))},
        {"title", title_of(report.value("purpose", ""))},
        {"version", shown_text(member_of(report, "program_version"))},
        {"units", shown_text(member_of(report, "units_text"))},
        {"review", report.contains("review") ? shown_text(member_of(report["review"], "state"))
                                             : "not reviewed"},
        {"for_flow", is_for_flow(report)},
        {"tiles", tiles(report)},
        {"first", first_screen(report, sections)},
        {"first_picture", gallery(pictures.first(shown_first))},
        {"warnings", shown_texts(member_of(report, "warnings"))},
        {"notes", shown_texts(member_of(report, "notes"))},
        {"pictures", gallery(pictures.subspan(shown_first))},
        {"steps", steps},
        {"quality", quality(report)},
        {"requirements", requirements(report)},
        {"openings", openings(report)},
        {"ends", ends(report)},
        {"findings", findings(report, true)},
        {"folded", findings(report, false)},
        {"sections", sections_of(report, sections)},
        {"products", shown_texts(member_of(report, "products"))}};
    for (const char* list : {"warnings", "notes", "findings", "pictures", "requirements", "ends"})
        page[std::string("any_") + list] = !page[list].empty();
    page["any_folded"] = !page["folded"].empty();
    page["any_found"] = page["any_findings"].get<bool>() || page["any_folded"].get<bool>();
    page["any_looks"] = page["any_warnings"].get<bool>() || page["any_found"].get<bool>();
    page["folded_count"] = std::to_string(page["folded"].size());
    page["listed_text"] = counted(page["findings"].size(), "finding");
    return rendered_template(report_templates().at("report.html"), page);
}

}  // namespace vesselbench
