#include "workbench/case/point_json.h"

#include <nlohmann/json.hpp>

namespace vesselbench {

nlohmann::ordered_json point_json(const Vec3& point) {
    return nlohmann::ordered_json::array({point.x(), point.y(), point.z()});
}

}  // namespace vesselbench
