#include "workbench/report/report_html.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "geometry/kernel/wording.h"
#include "workbench/case/argument_texts.h"
#include "workbench/case/listed_finding.h"
#include "workbench/case/purposes.h"
#include "workbench/report/base64.h"
#include "workbench/report/rendered_template.h"
#include "workbench/report/report_template.h"
#include "workbench/report/requirements.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

/// Below this, a number is a rounding error of lengths and angles.
constexpr double kNothing = 1e-9;

std::string number_text(double number) {
    const double size = std::abs(number);
    if (size < kNothing) return "0";
    const char* format = size == 0 || (size >= 0.001 && size < 1e6) ? "%.4g" : "%.3g";
    if (size >= 1000 && size < 1e9) format = "%.0f";
    return formatted(number, format);
}

/// A key of the document in words, its unit in brackets: "mean_velocity_m_s" is "mean velocity
/// [m/s]".
std::string words_of(std::string key) {
    static const std::vector<std::pair<std::string, std::string>> units = {
        {"_kg_m3", "kg/m\u00B3"}, {"_cm3_s", "cm\u00B3/s"}, {"_m_s", "m/s"}, {"_pa_s", "Pa s"},
        {"_mm3", "mm\u00B3"},     {"_mm2", "mm\u00B2"},     {"_mm", "mm"},   {"_deg", "deg"}};
    std::string unit;
    for (const auto& [ending, name] : units)
        if (unit.empty() && key.ends_with(ending)) {
            key.resize(key.size() - ending.size());
            unit = " [" + name + "]";
        }
    std::ranges::replace(key, '_', ' ');
    return key + unit;
}

/// Longer lists are left to report.json.
constexpr std::size_t kMostNumbers = 9;

bool is_long_list(const Json& value) {
    return value.is_array() && value.size() > kMostNumbers && value.front().is_number();
}

/// One value in readable form.
std::string shown(const Json& value) {
    if (value.is_null()) return "-";
    if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
    if (value.is_number_integer()) return std::to_string(value.get<std::int64_t>());
    if (value.is_number()) return number_text(value.get<double>());
    if (value.is_string()) return value.get<std::string>();
    if (is_long_list(value)) return std::to_string(value.size()) + " numbers";
    if (value.is_array()) {
        std::string text;
        for (const Json& part : value) text += (text.empty() ? "" : ", ") + shown(part);
        return text;
    }
    std::string text;
    for (const auto& [key, part] : value.items())
        text += (text.empty() ? "" : ", ") + words_of(key) + " " + shown(part);
    return text;
}

const Json& part_of(const Json& json, const std::string& key) {
    static const Json nothing;
    return json.is_object() && json.contains(key) ? json[key] : nothing;
}

/// The values of some keys in readable form; "-": there is none.
Json texts_of(const Json& json, std::initializer_list<const char*> keys) {
    Json texts = Json::object();
    for (const char* key : keys) texts[key] = shown(part_of(json, key));
    return texts;
}

/// Each element of a list in readable form.
Json texts_of(const Json& list) {
    Json texts = Json::array();
    for (const Json& part : list) texts.push_back(shown(part));
    return texts;
}

Json tiles(const Json& report) {
    const Json& after = part_of(part_of(report, "quality"), "after");
    Json tiles = Json::array();
    const auto add = [&](const char* name, const std::string& value) {
        tiles.push_back({{"name", name}, {"value", value}});
    };
    add("triangles", shown(part_of(after, "triangles")));
    add("volume [mm\u00B3]", shown(part_of(after, "volume")));
    add("openings", std::to_string(part_of(report, "openings").size()));
    if (report.contains("volume_mesh"))
        add(report["volume_mesh"].contains("prisms") ? "cells" : "tetrahedra",
            shown(part_of(report["volume_mesh"], "cells")));
    const Json& inlets = part_of(part_of(report, "flow"), "inlets");
    if (!inlets.empty()) add("Reynolds number", shown(part_of(inlets[0], "reynolds")));
    add("warnings", std::to_string(part_of(report, "warnings").size()));
    return tiles;
}

