#include "workbench/session/lost_wall.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numeric>
#include <vector>

#include "geometry/kernel/measure.h"
#include "geometry/kernel/surface_distance.h"
#include "geometry/kernel/touching_ball.h"
#include "geometry/kernel/wall_edges.h"
#include "workbench/session/changed_wall.h"

namespace vesselbench {

namespace {

/// Balls are looked for at the farthest vertices only: a sac's dome is among them.
constexpr std::size_t kMostBalls = 500;
constexpr double kSkin = 1e-6;  ///< of the surface's size: skips the wall that a ray starts on [-]
/// A line's tip is about one radius from the wall of its end.
constexpr double kTipReach = 2.0;

struct LostVertex {
    VertexId vertex = 0;
    double distance = 0.0;  ///< from the new wall [mm]
};

/// Where wall may be lost at all.
std::vector<VertexId> changed_of(const StatedChange& stated, const Surface& before,
                                 const Surface& after) {
    std::vector<VertexId> changed;
    if (same_triangles(before, after)) {
        // No vertex is farther from the new wall than from its new place.
        for (VertexId v = 0; v < before.vertex_count(); ++v)
            if ((before.points()[v] - after.points()[v]).norm() > stated.wall_lost)
                changed.push_back(v);
    } else if (stated.zones) {
        changed = corners_of(before, triangles_missing_in(after, before, stated.zones));
    } else {
        changed.resize(before.vertex_count());
        std::iota(changed.begin(), changed.end(), VertexId{0});
    }
    return changed;
}

/// Those that are farther than stated from some wall.
std::vector<LostVertex> lost_from(const SurfaceDistance& wall, const Surface& before,
                                  const std::vector<VertexId>& vertices, double stated) {
    Positions places;
    for (const VertexId v : vertices) places.push_back(before.points()[v]);
    const std::vector<SurfacePoint> nearest = wall.closest_points(places);
    std::vector<LostVertex> lost;
    for (std::size_t i = 0; i < vertices.size(); ++i)
        if (nearest[i].distance > stated) lost.push_back({vertices[i], nearest[i].distance});
    return lost;
}

/// The triangles within `reach` of some vertices, at least [mm]: a tree of them is made sooner than
/// one of the whole surface.
std::vector<Triangle> triangles_near(const Surface& surface, const Surface& before,
                                     const std::vector<VertexId>& vertices, double reach) {
    Positions places;
    for (const VertexId v : vertices) places.push_back(before.points()[v]);
    Bounds box = bounds(places);
    box.min.array() -= reach;
    box.max.array() += reach;
    std::vector<Triangle> near;
    for (TriangleId t = 0; t < surface.triangle_count(); ++t)
        if (meets(surface, t, box)) near.push_back(surface.triangles()[t]);
    return near;
}

std::vector<LostVertex> lost_vertices(const StatedChange& stated, const Surface& before,
                                      const Surface& after) {
    const std::vector<VertexId> changed = changed_of(stated, before, after);
    if (changed.empty()) return {};
    if (stated.zones) {
        const auto near = triangles_near(after, before, changed, stated.wall_lost);
        if (!near.empty() &&
            lost_from(SurfaceDistance(after.points(), near), before, changed, stated.wall_lost)
                .empty())
            return {};
    }
    return lost_from(distance_to(after), before, changed, stated.wall_lost);
}

/// Caps are no wall: the tip of an end that is closed by one lies on it. 0 if there is no wall.
double distance_to_wall(const Surface& surface, const Vec3& place) {
    const std::vector<std::uint8_t> wall = vertices_of_wall(surface);
    double least = std::numeric_limits<double>::infinity();
    for (VertexId v = 0; v < surface.vertex_count(); ++v)
        if (wall[v] != 0) least = std::min(least, (surface.points()[v] - place).squaredNorm());
    return std::isfinite(least) ? std::sqrt(least) : 0.0;
}

/// The lost vertex at an end's tip; none: nothing is lost there.
std::optional<VertexId> lost_at(const NamedLoss& end, const Surface& before,
                                const std::vector<LostVertex>& lost, double slack) {
    double least = kTipReach * distance_to_wall(before, end.tip) + slack;
    std::optional<VertexId> nearest;
    for (const LostVertex& one : lost) {
        const Vec3& place = before.points()[one.vertex];
        const double distance = (place - end.tip).norm();
        if (distance > least || (end.plane && end.plane->distance(place) <= 0.0)) continue;
        least = distance;
        nearest = one.vertex;
    }
    return nearest;
}

/// Marks what hangs together with a vertex: beyond the end's plane, or of what is lost.
void mark_piece(const NamedLoss& end, const Surface& before, VertexId from,
                const std::vector<std::uint8_t>& is_lost, std::vector<std::uint8_t>& marked) {
    std::vector<std::uint8_t> met(before.vertex_count(), 0);
    const auto belongs = [&](VertexId v) {
        return end.plane ? end.plane->distance(before.points()[v]) > 0.0 : is_lost[v] == 1;
    };
    std::vector<VertexId> open = {from};
    met[from] = 1;
    while (!open.empty()) {
        const VertexId v = open.back();
        open.pop_back();
        marked[v] = 1;
        for (const auto u : before.topology->rings().row(v))
            if (!met[u] && belongs(u)) {
                met[u] = 1;
                open.push_back(u);
            }
    }
}

/// Leaves out what belongs to the ends that may go: the piece at each one's tip, beyond its plane.
void leave_out_named(const StatedChange& stated, const Surface& before,
                     std::vector<LostVertex>& lost) {
    if (stated.named.empty() || lost.empty()) return;
    std::vector<std::uint8_t> is_lost(before.vertex_count(), 0), named(before.vertex_count(), 0);
    for (const LostVertex& one : lost) is_lost[one.vertex] = 1;
    for (const NamedLoss& end : stated.named)
        if (const auto from = lost_at(end, before, lost, stated.wall_lost))
            mark_piece(end, before, *from, is_lost, named);
    std::erase_if(lost, [&](const LostVertex& one) { return named[one.vertex] == 1; });
}

/// Balls that touch a wall from inside.
class BallsInside {
public:
    explicit BallsInside(const Surface& wall)
        : wall_(wall),
          search_(distance_to(wall)),
          normals_(vertex_normals(wall)),
          farthest_(bounds(wall).diagonal()) {}

