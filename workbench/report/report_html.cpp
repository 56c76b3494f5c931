#include "workbench/report/report_html.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "geometry/kernel/wording.h"
#include "workbench/case/argument_texts.h"
#include "workbench/case/purposes.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kStyle = R"(
body{font:15px/1.5 system-ui,sans-serif;color:#1c2530;max-width:1100px;margin:2rem auto;padding:0 1rem}
h1{font-size:1.7rem;margin-bottom:.2rem}h2{font-size:1.2rem;margin-top:2.2rem;border-bottom:1px solid #ccd5de}
table{border-collapse:collapse;width:100%;margin:.6rem 0}td,th{text-align:left;padding:.25rem .7rem .25rem 0;
border-bottom:1px solid #e6ebf0;vertical-align:top}th{color:#5a6875;font-weight:600}td.n,th.n{text-align:right;
font-variant-numeric:tabular-nums;white-space:nowrap}.about{color:#5a6875}.warn{background:#fff4dc;
border-left:4px solid #e0a100;padding:.4rem .8rem;margin:.4rem 0}.tiles{display:flex;flex-wrap:wrap;gap:.8rem;
margin:1rem 0}.tile{background:#f2f5f8;border-radius:6px;padding:.6rem 1rem}.tile b{display:block;font-size:1.25rem}
.pictures{display:flex;flex-wrap:wrap;gap:.8rem}figure{margin:0;flex:1 1 300px}figure img{width:100%;
border:1px solid #e6ebf0}figcaption{color:#5a6875;font-size:.9rem}.good{color:#1a7f37}.bad{color:#b42318}
)";

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
        {"_kg_m3", "kg/m&sup3;"}, {"_cm3_s", "cm&sup3;/s"}, {"_m_s", "m/s"}, {"_pa_s", "Pa s"},
        {"_mm3", "mm&sup3;"},     {"_mm2", "mm&sup2;"},     {"_mm", "mm"},   {"_deg", "deg"}};
    std::string unit;
    for (const auto& [ending, name] : units)
        if (unit.empty() && key.ends_with(ending)) {
            key.resize(key.size() - ending.size());
            unit = " [" + name + "]";
        }
    std::ranges::replace(key, '_', ' ');
    return xml_escaped(key) + unit;
}

/// Longer lists, such as the planes of many cuts, are left to report.json.
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
    if (value.is_string()) return xml_escaped(value.get<std::string>());
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

std::string row(const std::vector<std::string>& cells, const char* tag = "td") {
    std::string text = "<tr>";
    for (std::size_t i = 0; i < cells.size(); ++i)
        text += std::string("<") + tag + (i > 0 ? " class=n>" : ">") + cells[i] + "</" + tag + ">";
    return text + "</tr>\n";
}

const Json& part_of(const Json& json, const std::string& key) {
    static const Json nothing;
    return json.is_object() && json.contains(key) ? json[key] : nothing;
}

std::string tile(const std::string& name, const std::string& value) {
    return "<div class=tile><b>" + value + "</b>" + name + "</div>\n";
}

std::string tiles(const Json& report) {
    const Json& after = part_of(part_of(report, "quality"), "after");
    std::string html = "<div class=tiles>";
    html += tile("triangles", shown(part_of(after, "triangles")));
    html += tile("volume [mm&sup3;]", shown(part_of(after, "volume")));
    html += tile("openings", std::to_string(part_of(report, "openings").size()));
    if (report.contains("volume_mesh"))
        html += tile("tetrahedra", shown(part_of(report["volume_mesh"], "cells")));
    const Json& inlets = part_of(part_of(report, "flow"), "inlets");
    if (!inlets.empty()) html += tile("Reynolds number", shown(part_of(inlets[0], "reynolds")));
    html += tile("warnings", std::to_string(part_of(report, "warnings").size()));
    return html + "</div>\n";
}

std::string warnings(const Json& report) {
    std::string html;
    for (const Json& warning : part_of(report, "warnings"))
        html += "<div class=warn>" + shown(warning) + "</div>\n";
    return html.empty() ? "" : "<h2>What to look at</h2>\n" + html;
}

std::string base64(const std::string& bytes) {
    static const char* letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve(bytes.size() * 4 / 3 + 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        unsigned group = 0;
        for (std::size_t k = 0; k < 3; ++k)
            group =
                group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k)
            text += i + k <= bytes.size() ? letters[group >> (18 - 6 * k) & 63u] : '=';
    }
    return text;
}

