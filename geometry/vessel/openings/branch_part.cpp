#include "geometry/vessel/openings/branch_part.h"

#include <limits>
#include <utility>
#include <vector>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/vessel/centerlines/branch_queries.h"
#include "geometry/vessel/centerlines/lines_to_tip.h"
#include "geometry/vessel/openings/remove_branch.h"

namespace vesselbench {

namespace {

/// A point so near to a tip means it; otherwise it gets a line of its own [radii of the tip].
constexpr double kOwnLineBeyond = 1.0;

constexpr VertexId kNoVertex = std::numeric_limits<VertexId>::max();

Surface chosen_part(const Surface& surface, const std::vector<std::uint8_t>& chosen) {
    std::vector<VertexId> number(surface.vertex_count(), kNoVertex);
    Positions points;
    std::vector<Triangle> triangles;
    for (TriangleId t = 0; t < chosen.size(); ++t) {
        if (chosen[t] == 0) continue;
        Triangle triangle = surface.triangles()[t];
        for (VertexId& v : triangle) {
            if (number[v] == kNoVertex) {
                number[v] = static_cast<VertexId>(points.size());
                points.push_back(surface.points()[v]);
            }
            v = number[v];
        }
        triangles.push_back(triangle);
    }
    return triangles.empty() ? Surface{} : make_surface(std::move(points), std::move(triangles));
}

}  // namespace

NamedBranch branch_at_tip(const Surface& surface, const Vec3& point, const Progress& progress) {
    auto graph = lines_to_tip(surface, point, kOwnLineBeyond, progress);
    const auto tip = tip_near(*graph, point);
    if (!tip) throw DiagnosedFailure({.code = "no-branch-at-tip", .place = point});
    return {std::move(graph), *tip};
}

Surface branch_part(const Surface& surface, const Vec3& point, double margin,
                    const Progress& progress) {
    const NamedBranch branch = branch_at_tip(surface, point, progress);
    return chosen_part(surface,
                       triangles_of_branch(surface, *branch.graph, branch.tip, {.margin = margin}));
}

}  // namespace vesselbench
