#include "workbench/case/point_json.h"

#include <nlohmann/json.hpp>

namespace vesselbench {

nlohmann::ordered_json point_json(const Vec3& point) {
    return nlohmann::ordered_json::array({point.x(), point.y(), point.z()});
}

Vec3 point_from(const nlohmann::ordered_json& json) {
    return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}

}  // namespace vesselbench