std::string gallery(std::span<const ReportPicture> pictures) {
    if (pictures.empty()) return "";
    std::string html = "<h2>Pictures</h2>\n<div class=pictures>";
    for (const ReportPicture& picture : pictures)
        html += "<figure><img alt=\"" + xml_escaped(picture.title) +
                "\" src=\"data:image/png;base64," + base64(picture.png) + "\"><figcaption>" +
                xml_escaped(picture.title) + "</figcaption></figure>\n";
    return html + "</div>\n";
}

std::string seconds_text(const Json& value) {
    return value.is_number() ? formatted(value.get<double>(), "%.1f") : shown(value);
}

std::string step_row(const Json& step) {
    const Json& change = part_of(step, "change");
    const Json &before = part_of(change, "volume_before_mm3"),
               &after = part_of(change, "volume_after_mm3");
    const Json& no_volume = part_of(change, "no_volume_change");
    std::string volume = no_volume.is_string() ? "- (" + shown(no_volume) + ")" : "-";
    if (before.is_number() && after.is_number() && before.get<double>() > 0)
        volume = number_text(100.0 * (after.get<double>() / before.get<double>() - 1.0)) + " %";
    std::string arguments;
    for (const auto& [name, value] : part_of(step, "resolved").items())
        arguments += (arguments.empty() ? "" : ", ") + xml_escaped(name) + "=" + shown(value);
    return "<tr><td class=n>" + shown(part_of(step, "edit")) + "</td><td>" +
           shown(part_of(step, "step")) + "</td><td><b>" + shown(part_of(step, "operation")) +
           "</b><br><span class=about>" + arguments + "</span></td><td class=n>" +
           seconds_text(part_of(step, "duration_s")) + "</td><td class=n>" +
           shown(part_of(change, "triangles_after")) + "</td><td class=n>" + volume +
           "</td><td class=n>" + shown(part_of(change, "mean_deviation_mm")) + " / " +
           shown(part_of(change, "largest_deviation_mm")) + "</td></tr>\n";
}

std::string steps(const Json& report) {
    std::string html =
        "<h2>What was done</h2>\n<table><tr><th class=n>edit</th><th>step</th><th>operation and "
        "arguments</th>"
        "<th class=n>seconds</th><th class=n>triangles</th><th class=n>volume</th>"
        "<th class=n>mean / largest deviation [mm]</th></tr>\n";
    for (const Json& step : part_of(report, "steps")) html += step_row(step);
    return html +
           "</table>\n<p class=about>Every row is an edit of the project that can be undone, "
           "changed by its number, and replayed.</p>\n";
}

std::string quality(const Json& report) {
    const Json& both = part_of(report, "quality");
    const Json &before = part_of(both, "before"), &after = part_of(both, "after");
    static const std::vector<std::pair<const char*, const char*>> names = {
        {"triangles", "triangles"},
        {"components", "components"},
        {"boundary_loops", "open rims"},
        {"closed", "closed"},
        {"manifold", "manifold"},
        {"self_intersections", "self-intersections"},
        {"genus", "genus"},
        {"area", "area [mm&sup2;]"},
        {"volume", "volume [mm&sup3;]"},
        {"edge_length", "edge length [mm]"},
        {"equiangle_skewness", "equiangle skewness [-], 0 is best"},
        {"radius_ratio", "radius ratio [-], 1 is best"},
        {"normal_curvature_deg", "mean normal curvature [deg]"},
        {"mean_curvature", "integral of the mean curvature [mm]"}};
    std::string html = "<h2>Surface quality</h2>\n<table>" + row({"", "before", "after"}, "th");
    for (const auto& [key, name] : names)
        html += row({name, shown(part_of(before, key)), shown(part_of(after, key))});
    const Json& wall = part_of(both, "wall");
    if (wall.is_object()) html += row({"wall only: skewness, radius ratio", "", shown(wall)});
    return html + "</table>\n";
}

bool is_for_flow(const Json& report) {
    const auto purpose = std::ranges::find(purposes(), report.value("purpose", ""), &Purpose::name);
    return purpose != purposes().end() && purpose->simulates_flow;
}

