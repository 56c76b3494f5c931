#include "geometry/vessel/narrowing/correct_narrowing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "geometry/kernel/argument_checks.h"
#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/self_intersections.h"
#include "geometry/kernel/surface_distance.h"
#include "geometry/vessel/centerlines/branch_queries.h"
#include "geometry/vessel/tree/tube.h"

namespace vesselbench {

namespace {

constexpr double kLeastBlend = 0.25;  ///< a shorter one leaves a crease [expected radii]
constexpr double kFarthest = 3.0;  ///< a wall farther from the axis is another's [expected radii]
constexpr double kFarthestAfter = 2.0;  ///< a section this far from round is a thorn [wanted radii]
constexpr double kMostFactor = 4.0;     ///< what is scaled by more is no section, but noise
constexpr double kAxisSpacing = 0.25;   ///< of the axis' points [expected radii]
constexpr int kAxisPasses = 10;         ///< smooth over about half a radius
constexpr int kSectionSteps = 10;       ///< until a section is found
constexpr double kAxisBeyond = 2.0;     ///< of the axis beyond what moves [expected radii]
constexpr double kLeastGap = 0.25;  ///< to the next wall afterwards, if it was wider [radii moved]

Diagnostic refusal(const char* code, const Narrowing& narrowing) {
    return {.code = code, .operation = "correct-narrowing", .place = narrowing.place};
}

double smooth_step(double t) {
    t = std::clamp(t, 0.0, 1.0);
    return t * t * t * (t * (6.0 * t - 15.0) + 10.0);  // no jump of the curvature
}

/// The factor of the distances from the axis, by arc length.
class Widening {
public:
    Widening(RadiusCourse course, const Narrowing& narrowing, const NarrowingCorrection& wanted)
        : course_(std::move(course)),
          from_(narrowing.from),
          to_(narrowing.to),
          deepest_(narrowing.deepest),
          first_(from_ - wanted.blend * course_.expected_at(from_)),
          last_(to_ + wanted.blend * course_.expected_at(to_)),
          strength_(wanted.strength),
          target_(wanted.radius.value_or(narrowing.expected_radius) / narrowing.expected_radius) {}

    /// Keeps within [low, high]; where a blend becomes too short, it begins within the stretch.
    /// \return whether the deepest place is still between the blends
    bool limit(double low, double high) {
        first_ = std::max(first_, low);
        last_ = std::min(last_, high);
        from_ = std::max(from_, first_ + kLeastBlend * course_.expected_at(first_));
        to_ = std::min(to_, last_ - kLeastBlend * course_.expected_at(last_));
        return from_ <= deepest_ && deepest_ <= to_;
    }

    [[nodiscard]] double first() const { return first_; }

    [[nodiscard]] double last() const { return last_; }

    /// Of the wall after the widening at full strength, outside the blends [mm].
    [[nodiscard]] double wanted_radius(double s) const {
        const double within = std::clamp(s, from_, to_);
        return std::max(target_ * course_.expected_at(within), course_.found_at(within));
    }

    /// 1 outside (first, last).
    [[nodiscard]] double factor(double s) const {
        if (s <= first_ || s >= last_) return 1.0;
        const double within = std::clamp(s, from_, to_);
        const double ratio = target_ * course_.expected_at(within) / course_.found_at(within);
        const double share = std::min(smooth_step((s - first_) / (from_ - first_)),
                                      smooth_step((last_ - s) / (last_ - to_)));
        return std::exp(strength_ * share * std::log(std::max(1.0, ratio)));
    }

private:
    RadiusCourse course_;
    double from_, to_, deepest_, first_, last_, strength_, target_;
};

/// The branch's axis around a stretch, smooth, so that sections do not cross within the vessel.
class Axis {
public:
    Axis(const CenterlineBranch& branch, double from, double to, double radius)
        : start_(std::max(0.0, from - kAxisBeyond * radius)), step_(kAxisSpacing * radius) {
        const double end = std::min(branch_length(branch), to + kAxisBeyond * radius);
        const int steps = std::max(2, static_cast<int>((end - start_) / step_));
        Positions points;
        for (int i = 0; i <= steps; ++i)
            points.push_back(point_at(branch, start_ + (end - start_) * i / steps));
        for (int pass = 0; pass < kAxisPasses; ++pass) {
            const Positions before = points;
            for (std::size_t i = 1; i + 1 < points.size(); ++i)
                points[i] = 0.5 * before[i] + 0.25 * (before[i - 1] + before[i + 1]);
        }
        tube_ = Tube(std::move(points), {});
        stretched_ = (end - start_) / tube_.length();
    }

