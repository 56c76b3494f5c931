#include "geometry/vessel/openings/remove_branch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "geometry/editing/editable_surface.h"
#include "geometry/editing/hole_filling.h"
#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/shortest_paths.h"
#include "geometry/kernel/wording.h"
#include "geometry/vessel/ends/surface_ends.h"
#include "geometry/vessel/openings/branch_root.h"

namespace vesselbench {

namespace {

/// What takes a larger share of the wall along is no branch [-].
constexpr double kMostRemoved = 0.75;
/// The parent's tube serves as a chart if the rim of the hole is this close to its wall [radii] and
/// leaves this much of its back free [rad].
constexpr double kLargestHeight = 0.5;
constexpr double kLargestAngle = 0.9 * std::numbers::pi;
/// A fillet protrudes from the parent's wall by more than this [parent radii], and is at most this
/// wide [branch radii].
constexpr double kFilletHeight = 0.02;
constexpr double kWidestFillet = 1.2;
/// The rebuilt wall extends at most this far beyond the foot [parent radii].
constexpr double kWidestMargin = 0.4;

/// Distance from the tubes' walls [mm], negative inside.
double height_over(const std::vector<Tube>& tubes, const Vec3& x) {
    double least = std::numeric_limits<double>::infinity();
    for (const auto& tube : tubes) least = std::min(least, tube.coordinates(x).height);
    return least;
}

/// The part to remove: vertices of the branch, and the distance of all others from it along the
/// edges.
class Foot {
public:
    Foot(const Surface& surface, const BranchRoot& root) : surface_(surface), root_(root) {}

    /// The connected vertices around the tip that belong to the branch's tube.
    std::vector<VertexId> branch_vertices(const Vec3& tip) const {
        const Positions& x = surface_.points();
        std::vector<std::int8_t> known(x.size(), -1);
        const auto belongs = [&](VertexId v) {
            if (known[v] < 0) {
                const double own = root_.own.coordinates(x[v]).height;
                known[v] =
                    own < height_over(root_.parents, x[v]) && own < height_over(root_.others, x[v])
                        ? 1
                        : 0;
            }
            return known[v] == 1;
        };
        VertexId seed = 0;
        for (VertexId v = 1; v < x.size(); ++v)
            if ((x[v] - tip).squaredNorm() < (x[seed] - tip).squaredNorm()) seed = v;
        std::vector<VertexId> found;
        if (!belongs(seed)) return found;
        std::vector<std::uint8_t> seen(x.size(), 0);
        found.push_back(seed);
        seen[seed] = 1;
        for (std::size_t i = 0; i < found.size(); ++i)
            for (const VertexId v : surface_.topology->rings().row(found[i]))
                if (!seen[v] && belongs(v)) {
                    seen[v] = 1;
                    found.push_back(v);
                }
        return found;
    }

    /// The vertices and those of the fillet around them: the wall descends from there to the
    /// parent's, over at most `reach` [mm].
    std::vector<VertexId> with_fillet(std::vector<VertexId> vertices, double reach) const {
        const Positions& x = surface_.points();
        const double lowest = kFilletHeight * root_.parent_radius;
        std::vector<double> distance(x.size(), std::numeric_limits<double>::infinity());
        for (const VertexId v : vertices) distance[v] = 0.0;
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            const VertexId v = vertices[i];
            const double height = height_over(root_.parents, x[v]);
            for (const VertexId u : surface_.topology->rings().row(v)) {
                const double to = distance[v] + (x[u] - x[v]).norm();
                if (distance[u] <= to || to > reach) continue;
                const double lower = height_over(root_.parents, x[u]);
                if (lower < lowest || lower > height) continue;
                if (std::isinf(distance[u])) vertices.push_back(u);
                distance[u] = to;
            }
        }
        return vertices;
    }

