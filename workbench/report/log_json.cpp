#include "workbench/report/log_json.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "geometry/kernel/wording.h"
#include "workbench/case/arguments.h"
#include "workbench/case/diagnostic_json.h"
#include "workbench/case/diagnostic_words.h"
#include "workbench/case/measure_json.h"
#include "workbench/session/surface_change.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

void add_part(std::string& text, const std::string& part) {
    text += (text.empty() ? "" : ", ") + part;
}

/// Why there is no change of the volume; empty if there is one, or nothing to compare.
std::string no_volume_reason(const SurfaceChange& change) {
    if (change.triangles_before == 0 || !change.volume_after || volume_change(change)) return "";
    return change.volume_before ? "the surface before was inside out"
                                : "the triangles before were not oriented alike";
}

void add_result(Json& json, const ResultRecord& result) {
    json["resolved"] = to_json(result.resolved);
    json["duration_s"] = result.duration;
    json["warnings"] = worded(result.warnings);
    json["diagnostics"] = diagnostics_json(result.warnings);
    json["change"] = change_json(result.change);
    if (const std::string why = no_volume_reason(result.change); !why.empty())
        json["change"]["no_volume_change"] = why;
    json["report"] = result.report.empty() ? Json() : Json::parse(result.report, nullptr, false);
    json["program_version"] = result.program_version;
    json["device"] = result.device;
}

/// Vertices may slide along the surface: where the operation knows the distance from it, that is
/// what is told. \return none: it does not
std::optional<double> reported_distance(const Json& report) {
    if (!report.is_object() || !report.contains("local_error")) return std::nullopt;
    const Json& error = report["local_error"];
    if (!error.is_object() || !error.contains("largest_mm") || !error["largest_mm"].is_number())
        return std::nullopt;
    return error["largest_mm"].get<double>();
}

std::string text_of(const SurfaceChange& change, std::optional<double> distance) {
    std::string text;
    if (const auto part = volume_change(change)) {
        const double percent = 100.0 * *part;
        if (std::abs(percent) >= 0.005) add_part(text, formatted(percent, "volume %+.2f %%"));
    } else if (const std::string why = no_volume_reason(change); !why.empty()) {
        add_part(text,
                 formatted(*change.volume_after, "volume %.1f mm\u00B3 (no change: ") + why + ")");
    } else if (change.volume_after && !change.volume_before) {
        add_part(text, formatted(*change.volume_after, "volume %.1f mm\u00B3"));
    }
    // Between surfaces of other triangles, the distance may be that to a part which has gone.
    if (distance && *distance >= 0.0005)
        add_part(text, formatted(*distance, "distance up to %.3f mm"));
    else if (!distance && change.largest_deviation && *change.largest_deviation >= 0.0005)
        add_part(text, formatted(*change.largest_deviation, change.moved_vertices > 0
                                                                ? "moved up to %.3f mm"
                                                                : "differs by up to %.3f mm"));
    if (change.triangles_before != change.triangles_after)
        add_part(
            text,
            (change.triangles_before == 0 ? "" : std::to_string(change.triangles_before) + " -> ") +
                std::to_string(change.triangles_after) + " triangles");
    return text;
}

}  // namespace

std::string change_text(const SurfaceChange& change) {
    return text_of(change, {});
}

Json reported(const ResultRecord& result) {
    Json report = Json::parse(result.report, nullptr, false);
    return report.is_object() ? report : Json::object();
}

std::string effect_text(const ResultRecord& result) {
    const Json report = reported(result);
    std::string text;
    if (report.contains("headline") && report["headline"].is_string())
        text = report["headline"].get<std::string>();
    const std::string change = text_of(result.change, reported_distance(report));
    if (!change.empty()) add_part(text, change);
    return text;
}

Json log_json(const LogEntry& entry) {
    const EditRecord& edit = entry.edit;
    Json json = {{"edit", edit.edit.id},
                 {"revision", edit.edit.revision},
                 {"step", to_string(edit.place.step)},
                 {"variant", edit.place.variant},
                 {"operation", edit.operation},
                 {"given", to_json(edit.given)},
                 {"author", edit.author},
                 {"time", edit.time},
                 {"note", edit.note},
                 {"status", to_string(entry.status)},
                 {"reason", entry.reason}};
    if (entry.result) add_result(json, *entry.result);
    return json;
}

}  // namespace vesselbench
