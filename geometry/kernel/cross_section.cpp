#include "geometry/kernel/cross_section.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <utility>

namespace vesselbench {

namespace {

using EdgeKey = std::uint64_t;

EdgeKey directed(VertexId from, VertexId to) {
    return static_cast<EdgeKey>(from) << 32 | to;
}

/// A triangle crossed by the plane: the curve enters over the half-edge from above to below, and
/// leaves over the one from below to above.
struct Crossed {
    EdgeKey entry = 0;  ///< above -> below
    EdgeKey exit = 0;   ///< below -> above; as the neighbour sees it: above -> below
    TriangleId triangle = 0;
};

std::vector<Crossed> crossed_triangles(const Surface& surface, const Plane& plane) {
    const Positions& points = surface.points();
    std::vector<std::uint8_t> above(points.size());
    for (std::size_t v = 0; v < points.size(); ++v) above[v] = plane.distance(points[v]) >= 0.0;
    std::vector<Crossed> crossed;
    const auto triangles = surface.triangles();
    for (TriangleId t = 0; t < triangles.size(); ++t) {
        const auto& [a, b, c] = triangles[t];
        if (above[a] == above[b] && above[b] == above[c]) continue;
        Crossed found{.triangle = t};
        for (int k = 0; k < 3; ++k) {
            const VertexId from = triangles[t][k], to = triangles[t][(k + 1) % 3];
            if (above[from] && !above[to]) found.entry = directed(from, to);
            if (!above[from] && above[to]) found.exit = directed(to, from);
        }
        crossed.push_back(found);
    }
    return crossed;
}

/// Finds the unused crossed triangle that the curve enters over a half-edge.
class Entries {
public:
    explicit Entries(const std::vector<Crossed>& crossed) : used_(crossed.size(), 0) {
        for (std::size_t i = 0; i < crossed.size(); ++i) {
            entries_.emplace_back(crossed[i].entry, i);
            exits_.push_back(crossed[i].exit);
        }
        std::sort(entries_.begin(), entries_.end());
        std::sort(exits_.begin(), exits_.end());
    }

    std::optional<std::size_t> take(EdgeKey entry) {
        auto it =
            std::lower_bound(entries_.begin(), entries_.end(), std::pair(entry, std::size_t{0}));
        for (; it != entries_.end() && it->first == entry; ++it)
            if (take_index(it->second)) return it->second;
        return std::nullopt;
    }

    bool take_index(std::size_t index) { return std::exchange(used_[index], 1) == 0; }

