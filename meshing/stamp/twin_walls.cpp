#include "meshing/stamp/twin_walls.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "geometry/editing/editable_surface.h"
#include "geometry/editing/hole_filling.h"
#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/surface_gap.h"
#include "geometry/kernel/wording.h"
#include "geometry/vessel/tree/tube.h"
#include "meshing/stamp/refusal.h"

namespace vesselbench {

namespace {

constexpr int kContinuity = 1;    ///< of the closed holes at their rims
constexpr int kAttempts = 4;      ///< to close a hole, each wider than the last
constexpr int kRounds = 8;        ///< to reach the gap
constexpr int kFiner = 4;         ///< points of a chart's line per centre of its tube
constexpr double kSoft = 0.6;     ///< width over which a wall bends off to the gap, of the gap [-]
constexpr double kDeepest = 0.5;  ///< a wall recedes by less [radii]
constexpr double kOvershoot = 1.1;  ///< of what lacks to the gap, added for the next round

/// Through the tube's centres as a smooth curve. Source: Catmull and Rom, "A class of local
/// interpolating splines", 1974.
Tube chart_tube(const Tube& tube) {
    const auto count = static_cast<int>(tube.points().size());
    const auto centre = [&](int i) { return tube.points()[std::clamp(i, 0, count - 1)]; };
    Positions line;
    std::vector<double> radii;
    for (int i = 0; i + 1 < count; ++i)
        for (int k = 0; k < kFiner; ++k) {
            const double t = static_cast<double>(k) / kFiner;
            const Vec3 a = centre(i - 1), b = centre(i), c = centre(i + 1), d = centre(i + 2);
            line.push_back(0.5 *
                           (2.0 * b + t * (c - a) + t * t * (2.0 * a - 5.0 * b + 4.0 * c - d) +
                            t * t * t * (3.0 * b - a - 3.0 * c + d)));
            radii.push_back((1.0 - t) * tube.radii()[i] + t * tube.radii()[i + 1]);
        }
    line.push_back(tube.points().back());
    radii.push_back(tube.radii().back());
    const Vec3 first = (line[1] - line[0]).unitOrthogonal();
    return {std::move(line), std::move(radii), first};
}

HoleChart chart_on(const Tube& tube, double radius) {
    return {[&tube, radius](const Vec3& x) {
                const TubeCoordinates at = tube.coordinates(x);
                return Vec3(at.height, radius * at.angle, at.along);
            },
            [&tube, radius](const Vec3& y) { return tube.position(y.z(), y.y() / radius, y.x()); }};
}

/// The part with both holes closed.
struct Closed {
    EditedPart part;                ///< former: of all old vertices, whether they move or not
    std::vector<std::uint8_t> own;  ///< 0 or 1: the tube of a vertex
};

Closed closed_holes(const ContactZone& zone, const TwinTubes& twins, const ContactBridge& bridge) {
    const Surface& before = zone.part.surface;
    std::vector<std::uint8_t> at_arm(before.vertex_count(), 0);
    for (const ContactArm& arm : zone.arms)
        for (const VertexId v : arm.rim) at_arm[v] = 1;
    EditableSurface edited(before);
    edited.remove(bridge.removed);
    std::vector<std::uint8_t> own = bridge.own;
    for (const std::vector<VertexId>& rim : edited.rims()) {
        if (at_arm[rim.front()]) continue;
        const std::uint8_t side = bridge.own[rim.front()];
        const Vec3 middle = loop_centre(edited.points_of(rim));
        const Tube tube = chart_tube(twins.tubes[side]).turned_to(middle);
        const HoleChart chart = chart_on(tube, tube.radius(tube.coordinates(middle).along));
        fill_rim(edited, rim, kContinuity, &chart);
        own.resize(edited.vertex_count(), side);
    }
    Closed closed;
    std::vector<VertexId> numbers;
    closed.part.surface = edited.to_surface(&numbers);
    closed.part.former.assign(closed.part.surface.vertex_count(), kNewVertex);
    closed.own.assign(closed.part.surface.vertex_count(), 0);
    for (VertexId v = 0; v < numbers.size(); ++v) {
        if (numbers[v] == kRemovedVertex) continue;
        closed.own[numbers[v]] = own[v];
        if (v < before.vertex_count()) closed.part.former[numbers[v]] = v;
    }
    return closed;
}

Closed closed_at_last(const ContactZone& zone, const TwinTubes& twins, ContactBridge& bridge) {
    for (int attempt = 1;; ++attempt) {
        widen_bridge(zone, twins, bridge);
        try {
            return closed_holes(zone, twins, bridge);
        } catch (const AlgorithmFailure&) {
            if (attempt == kAttempts) refuse_parting(bridge.centre);
        }
    }
}

/// Smooth minimum, at most the smaller one. Source: Quilez, "Smooth minimum", 2013.
double soft_minimum(double a, double b, double width) {
    const double near = std::max(0.0, width - std::abs(a - b)) / width;
    return std::min(a, b) - 0.25 * width * near * near;
}

/// Keeps each wall on its side.
class Sides {
public:
    explicit Sides(const TwinTubes& twins)
        : twins_(twins), charts_{chart_tube(twins.tubes[0]), chart_tube(twins.tubes[1])} {}