    /// \param s arc length of the branch, which is a little longer than the smooth axis [mm]
    [[nodiscard]] Vec3 at(double s) const {
        return tube_.centre(tube_.at((s - start_) / stretched_));
    }

    /// The arc length whose section holds x. The nearest point of a polyline jumps on the inner
    /// side of its corners; sections across a tangent that turns steadily do not.
    [[nodiscard]] double section_of(const Vec3& x) const {
        double s = start_ + stretched_ * tube_.along(tube_.nearest(x));
        for (int i = 0; i < kSectionSteps; ++i) {
            const Vec3 ahead = at(s + step_), behind = at(s - step_);
            s += (x - at(s)).dot((ahead - behind).normalized());
        }
        return s;
    }

private:
    double start_, step_, stretched_ = 1.0;
    Tube tube_;
};

/// 1: of the wall, and not at a rim or cap. #V
std::vector<std::uint8_t> wall_vertices(const Surface& surface) {
    std::vector<std::uint8_t> wall(surface.vertex_count(), 1);
    for (TriangleId t = 0; t < surface.triangle_count(); ++t)
        if (surface.patch_of(t).kind != PatchKind::Wall)
            for (const VertexId v : surface.triangles()[t]) wall[v] = 0;
    for (const auto& loop : surface.topology->boundary_loops())
        for (const VertexId v : loop) wall[v] = 0;
    return wall;
}

/// A vertex of the stretch and its place in the axis' coordinates.
struct StretchVertex {
    VertexId vertex = 0;
    double along = 0.0;     ///< from the branch's start [mm]
    double distance = 0.0;  ///< from the axis [mm]
};

/// The connected vertices around the deepest place with an arc length in (first, last).
std::vector<StretchVertex> stretch_vertices(const Surface& surface, const Axis& axis,
                                            const Narrowing& narrowing, const Widening& widening) {
    const Positions& x = surface.points();
    const auto placed = [&](VertexId v) {
        const double s = axis.section_of(x[v]);
        return StretchVertex{v, s, (x[v] - axis.at(s)).norm()};
    };
    const auto belongs = [&](const StretchVertex& v) {
        return v.along > widening.first() && v.along < widening.last();
    };
    const TriangleId nearest = distance_to(surface).closest_point(narrowing.place).triangle;
    std::vector<StretchVertex> found;
    std::vector<std::uint8_t> seen(x.size(), 0);
    const auto visit = [&](VertexId v) {
        if (std::exchange(seen[v], std::uint8_t{1})) return;
        if (const StretchVertex at = placed(v); belongs(at)) found.push_back(at);
    };
    for (const VertexId corner : surface.triangles()[nearest]) visit(corner);
    for (std::size_t i = 0; i < found.size(); ++i)
        for (const VertexId v : surface.topology->rings().row(found[i].vertex)) visit(v);
    return found;
}

/// The nearest of the stretch's vertices on each side that cannot move, so that blends end before.
std::pair<double, double> limits_of(const std::vector<StretchVertex>& vertices,
                                    const std::vector<std::uint8_t>& wall, double middle) {
    double low = -std::numeric_limits<double>::infinity(), high = -low;
    for (const StretchVertex& v : vertices) {
        if (wall[v.vertex]) continue;
        if (v.along < middle)
            low = std::max(low, v.along);
        else
            high = std::min(high, v.along);
    }
    return {low, high};
}

/// Where what moves would come closer to a wall that stays than a share of its way.
std::optional<SurfaceHit> wall_in_the_way(const Surface& surface, const Positions& moved,
                                          const std::vector<StretchVertex>& vertices,
                                          const std::vector<std::uint8_t>& moving) {
    std::vector<Triangle> staying;
    for (TriangleId t = 0; t < surface.triangle_count(); ++t)
        if (!moving[t]) staying.push_back(surface.triangles()[t]);
    if (staying.empty()) return std::nullopt;
    const SurfaceDistance walls(surface.points(), staying);
    for (const StretchVertex& v : vertices) {
        const Vec3& from = surface.points()[v.vertex];
        const Vec3 way = moved[v.vertex] - from;
        if (way.squaredNorm() == 0.0) continue;
        const auto hit = walls.first_hit(from, way, (1.0 + kLeastGap) * way.norm());
        if (hit && !hit->from_inside && hit->distance > 0.0) return hit;
    }
    return std::nullopt;
}

/// Refuses what would touch or cross a wall.
void require_room(const Surface& surface, const Positions& moved,
                  const std::vector<StretchVertex>& vertices, const Narrowing& narrowing,
                  const Progress& progress) {
    std::vector<std::uint8_t> moving(surface.triangle_count(), 0);
    for (const StretchVertex& v : vertices)
        for (const TriangleId t : surface.topology->triangles_at().row(v.vertex)) moving[t] = 1;
    if (const auto hit = wall_in_the_way(surface, moved, vertices, moving)) {
        Diagnostic touching = refusal("narrowing-without-room", narrowing);
        touching.figures = {{"gap_mm", hit->distance}};
        touching.place = hit->point;
        throw DiagnosedFailure(touching);
    }
    const auto crossings = [&](const Positions& at) {
        return self_intersections_with(at, surface.triangles(), moving, progress.silent());
    };
    const auto after = crossings(moved);
    if (after.empty()) return;
    const auto known = crossings(surface.points());
    for (const TrianglePair& pair : after)
        if (!std::ranges::binary_search(known, pair)) {
            Diagnostic crossing = refusal("narrowing-would-cross", narrowing);
            crossing.place = moved[surface.triangles()[pair.first][0]];
            throw DiagnosedFailure(crossing);
        }
}

/// A thread has no section that could be scaled.
Diagnostic nearly_closed(const Narrowing& narrowing) {
    Diagnostic closed = refusal("narrowing-nearly-closed", narrowing);
    closed.figures = {{"found_mm", narrowing.found_radius},
                      {"expected_mm", narrowing.expected_radius}};
    closed.remedies = {{.arguments = {{"radius", ""}}}};
    return closed;
}

void check(const Narrowing& narrowing, const NarrowingCorrection& parameters) {
    require_range("strength", parameters.strength, 0.0, 1.0);
    require_positive("blend", parameters.blend);
    const double radius = parameters.radius.value_or(narrowing.expected_radius);
    require_positive("radius", radius);
    if (radius > narrowing.found_radius) return;
    Diagnostic small = refusal("narrowing-radius-small", narrowing);
    small.figures = {{"radius_mm", radius}, {"found_mm", narrowing.found_radius}};
    small.remedies = {{.arguments = {{"radius", ""}}}};
    throw DiagnosedInput(small);
}

}  // namespace

CorrectedNarrowing correct_narrowing(const Surface& surface, const CenterlineGraph& graph,
                                     const std::vector<WallRing>& rings, const Narrowing& narrowing,
                                     const NarrowingCorrection& parameters,
                                     const Progress& progress) {
    check(narrowing, parameters);
    RadiusCourse course = radius_course(rings, narrowing.from, narrowing.to);
    if (course.along.empty())
        throw DiagnosedFailure(refusal("narrowing-without-vessel", narrowing));
    const double low = course.along.front(), high = course.along.back();
    Widening widening(std::move(course), narrowing, parameters);
    if (!widening.limit(low, high))
        throw DiagnosedFailure(refusal("narrowing-without-vessel", narrowing));
    if (widening.factor(narrowing.deepest) > kMostFactor)
        throw DiagnosedFailure(nearly_closed(narrowing));
    const Axis axis(graph.branches[narrowing.branch], widening.first(), widening.last(),
                    narrowing.expected_radius);
    const auto wall = wall_vertices(surface);
    const auto [cap_low, cap_high] =
        limits_of(stretch_vertices(surface, axis, narrowing, widening), wall, narrowing.deepest);
    if (!widening.limit(cap_low, cap_high))
        throw DiagnosedFailure(refusal("narrowing-at-opening", narrowing));
    const auto vertices = stretch_vertices(surface, axis, narrowing, widening);
    CorrectedNarrowing result{.from = widening.first(), .to = widening.last()};
    Positions moved = surface.points();
    for (const StretchVertex& v : vertices) {
        const double factor = widening.factor(v.along);
        const bool thorn =
            factor > 1.1 && factor * v.distance > kFarthestAfter * widening.wanted_radius(v.along);
        if (thorn || v.distance > kFarthest * narrowing.expected_radius)
            throw DiagnosedFailure(refusal("narrowing-not-a-tube", narrowing));
        if (factor == 1.0) continue;
        const Vec3 centre = axis.at(v.along);
        moved[v.vertex] = centre + factor * (moved[v.vertex] - centre);
        const double way = (moved[v.vertex] - surface.points()[v.vertex]).norm();
        result.farthest = std::max(result.farthest, way);
        ++result.moved;
    }
    if (result.moved == 0 && parameters.strength > 0.0)
        throw DiagnosedFailure(refusal("narrowing-without-vessel", narrowing));
    progress.report(0.5, "checking the walls around");
    require_room(surface, moved, vertices, narrowing, progress);
    result.radius = narrowing.found_radius * widening.factor(narrowing.deepest);
    result.surface = surface.with_positions(std::move(moved));
    return result;
}

}  // namespace vesselbench
