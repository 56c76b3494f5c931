#include "geometry/vessel/openings/end_arguments.h"

#include <utility>
#include <vector>

#include "geometry/kernel/wording.h"

namespace vesselbench {

std::map<std::string, std::string> end_arguments(const Positions& inlets, const Positions& open,
                                                 const Positions& closed) {
    std::map<std::string, std::string> arguments;
    for (const auto& [name, places] :
         {std::pair{"inlet", &inlets}, {"open", &open}, {"closed", &closed}}) {
        std::vector<std::string> texts;
        for (const Vec3& place : *places) texts.push_back(coordinates_argument(place));
        if (!texts.empty()) arguments[name] = joined(texts, ",");
    }
    return arguments;
}

}  // namespace vesselbench