    /// 1 for the vertices and for those within `margin` [mm] of them along edges.
    std::vector<std::uint8_t> widened(const std::vector<VertexId>& vertices, double margin) const {
        const Positions& x = surface_.points();
        std::vector<double> distance(x.size(), std::numeric_limits<double>::infinity());
        ShortestPaths paths(distance);
        for (const VertexId v : vertices) paths.lower(v, 0.0);
        while (const auto at = paths.next())
            for (const VertexId u : surface_.topology->rings().row(at->vertex)) {
                const double to = at->distance + (x[u] - x[at->vertex]).norm();
                if (to <= margin) paths.lower(u, to);
            }
        std::vector<std::uint8_t> chosen(x.size(), 0);
        for (VertexId v = 0; v < x.size(); ++v) chosen[v] = distance[v] <= margin ? 1 : 0;
        return chosen;
    }

private:
    const Surface& surface_;
    const BranchRoot& root_;
};

/// Half-edges exposed by the removal, by their start; more than one where the rim pinches.
std::map<VertexId, std::vector<VertexId>> bare_edges(const Surface& surface,
                                                     const std::vector<std::uint8_t>& removed) {
    std::map<VertexId, std::vector<VertexId>> next;
    const auto triangles = surface.triangles();
    const auto& at = surface.topology->triangles_at();
    for (TriangleId t = 0; t < triangles.size(); ++t) {
        if (!removed[t]) continue;
        for (int k = 0; k < 3; ++k) {
            const VertexId a = triangles[t][k], b = triangles[t][(k + 1) % 3];
            for (const TriangleId other : at.row(a)) {
                const Triangle& c = triangles[other];
                if (!removed[other] && std::find(c.begin(), c.end(), b) != c.end())
                    next[b].push_back(a);
            }
        }
    }
    return next;
}

/// The rims of the hole, each as a loop of the remaining surface's half-edges; triangles at places
/// where a rim pinches are removed, too.
std::vector<std::vector<VertexId>> simple_rims(const Surface& surface,
                                               std::vector<std::uint8_t>& removed) {
    auto next = bare_edges(surface, removed);
    for (bool pinched = true; pinched;) {
        pinched = false;
        for (const auto& [v, to] : next)
            if (to.size() > 1) {
                for (const TriangleId t : surface.topology->triangles_at().row(v)) removed[t] = 1;
                pinched = true;
            }
        if (pinched) next = bare_edges(surface, removed);
    }
    std::vector<std::vector<VertexId>> rims;
    while (!next.empty()) {
        std::vector<VertexId> rim;
        for (auto at = next.begin(); at != next.end(); at = next.find(rim.back())) {
            const VertexId to = at->second.front();
            if (rim.empty()) rim.push_back(at->first);
            next.erase(at);
            if (to == rim.front()) break;
            rim.push_back(to);
        }
        rims.push_back(std::move(rim));
    }
    return rims;
}

double length_of(const Surface& surface, const std::vector<VertexId>& loop) {
    return mean_edge(surface.points(), loop) * static_cast<double>(loop.size());
}

/// The part connected to a rim of the hole by triangles that stay; none if the largest rim is
/// connected to it, too.
std::optional<std::vector<TriangleId>> island_at(const Surface& surface,
                                                 const std::vector<VertexId>& rim,
                                                 const std::vector<VertexId>& largest,
                                                 const std::vector<std::uint8_t>& removed) {
    std::vector<TriangleId> island;
    std::vector<std::uint8_t> seen = removed;
    const auto visit = [&](VertexId v) {
        for (const TriangleId t : surface.topology->triangles_at().row(v))
            if (!std::exchange(seen[t], 1)) island.push_back(t);
    };
    for (const VertexId v : rim) visit(v);
    for (std::size_t i = 0; i < island.size(); ++i)
        for (const VertexId v : surface.triangles()[island[i]]) {
            if (std::find(largest.begin(), largest.end(), v) != largest.end()) return std::nullopt;
            visit(v);
        }
    return island;
}

/// Removes the parts attached to the smaller rims only: islands in the hole.
/// \return the remaining rim
std::vector<VertexId> single_rim(const Surface& surface, std::vector<std::uint8_t>& removed) {
    for (int round = 0; round < 8; ++round) {
        const auto rims = simple_rims(surface, removed);
        if (rims.empty()) return {};
        if (rims.size() == 1) return rims.front();
        const auto largest =
            std::max_element(rims.begin(), rims.end(), [&](const auto& a, const auto& b) {
                return length_of(surface, a) < length_of(surface, b);
            });
        for (auto rim = rims.begin(); rim != rims.end(); ++rim) {
            if (rim == largest) continue;
            const auto island = island_at(surface, *rim, *largest, removed);
            if (!island) return {};
            for (const TriangleId t : *island) removed[t] = 1;
        }
    }
    return {};
}

/// The tube as a chart if the rim is on its side; coordinates (out, around, along).
std::optional<HoleChart> chart_on(const Tube& tube, const Positions& rim, const Vec3& mouth) {
    const double radius = tube.radius(tube.coordinates(mouth).along);
    for (const Vec3& x : rim) {
        const auto at = tube.coordinates(x);
        if (std::abs(at.height) > kLargestHeight * radius || std::abs(at.angle) > kLargestAngle ||
            at.along < 0.05 * radius || at.along > tube.length() - 0.05 * radius)
            return std::nullopt;
    }
    return HoleChart{
        [&tube, radius](const Vec3& x) {
            const auto at = tube.coordinates(x);
            return Vec3(at.height, radius * at.angle, at.along);
        },
        [&tube, radius](const Vec3& y) { return tube.position(y.z(), y.y() / radius, y.x()); }};
}

double area_of(const Surface& surface, const std::vector<std::uint8_t>& chosen) {
    double sum = 0.0;
    for (TriangleId t = 0; t < surface.triangle_count(); ++t)
        if (chosen[t]) sum += 0.5 * area_normal(surface.points(), surface.triangles()[t]).norm();
    return sum;
}

/// The triangles of the branch, its fillet and a margin around them.
/// \param margin in radii of the branch [-]
/// \throw AlgorithmFailure if the branch does not stand out of its parent
std::vector<std::uint8_t> triangles_to_remove(const Surface& surface, const BranchRoot& root,
                                              const Vec3& tip, double margin) {
    const Foot foot(surface, root);
    auto vertices = foot.branch_vertices(tip);
    if (vertices.empty())
        throw DiagnosedFailure(
            {.code = "branch-without-foot", .operation = "remove-branch", .place = tip});
    vertices = foot.with_fillet(std::move(vertices),
                                kWidestFillet * std::min(root.branch_radius, root.parent_radius));
    const auto chosen = foot.widened(
        vertices, std::min(margin * root.branch_radius, kWidestMargin * root.parent_radius));
    std::vector<std::uint8_t> removed(surface.triangle_count(), 0);
    for (TriangleId t = 0; t < surface.triangle_count(); ++t) {
        const auto& [a, b, c] = surface.triangles()[t];
        removed[t] = chosen[a] || chosen[b] || chosen[c] ? 1 : 0;
    }
    return removed;
}

/// Of a vessel that can be cut, but not removed. \param code "branch-is-trunk", "branch-too-wide"
Diagnostic not_removable(const char* code, const Vec3& tip) {
    return {.code = code,
            .operation = "remove-branch",
            .place = tip,
            .remedies = {
                {.operation = "clip-opening", .arguments = {{"tip", coordinates_argument(tip)}}}}};
}

}  // namespace