Json gallery(std::span<const ReportPicture> pictures) {
    Json list = Json::array();
    for (const ReportPicture& picture : pictures)
        list.push_back({{"title", picture.title}, {"png", base64(picture.png)}});
    return list;
}

std::string seconds_text(const Json& value) {
    return value.is_number() ? formatted(value.get<double>(), "%.1f") : shown(value);
}

std::string volume_text(const Json& change) {
    const Json &before = part_of(change, "volume_before_mm3"),
               &after = part_of(change, "volume_after_mm3");
    if (before.is_number() && after.is_number() && before.get<double>() > 0)
        return number_text(100.0 * (after.get<double>() / before.get<double>() - 1.0)) + " %";
    const Json& reason = part_of(change, "no_volume_change");
    return reason.is_string() ? "- (" + shown(reason) + ")" : "-";
}

/// Records, such as the planes of cuts, are left to report.json.
std::string argument_shown(const Json& value) {
    const bool records = value.is_array() && !value.empty() && value.front().is_object();
    return records ? counted(value.size(), "record") : shown(value);
}

Json step_texts(const Json& step) {
    const Json& change = part_of(step, "change");
    std::vector<std::string> arguments;
    for (const auto& [name, value] : part_of(step, "resolved").items())
        arguments.push_back(name + "=" + argument_shown(value));
    Json texts = texts_of(step, {"edit", "step", "operation"});
    texts.update(
        texts_of(change, {"triangles_after", "mean_deviation_mm", "largest_deviation_mm"}));
    texts.update({{"arguments", joined(arguments)},
                  {"seconds", seconds_text(part_of(step, "duration_s"))},
                  {"volume", volume_text(change)}});
    return texts;
}

Json quality(const Json& report) {
    const Json& both = part_of(report, "quality");
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
                        {"before", shown(part_of(part_of(both, "before"), key))},
                        {"after", shown(part_of(part_of(both, "after"), key))}});
    const Json& wall = part_of(both, "wall");
    if (wall.is_object())
        rows.push_back({{"name", "wall only: skewness, radius ratio"},
                        {"before", ""},
                        {"after", shown(wall)}});
    return rows;
}

bool is_for_flow(const Json& report) {
    const auto purpose = std::ranges::find(purposes(), report.value("purpose", ""), &Purpose::name);
    return purpose != purposes().end() && purpose->simulates_flow;
}

Json openings(const Json& report) {
    Json list = Json::array();
    for (const Json& patch : part_of(report, "openings"))
        list.push_back(texts_of(patch, {"name", "kind", "diameter", "area", "centroid", "normal",
                                        "flatness", "tilt_deg"}));
    return list;
}

/// As an argument, to be copied.
std::string place_text(const Json& place) {
    if (!place.is_array() || place.size() != 3) return shown(place);
    const Vec3 point(place[0].get<double>(), place[1].get<double>(), place[2].get<double>());
    return to_text(Value(rounded_place(point)));
}

/// Name and diameter in the model: "outlet_1, 3.2 mm"; empty for an end without an opening.
std::string opening_text(const Json& report, const Json& name) {
    if (name.is_null()) return "";
    for (const Json& patch : part_of(report, "openings"))
        if (part_of(patch, "name") == name && part_of(patch, "diameter").is_number())
            return shown(name) + ", " + shown(patch["diameter"]) + " mm";
    return shown(name);
}

/// What became of every vessel end, worst first.
Json ends(const Json& report) {
    Json list = Json::array();
    for (const Json& end : part_of(report, "ends")) {
        Json texts = texts_of(end, {"diameter_mm", "fate", "why"});
        texts["place"] = place_text(part_of(end, "place_mm"));
        texts["opening"] = opening_text(report, part_of(end, "opening"));
        list.push_back(std::move(texts));
    }
    return list;
}

