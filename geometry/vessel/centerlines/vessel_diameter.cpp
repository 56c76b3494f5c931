#include "geometry/vessel/centerlines/vessel_diameter.h"

#include <cmath>

#include "geometry/kernel/cross_section.h"
#include "geometry/vessel/centerlines/branch_queries.h"

namespace vesselbench {

double path_length(std::span<const Vec3> points) {
    double length = 0.0;
    for (std::size_t i = 1; i < points.size(); ++i) length += (points[i] - points[i - 1]).norm();
    return length;
}

std::optional<VesselDiameter> vessel_diameter(const Surface& surface, const CenterlineGraph& graph,
                                              const Vec3& point) {
    const auto nearest = nearest_place(graph, point);
    if (!nearest) return std::nullopt;
    const CenterlineBranch& branch = graph.branches[nearest->place.branch];
    const double abscissa = nearest->place.abscissa;
    VesselDiameter found{.centre = point_at(branch, abscissa),
                         .inscribed = 2.0 * radius_at(branch, abscissa)};
    const auto section = cross_section_at(surface, {found.centre, tangent_at(branch, abscissa)});
    if (!section || !section->closed) return found;
    found.outline = section->points;
    found.area = std::abs(section->area);
    found.equivalent = section->diameter();
    return found;
}

}  // namespace vesselbench