BranchRemoval remove_branch(const Surface& surface, const CenterlineGraph& graph, std::size_t tip,
                            const BranchRemovalParameters& parameters) {
    const BranchRoot root = branch_root(graph, tip);
    const Vec3 at = graph.nodes[tip].position;
    if (is_trunk(graph, tip)) throw DiagnosedFailure(not_removable("branch-is-trunk", at));
    auto removed = triangles_to_remove(surface, root, at, parameters.margin);
    const auto rim = single_rim(surface, removed);
    if (rim.size() < 3) throw DiagnosedFailure(not_removable("branch-too-wide", at));
    BranchRemoval result{.mouth = root.mouth, .removed_area = area_of(surface, removed)};
    // Where vessels touch, what lies behind a rim may be all the rest.
    if (const double share = result.removed_area / area(surface); share > kMostRemoved)
        throw DiagnosedFailure({.code = "branch-too-large",
                                .operation = "remove-branch",
                                .place = at,
                                .figures = {{"wall_percent", 100.0 * share}}});
    EditableSurface edited(surface);
    edited.remove(removed);
    std::optional<HoleChart> chart;
    if (root.parents.size() == 1)
        chart = chart_on(root.parents[0], edited.points_of(rim), root.mouth);
    result.new_triangles = fill_rim(edited, rim, parameters.continuity, chart ? &*chart : nullptr);
    result.surface = edited.to_surface();
    result.follows_parent = chart.has_value();
    return result;
}

std::vector<std::uint8_t> triangles_of_branch(const Surface& surface, const CenterlineGraph& graph,
                                              std::size_t tip,
                                              const BranchRemovalParameters& parameters) {
    return triangles_to_remove(surface, branch_root(graph, tip), graph.nodes[tip].position,
                               parameters.margin);
}

}  // namespace vesselbench