    [[nodiscard]] double radius_at(VertexId v) const {
        const Vec3 &at = wall_.points()[v], inward = -normals_[v];
        if (inward.isZero()) return 0.0;
        const double skin = kSkin * farthest_;
        const auto hit = search_.first_hit(at + skin * inward, inward, farthest_);
        const double across = hit ? hit->distance + skin : farthest_;
        return touching_ball(at, inward, 0.5 * across,
                             [&](const Vec3& centre, double reach) -> std::optional<Vec3> {
                                 const auto nearest = search_.closest_point(centre, reach);
                                 return nearest ? std::optional(nearest->point) : std::nullopt;
                             });
    }

private:
    const Surface& wall_;
    SurfaceDistance search_;
    Positions normals_;
    double farthest_;
};

}  // namespace

std::optional<LostWall> lost_wall(const StatedChange& stated, const Surface& before,
                                  const Surface& after, const Progress& progress) {
    if (std::isinf(stated.wall_lost)) return std::nullopt;
    std::vector<LostVertex> lost = lost_vertices(stated, before, after);
    progress.check_cancelled();
    leave_out_named(stated, before, lost);
    if (lost.empty()) return std::nullopt;
    std::ranges::stable_sort(lost, std::greater{}, &LostVertex::distance);
    const auto found = [&](const LostVertex& one, double limit) {
        return LostWall{before.points()[one.vertex], one.distance, limit};
    };
    if (stated.radii_lost <= 0.0) return found(lost.front(), stated.wall_lost);
    const BallsInside balls(before);
    lost.resize(std::min(lost.size(), kMostBalls));
    for (const LostVertex& one : lost) {
        progress.check_cancelled();
        const double limit = stated.radii_lost * balls.radius_at(one.vertex);
        if (one.distance > limit) return found(one, std::max(limit, stated.wall_lost));
    }
    return std::nullopt;
}

}  // namespace vesselbench
