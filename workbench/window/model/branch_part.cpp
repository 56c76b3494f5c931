#include "workbench/window/model/branch_part.h"

#include <limits>
#include <utility>
#include <vector>

#include "geometry/kernel/errors.h"
#include "geometry/vessel/centerlines/branch_queries.h"
#include "geometry/vessel/centerlines/centerlines.h"
#include "geometry/vessel/openings/remove_branch.h"

namespace vesselbench {

namespace {

/// As remove-branch: a place so many radii from a tip means it, or needs a line of its own.
constexpr double kTipReach = 1.0;

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

std::shared_ptr<const CenterlineGraph> lines_to(const Surface& surface, const Vec3& tip,
                                                double reach, const Progress& progress) {
    auto lines = centerlines_of(surface, {}, progress);
    const auto nearest = nearest_tip(*lines, tip);
    if (nearest &&
        (lines->nodes[*nearest].position - tip).norm() <= reach * tip_radius(*lines, *nearest))
        return lines;
    return centerlines_of(surface, {.ends = {tip}}, progress);
}

Surface branch_part(const Surface& surface, const Vec3& tip, double margin,
                    const Progress& progress) {
    try {
        const auto graph = lines_to(surface, tip, kTipReach, progress);
        const auto node = nearest_tip(*graph, tip);
        if (!node) return {};
        return chosen_part(surface,
                           triangles_of_branch(surface, *graph, *node, {.margin = margin}));
    } catch (const Cancelled&) {
        throw;
    } catch (const std::exception&) {
        return {};  // the operation says why
    }
}

}  // namespace vesselbench