    /// The place of a wall's point that keeps `slab` between the tubes' heights [mm].
    /// \return none: it stays
    [[nodiscard]] std::optional<Vec3> receded(const Vec3& x, std::size_t own, double slab) const {
        const double soft = kSoft * slab;
        if (room(x, own) > slab + 2.0 * soft) return std::nullopt;
        const TubeCoordinates at = charts_[own].coordinates(x);
        double low = -0.9 * at.radius, high = at.height + soft;
        const auto place = [&](double height) {
            return charts_[own].position(at.along, at.angle, height);
        };
        if (room(place(high), own) >= slab) return std::nullopt;
        constexpr int kHalvings = 40;
        for (int i = 0; i < kHalvings; ++i) {
            const double middle = 0.5 * (low + high);
            (room(place(middle), own) >= slab ? low : high) = middle;
        }
        const double height = soft_minimum(at.height, low, soft);
        if (height < -kDeepest * at.radius) return x * std::numeric_limits<double>::quiet_NaN();
        return place(height);
    }

private:
    /// By how much nearer a point is to its own tube than to the other one [mm].
    [[nodiscard]] double room(const Vec3& x, std::size_t own) const {
        return twins_.tubes[1 - own].height(x) - twins_.tubes[own].height(x);
    }

    const TwinTubes& twins_;
    std::array<Tube, 2> charts_;
};

SurfaceGap gap_between(const Surface& both, const std::vector<std::uint8_t>& own) {
    std::array<std::vector<std::uint8_t>, 2> marked;
    for (auto& each : marked) each.assign(both.triangle_count(), 0);
    for (TriangleId t = 0; t < both.triangle_count(); ++t)
        marked[own[both.triangles()[t][0]]][t] = 1;
    return smallest_gap(part_of(both, marked[0]).surface, part_of(both, marked[1]).surface);
}

/// The closed walls with their vertices moved. \return none: a wall would recede too far
std::optional<EditedPart> receded(const Closed& closed, const Sides& sides, double slab,
                                  const std::vector<std::uint8_t>& fixed) {
    EditedPart part = closed.part;
    Positions points = part.surface.points();
    for (VertexId v = 0; v < points.size(); ++v) {
        const auto to = sides.receded(points[v], closed.own[v], slab);
        if (!to || (part.former[v] != kNewVertex && fixed[part.former[v]])) continue;
        if (!to->allFinite()) return std::nullopt;
        points[v] = *to;
        part.former[v] = kNewVertex;
    }
    part.surface = part.surface.with_positions(std::move(points));
    return part;
}

double farthest_from(const Surface& before, const EditedPart& part) {
    const SurfaceDistance wall(before);
    double farthest = 0.0;
    for (VertexId v = 0; v < part.former.size(); ++v)
        if (part.former[v] == kNewVertex)
            farthest = std::max(farthest, wall.closest_point(part.surface.points()[v]).distance);
    return farthest;
}

}  // namespace

TwinWalls twin_walls(const ContactZone& zone, const TwinTubes& twins, ContactBridge bridge,
                     double gap, const Progress& progress) {
    const Closed closed = closed_at_last(zone, twins, bridge);
    const Sides sides(twins);
    double slab = gap, reached = 0.0;
    Vec3 narrow = bridge.centre;
    for (int round = 0; round < kRounds; ++round) {
        progress.check_cancelled();
        auto part = receded(closed, sides, slab, zone.part.rim);
        if (!part) break;
        const SurfaceGap nearest = gap_between(part->surface, closed.own);
        if (nearest.distance >= gap) {
            const double farthest = farthest_from(zone.part.surface, *part);
            return {std::move(*part), nearest.distance, farthest};
        }
        if (nearest.distance > reached) {
            reached = nearest.distance;
            narrow = 0.5 * (nearest.from + nearest.to);
        }
        slab += kOvershoot * (gap - nearest.distance);
    }
    if (reached <= 0.0) refuse("separate-gap", "separate", narrow, {{"gap_mm", gap}}, {});
    refuse("separate-gap", "separate", narrow, {{"gap_mm", gap}, {"reached_mm", reached}},
           {{.arguments = {{"gap", formatted(0.9 * reached, "%.2g")}}}});
}

}  // namespace vesselbench
