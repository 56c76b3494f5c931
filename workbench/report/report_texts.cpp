#include "workbench/report/report_texts.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "geometry/kernel/wording.h"
#include "workbench/case/argument_texts.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

/// Below this, a number is a rounding error of lengths and angles.
constexpr double kNothing = 1e-9;

/// Longer lists are left to report.json.
constexpr std::size_t kMostNumbers = 9;

bool is_long_list(const Json& value) {
    return value.is_array() && value.size() > kMostNumbers && value.front().is_number();
}

std::string joined_parts(const Json& value) {
    std::vector<std::string> parts;
    for (const auto& [key, part] : value.items())
        parts.push_back((value.is_object() ? key_text(key) + " " : "") + shown_text(part));
    return joined(parts);
}

}  // namespace

std::string figure_text(double number) {
    constexpr double kLeastWhole = 1000, kLeastExponent = 1e9;
    if (std::abs(number) < kNothing) return "0";
    const double rounded = three_digits(number), size = std::abs(rounded);
    return formatted(rounded, size >= kLeastWhole && size < kLeastExponent ? "%.0f" : "%.3g");
}

std::string key_text(std::string key) {
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

std::string shown_text(const Json& value) {
    if (value.is_null()) return "-";
    if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
    if (value.is_number_integer()) return std::to_string(value.get<std::int64_t>());
    if (value.is_number()) return figure_text(value.get<double>());
    if (value.is_string()) return value.get<std::string>();
    if (is_long_list(value)) return std::to_string(value.size()) + " numbers";
    return joined_parts(value);
}

const Json& member_of(const Json& json, const std::string& key) {
    static const Json nothing;
    return json.is_object() && json.contains(key) ? json[key] : nothing;
}

Json shown_texts(const Json& json, std::initializer_list<const char*> keys) {
    Json texts = Json::object();
    for (const char* key : keys) texts[key] = shown_text(member_of(json, key));
    return texts;
}

Json shown_texts(const Json& list) {
    Json texts = Json::array();
    for (const Json& part : list) texts.push_back(shown_text(part));
    return texts;
}

std::string place_argument(const Json& place) {
    if (!place.is_array() || place.size() != 3) return shown_text(place);
    const Vec3 point(place[0].get<double>(), place[1].get<double>(), place[2].get<double>());
    return to_text(Value(rounded_place(point)));
}

std::string end_number(const Json& report, const Json& opening) {
    for (const Json& end : member_of(report, "ends"))
        if (!opening.is_null() && member_of(end, "opening") == opening)
            return shown_text(member_of(end, "number"));
    return "-";
}

}  // namespace vesselbench
