#include "workbench/findings/stated_ends.h"

#include <limits>
#include <optional>

#include <nlohmann/json.hpp>

#include "workbench/case/point_json.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

std::optional<double> number_in(const Json& object, const char* key) {
    if (!object.is_object() || !object.contains(key) || !object[key].is_number())
        return std::nullopt;
    return object[key].get<double>();
}

std::optional<Vec3> place_in(const Json& end) {
    if (!end.is_object() || !end.contains("place_mm")) return std::nullopt;
    const Json& place = end["place_mm"];
    if (!place.is_array() || place.size() != 3) return std::nullopt;
    for (const Json& coordinate : place)
        if (!coordinate.is_number()) return std::nullopt;
    return point_from(place);
}

/// None if it was not judged.
std::optional<StatedEnd> end_in(const Json& end) {
    const auto place = place_in(end);
    if (!place || !end.contains("odds")) return std::nullopt;
    const Json& odds = end["odds"];
    const auto diameter = number_in(odds, "vessel_mm");
    const auto opening = number_in(odds, "opening"), sac = number_in(odds, "sac"),
               bump = number_in(odds, "bump");
    if (!diameter || !opening || !sac || !bump) return std::nullopt;
    return StatedEnd{*place, *diameter, {*opening, *sac, *bump}};
}

}  // namespace

std::vector<StatedEnd> stated_ends(const std::vector<LogEntry>& log) {
    std::vector<StatedEnd> stated;
    for (const LogEntry& entry : log) {
        if (!entry.result) continue;
        const Json report = Json::parse(entry.result->report, nullptr, false);
        if (!report.is_object() || !report.contains("ends") || !report["ends"].is_array()) continue;
        std::vector<StatedEnd> ends;
        for (const Json& end : report["ends"])
            if (const auto one = end_in(end)) ends.push_back(*one);
        if (!ends.empty()) stated = std::move(ends);  // whoever decides again, decides all of them
    }
    return stated;
}

const StatedEnd* stated_at(std::span<const StatedEnd> stated, const Vec3& place, double diameter) {
    constexpr double kAlike = 2.0;  // widths
    const StatedEnd* nearest = nullptr;
    double least = std::numeric_limits<double>::infinity();
    for (const StatedEnd& end : stated) {
        const double away = (end.place - place).norm();
        const bool alike = diameter < kAlike * end.diameter && end.diameter < kAlike * diameter;
        if (!alike || away > end.diameter || away >= least) continue;
        least = away;
        nearest = &end;
    }
    return nearest;
}

}  // namespace vesselbench