std::string openings(const Json& report) {
    std::string html =
        "<h2>Openings</h2>\n<table><tr><th>name</th><th class=n>kind</th>"
        "<th class=n>diameter [mm]</th><th class=n>area [mm&sup2;]</th><th class=n>centroid "
        "[mm]</th><th class=n>outward normal</th><th class=n>flatness [mm]</th><th class=n>tilt "
        "against the vessel there [deg]</th></tr>\n";
    for (const Json& patch : part_of(report, "openings"))
        html += row({shown(part_of(patch, "name")), shown(part_of(patch, "kind")),
                     shown(part_of(patch, "diameter")), shown(part_of(patch, "area")),
                     shown(part_of(patch, "centroid")), shown(part_of(patch, "normal")),
                     shown(part_of(patch, "flatness")), shown(part_of(patch, "tilt_deg"))});
    return html + "</table>\n<p class=about>As the model has them" +
           (is_for_flow(report) ? ", at the ends of its extensions. A flat end that was kept "
                                  "although it was tilted is named under the vessel ends."
                                : ".") +
           "</p>\n";
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
std::string ends(const Json& report) {
    const Json& list = part_of(report, "ends");
    if (!list.is_array() || list.empty()) return "";
    std::string html =
        "<h2>Vessel ends</h2>\n<table><tr><th>place [mm]</th><th class=n>vessel's diameter at its "
        "end [mm]</th><th>became</th><th>opening in the model, its diameter</th><th>why</th>"
        "</tr>\n";
    for (const Json& end : list)
        html += row({place_text(part_of(end, "place_mm")), shown(part_of(end, "diameter_mm")),
                     shown(part_of(end, "fate")), opening_text(report, part_of(end, "opening")),
                     shown(part_of(end, "why"))});
    return html + "</table>\n<p class=about>A place of this table chooses an end: " +
           (is_for_flow(report) ? "inlet=, open= and closed=" : "open= and closed=") +
           " of clip-opening take it.</p>\n";
}

/// A part of the report as a table of names and values; nothing if it is absent.
std::string plain_table(const Json& report, const ReportSection& section) {
    const Json& part = part_of(report, section.key);
    if (!part.is_object()) return "";
    std::string html =
        "<h2>" + section.title + "</h2>\n<p class=about>" + section.about + "</p>\n<table>";
    for (const auto& [name, value] : part.items()) {
        html += row({words_of(name), shown(value)});
    }
    return html + "</table>\n";
}

/// Those of every report, beside the ones that operations declare.
const std::vector<ReportSection>& usual_sections() {
    static const std::vector<ReportSection> sections = {
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
        {.key = "flow",
         .title = "Flow",
         .about = "Flow in this model, derived from the flow parameters."}};
    return sections;
}

std::string products(const Json& report) {
    std::string html = "<h2>Files</h2>\n<ul>\n";
    for (const Json& file : part_of(report, "products"))
        html += "<li><code>" + shown(file) + "</code></li>\n";
    return html + "</ul>\n";
}

/// Of a report from another version too, whose purpose may be unknown.
std::string title_of(const std::string& name) {
    const auto found = std::ranges::find(purposes(), name, &Purpose::name);
    return found != purposes().end() ? found->title : "Model";
}

}  // namespace

std::string report_html(const Json& report, std::span<const ReportPicture> pictures,
                        std::span<const ReportSection> sections) {
    const std::string input = shown(part_of(part_of(report, "input"), "name"));
    std::string html = "<!doctype html>\n<html lang=en><head><meta charset=utf-8><title>" + input +
                       "</title><style>" + kStyle + "</style></head><body>\n";
    html += "<h1>" + input + "</h1>\n<p class=about>" + title_of(report.value("purpose", "")) +
            ", prepared by vesselbench " + shown(part_of(report, "program_version")) + ". " +
            shown(part_of(report, "units_text")) + "</p>\n";
    html += tiles(report) + warnings(report) + gallery(pictures) + steps(report) + quality(report) +
            openings(report) + ends(report);
    for (const ReportSection& section : usual_sections()) html += plain_table(report, section);
    for (const ReportSection& section : sections) html += plain_table(report, section);
    return html + products(report) + "</body></html>\n";
}

}  // namespace vesselbench
