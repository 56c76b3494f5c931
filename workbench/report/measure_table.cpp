#include "workbench/report/measure_table.h"

#include <nlohmann/json.hpp>

#include "geometry/kernel/wording.h"
#include "workbench/case/csv_text.h"
#include "workbench/case/point_json.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kHeader =
    "name,kind,length [mm],section area [mm^2],diameter by area [mm],on,state,variant,time,"
    "points [mm]\r\n";

std::string points_text(const std::vector<Vec3>& points) {
    std::string text;
    for (const Vec3& point : points)
        text += (text.empty() ? "" : "; ") + formatted(point.x(), "%.4f") + " " +
                formatted(point.y(), "%.4f") + " " + formatted(point.z(), "%.4f");
    return text;
}

/// Of a diameter, the place alone: its outline is for drawing.
std::vector<Vec3> places_of(const KeptMeasure& measure) {
    if (measure.kind == MeasureKind::Distance) return measure.points;
    return {measure.points.front()};
}

bool has_section(const KeptMeasure& measure) {
    return measure.kind == MeasureKind::Diameter && measure.area > 0.0;
}

}  // namespace

std::string measure_text(const KeptMeasure& measure) {
    if (measure.kind == MeasureKind::Distance)
        return formatted(measure.length, "%.2f mm") +
               (measure.points.size() > 2
                    ? " along " + counted(measure.points.size() - 1, "segment")
                    : "");
    return formatted(measure.length, "diameter %.2f mm inscribed") +
           (has_section(measure) ? formatted(measure.equivalent, ", %.2f mm by area") +
                                       formatted(measure.area, " (%.1f mm\u00B2)")
                                 : "");
}

std::string measures_csv(const std::vector<KeptMeasure>& measures) {
    std::string table = kHeader;
    for (const KeptMeasure& measure : measures) {
        const bool section = has_section(measure);
        table += csv_quoted(measure.name) + "," + to_string(measure.kind) + "," +
                 formatted(measure.length, "%.4f") + "," +
                 (section ? formatted(measure.area, "%.4f") : "") + "," +
                 (section ? formatted(measure.equivalent, "%.4f") : "") + "," +
                 to_string(measure.on) + "," + std::to_string(measure.state) + "," +
                 csv_quoted(measure.variant) + "," + csv_quoted(measure.time) + "," +
                 csv_quoted(points_text(places_of(measure))) + "\r\n";
    }
    return table;
}

Json measures_json(const std::vector<KeptMeasure>& measures) {
    Json list = Json::array();
    for (const KeptMeasure& measure : measures) {
        Json json = {
            {"name", measure.name}, {"kind", to_string(measure.kind)}, {"length", measure.length}};
        if (has_section(measure)) {
            json["area"] = measure.area;
            json["equivalent_diameter"] = measure.equivalent;
        }
        json["on"] = to_string(measure.on);
        json["state"] = measure.state;
        json["variant"] = measure.variant;
        json["time"] = measure.time;
        json["points"] = Json::array();
        for (const Vec3& point : places_of(measure)) json["points"].push_back(point_json(point));
        list.push_back(std::move(json));
    }
    return list;
}

}  // namespace vesselbench
