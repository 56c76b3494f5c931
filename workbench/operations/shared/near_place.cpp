#include "workbench/operations/shared/near_place.h"

#include "geometry/kernel/measure.h"
#include "smoothing/brush/brush.h"

namespace vesselbench {

std::vector<Parameter> near_parameters(const std::string& what) {
    return {
        {.name = "at",
         .type = ParameterType::Point,
         .unit = "mm",
         .help = what + " only around this place of the surface; what is farther away than within "
                        "keeps its vertices; default: the whole surface",
         .meaning = Meaning::Place},
        {.name = "within",
         .unit = "mm",
         .help = "distance from it along the surface; default: the vessel's radius "
                 "there",
         .minimum = 0.0,
         .above_minimum = true,
         .only_with = Condition{"at"}}};
}

std::optional<NearPlace> near_place(const Surface& surface, const SurfaceDistance& places,
                                    Arguments& arguments) {
    const auto at = arguments.optional_point("at");
    if (!at) return std::nullopt;
    if (!arguments.has("within"))
        arguments.set("within",
                      nearest_anchor(surface, places, *at, mean_edge_length(surface)).radius);
    return NearPlace{*at, arguments.real("within")};
}

}  // namespace vesselbench
