#include "geometry/vessel/centerlines/tip_name.h"

#include "geometry/kernel/wording.h"
#include "geometry/vessel/centerlines/branch_queries.h"

namespace vesselbench {

std::string tip_name(const CenterlineGraph& graph, std::size_t tip) {
    return "Vessel end, " + formatted(2 * tip_radius(graph, tip), "%.1f mm");
}

}  // namespace vesselbench