/// "brush-smooth at=1,2,3 radius=2"
std::string treatment_text(const Json& operation) {
    if (!operation.is_object()) return "-";
    std::string text = shown(part_of(operation, "name"));
    for (const auto& [name, value] : part_of(operation, "arguments").items())
        text += " " + name + "=" + shown(value);
    return text;
}

/// What a finding may be, a line each; none: it is no question.
Json readings(const Json& finding) {
    Json lines = Json::array();
    for (const Json& reading : part_of(finding, "readings"))
        lines.push_back(shown(part_of(reading, "text")));
    return lines;
}

/// "96 % that a branch ends blind and short"
std::string certainty_text(const Json& finding) {
    const Json& certainty = part_of(finding, "certainty");
    if (!certainty.is_number()) return shown(certainty);
    const std::string share = formatted(100.0 * certainty.get<double>(), "%.0f %%");
    const Json& of = part_of(finding, "certain_of");
    return of.is_string() ? share + " that " + shown(of) : share;
}

/// What looks wrong on the model, the worst first. \param listed those that are, or the
/// others
Json findings(const Json& report, bool listed) {
    Json list = Json::array();
    for (const Json& finding : part_of(report, "findings"))
        if (is_listed_finding(finding) == listed)
            list.push_back({{"title", shown(part_of(finding, "title"))},
                            {"id", shown(part_of(finding, "id"))},
                            {"text", shown(part_of(finding, "text"))},
                            {"readings", readings(finding)},
                            {"certainty", certainty_text(finding)},
                            {"treatment", readings(finding).empty()
                                              ? treatment_text(part_of(finding, "operation"))
                                              : "a question"}});
    return list;
}

/// The sheet of thesis Table 2.1.
Json requirements(const Json& report) {
    Json list = Json::array();
    for (const Json& row : part_of(report, "requirements")) {
        Json texts =
            texts_of(row, {"requirement", "relevance", "figures", "limit", "reason", "judgement"});
        const Json& judgement = part_of(row, "judgement");
        texts["class"] = judgement == to_string(Judgement::Met)      ? "good"
                         : judgement == to_string(Judgement::NotMet) ? "bad"
                                                                     : "";
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
            const Json& part = part_of(report, section.key);
            if (!part.is_object()) continue;
            Json rows = Json::array();
            for (const auto& [name, value] : part.items())
                rows.push_back({{"name", words_of(name)}, {"value", shown(value)}});
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
    for (const Json& step : part_of(report, "steps")) steps.push_back(step_texts(step));
    Json page = {{"input", shown(part_of(part_of(report, "input"), "name"))},
                 {"title", title_of(report.value("purpose", ""))},
                 {"version", shown(part_of(report, "program_version"))},
                 {"units", shown(part_of(report, "units_text"))},
                 {"for_flow", is_for_flow(report)},
                 {"tiles", tiles(report)},
                 {"warnings", texts_of(part_of(report, "warnings"))},
                 {"pictures", gallery(pictures)},
                 {"steps", steps},
                 {"quality", quality(report)},
                 {"requirements", requirements(report)},
                 {"openings", openings(report)},
                 {"ends", ends(report)},
                 {"findings", findings(report, true)},
                 {"folded", findings(report, false)},
                 {"sections", sections_of(report, sections)},
                 {"products", texts_of(part_of(report, "products"))}};
    for (const char* list : {"warnings", "findings", "pictures", "requirements", "ends"})
        page[std::string("any_") + list] = !page[list].empty();
    page["any_folded"] = !page["folded"].empty();
    page["any_found"] = page["any_findings"].get<bool>() || page["any_folded"].get<bool>();
    page["folded_count"] = std::to_string(page["folded"].size());
    return rendered_template(report_templates().at("report.html"), page);
}

}  // namespace vesselbench
