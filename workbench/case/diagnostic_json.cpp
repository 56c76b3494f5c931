#include "workbench/case/diagnostic_json.h"

#include <nlohmann/json.hpp>

#include "workbench/case/point_json.h"

namespace vesselbench {

nlohmann::ordered_json diagnostic_json(const Diagnostic& diagnostic) {
    using Json = nlohmann::ordered_json;
    Json json = {{"code", diagnostic.code}, {"place_mm", nullptr}, {"figures", diagnostic.figures}};
    if (diagnostic.place) json["place_mm"] = point_json(*diagnostic.place);
    json["remedies"] = Json::array();
    for (const Remedy& remedy : diagnostic.remedies)
        json["remedies"].push_back(
            {{"operation", remedy.operation}, {"arguments", remedy.arguments}});
    return json;
}

}  // namespace vesselbench
