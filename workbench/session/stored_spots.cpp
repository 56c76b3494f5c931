#include "workbench/session/stored_spots.h"

#include <array>
#include <cmath>

#include "geometry/kernel/errors.h"
#include "workbench/case/json_fields.h"
#include "workbench/case/json_text.h"
#include "workbench/case/point_json.h"
#include "workbench/session/stored_texts.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

constexpr double kUnit = 1e-6;  ///< how far the length of a unit vector may be from 1 [-]

Json json_of(const std::vector<Spot>& spots) {
    Json json = Json::array();
    for (const Spot& spot : spots)
        json.push_back({{"name", spot.name},
                        {"point", point_json(spot.point)},
                        {"normal", point_json(spot.normal)}});
    return json;
}

Vec3 vector_from(JsonFields& fields, const char* key) {
    const auto numbers = fields.required<std::array<double, 3>>(key);
    return {numbers[0], numbers[1], numbers[2]};
}

Spot spot_from(const Json& json, const std::string& place) {
    JsonFields fields(json, place);
    Spot spot{.name = fields.required<std::string>("name"),
              .point = vector_from(fields, "point"),
              .normal = vector_from(fields, "normal")};
    if (!(std::abs(spot.normal.norm() - 1.0) < kUnit))
        throw InvalidInput(place + ".normal must be a unit vector");
    return spot;
}

std::vector<Spot> spots_from(const std::string& text) {
    const Json json = json_from_text(text, "the stored spots");
    if (!json.is_array()) refuse_json(json, "spots", "a list");
    std::vector<Spot> spots;
    for (std::size_t i = 0; i < json.size(); ++i)
        spots.push_back(spot_from(json[i], "spots[" + std::to_string(i) + "]"));
    return spots;
}

}  // namespace

void store_spots(const std::filesystem::path& project, const std::vector<Spot>& spots) {
    store_text(project, StoredText::Spots, text_from_json(json_of(spots)));
}

std::vector<Spot> stored_spots(const std::filesystem::path& project) {
    const std::string text = stored_text(project, StoredText::Spots);
    return text.empty() ? std::vector<Spot>() : spots_from(text);
}

}  // namespace vesselbench