    /// No triangle leads to this entry: an open curve starts here.
    bool starts_curve(EdgeKey entry) const {
        return !std::binary_search(exits_.begin(), exits_.end(), entry);
    }

private:
    std::vector<std::pair<EdgeKey, std::size_t>> entries_;
    std::vector<EdgeKey> exits_;
    std::vector<std::uint8_t> used_;
};

void add_crossing(SectionCurve& curve, EdgeKey edge, const Positions& points, const Plane& plane) {
    const auto above = static_cast<VertexId>(edge >> 32), below = static_cast<VertexId>(edge);
    const double up = plane.distance(points[above]), down = -plane.distance(points[below]);
    const double t = down / (up + down);
    curve.crossings.push_back({below, above, t});
    curve.points.push_back(plane.projected((1.0 - t) * points[below] + t * points[above]));
}

void measure(SectionCurve& curve, const Plane& plane) {
    const Vec3 origin = curve.points.front();
    Vec3 moment = Vec3::Zero();
    const std::size_t n = curve.points.size();
    for (std::size_t i = 0; i < n; ++i) {
        const Vec3 p = curve.points[i] - origin, q = curve.points[(i + 1) % n] - origin;
        const double part = 0.5 * plane.normal.dot(p.cross(q));
        curve.area += part;
        moment += part * (p + q) / 3.0;
        if (i + 1 < n || curve.closed) curve.perimeter += (q - p).norm();
    }
    const bool thin = std::abs(curve.area) < 1e-12 * curve.perimeter * curve.perimeter;
    curve.centroid = origin;
    if (!thin) {
        curve.centroid += moment / curve.area;
        return;
    }
    for (const Vec3& p : curve.points) curve.centroid += (p - origin) / static_cast<double>(n);
}

double distance_to_curve(const SectionCurve& curve, const Vec3& x) {
    double best = std::numeric_limits<double>::infinity();
    const std::size_t n = curve.points.size();
    for (std::size_t i = 0; i + (curve.closed ? 0 : 1) < n; ++i) {
        const Vec3 &p = curve.points[i], edge = curve.points[(i + 1) % n] - p;
        const double squared = edge.squaredNorm();
        const double t = squared > 0.0 ? std::clamp(edge.dot(x - p) / squared, 0.0, 1.0) : 0.0;
        best = std::min(best, (p + t * edge - x).norm());
    }
    return best;
}

}  // namespace

double SectionCurve::diameter() const {
    return 2.0 * std::sqrt(std::abs(area) / std::numbers::pi);
}

std::vector<SectionCurve> cross_sections(const Surface& surface, const Plane& plane) {
    const auto crossed = crossed_triangles(surface, plane);
    Entries entries(crossed);
    std::vector<SectionCurve> curves;
    const auto trace = [&](std::size_t start) {
        SectionCurve curve;
        std::optional<std::size_t> at = start;
        EdgeKey exit = 0;
        while (at) {
            add_crossing(curve, crossed[*at].entry, surface.points(), plane);
            curve.triangles.push_back(crossed[*at].triangle);
            exit = crossed[*at].exit;
            at = entries.take(exit);
        }
        curve.closed = exit == crossed[start].entry;
        if (!curve.closed) add_crossing(curve, exit, surface.points(), plane);
        measure(curve, plane);
        curves.push_back(std::move(curve));
    };
    for (std::size_t i = 0; i < crossed.size(); ++i)
        if (entries.starts_curve(crossed[i].entry) && entries.take_index(i)) trace(i);
    for (std::size_t i = 0; i < crossed.size(); ++i)
        if (entries.take_index(i)) trace(i);
    const auto lowest = [](const SectionCurve& c) {
        return *std::min_element(c.triangles.begin(), c.triangles.end());
    };
    std::stable_sort(curves.begin(), curves.end(),
                     [&](const auto& a, const auto& b) { return lowest(a) < lowest(b); });
    return curves;
}

bool encloses(const SectionCurve& curve, const Plane& plane, const Vec3& point) {
    const auto [u, v] = plane_axes(plane.normal);
    bool inside = false;
    const std::size_t n = curve.points.size();
    for (std::size_t i = 0, j = n - 1; i < n; j = i++) {
        const Vec3 p = curve.points[i] - point, q = curve.points[j] - point;
        const double pv = v.dot(p), qv = v.dot(q);
        if ((pv > 0.0) == (qv > 0.0)) continue;
        if (u.dot(p) + (u.dot(q) - u.dot(p)) * pv / (pv - qv) > 0.0) inside = !inside;
    }
    return inside;
}

std::optional<SectionCurve> cross_section_at(const Surface& surface, const Plane& plane) {
    auto curves = cross_sections(surface, plane);
    const SectionCurve* best = nullptr;
    for (const auto& curve : curves)
        if (curve.closed && encloses(curve, plane, plane.point) &&
            (best == nullptr || std::abs(curve.area) < std::abs(best->area)))
            best = &curve;
    if (best != nullptr) return *best;
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& curve : curves)
        if (const double d = distance_to_curve(curve, plane.point); d < nearest) {
            nearest = d;
            best = &curve;
        }
    return best == nullptr ? std::nullopt : std::optional(*best);
}

std::pair<Vec3, Vec3> plane_axes(const Vec3& normal) {
    int smallest = 0;
    normal.cwiseAbs().minCoeff(&smallest);
    const Vec3 u = normal.cross(Vec3::Unit(smallest)).normalized();
    return {u, normal.cross(u)};
}

}  // namespace vesselbench
