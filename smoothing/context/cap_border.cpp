#include "smoothing/context/cap_border.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vesselbench {

namespace {

constexpr double kInPlane = 1e-3;   // relative to the edge: neither up nor down
constexpr double kSteep = 1.0;      // drop over run: 45 degrees
constexpr int kSomeRings = 3;       // a voxel's step is one ring long; it is no cap's edge
constexpr double kRimWidth = 2.0;   // in inner radii: 50 Laplace iterations round a rim that far
constexpr double kNearlyAll = 0.9;  // of the border vertices
constexpr double kElongation =
    6.0;  // area by that of the inner circle; a disc cut at 70 degrees: 3

double area_of(const Surface& surface, std::span<const TriangleId> triangles) {
    double doubled = 0.0;
    for (const TriangleId t : triangles)
        doubled += area_normal(surface.points(), surface.triangles()[t]).norm();
    return 0.5 * doubled;
}

}  // namespace

void CapBorder::count_corners(const Area& area, std::span<const TriangleId> triangles) {
    vertices_.resize(3 * triangles.size() + 1);  // and a last write that does not count
    std::size_t found = 0;
    for (const TriangleId t : triangles)
        for (const VertexId v : surface_.triangles()[t]) {
            Corners& corners = corners_[v];
            const bool is_new = corners.area != area.number;
            vertices_[found] = v;
            found += is_new ? 1 : 0;
            corners = {area.number, is_new ? 1 : corners.count + 1};
        }
    vertices_.resize(found);
}

/// Sign of the largest distance along the normal to the neighbours outside the area.
int CapBorder::side_beyond(const Area& area, VertexId v) const {
    double farthest = 0.0, reach = 0.0;
    for (const VertexId u : surface_.topology->rings().row(v)) {
        if (touches(area, u)) continue;
        const Vec3 edge = surface_.points()[u] - surface_.points()[v];
        const double along = edge.dot(area.normal);
        reach = std::max(reach, edge.norm());
        if (std::abs(along) > std::abs(farthest)) farthest = along;
    }
    return std::abs(farthest) <= kInPlane * reach ? 0 : farthest > 0.0 ? 1 : -1;
}

/// Collects the area's border vertices as long as they agree.
/// \return +1 or -1 if the surface leaves the area along or against its normal wherever it leaves
///         its plane; else 0
int CapBorder::common_side(Area& area) const {
    const CompressedRows& rows = surface_.topology->triangles_at();
    int common = 0;
    for (const VertexId v : vertices_) {
        if (corners_[v].count == rows.row(v).size()) continue;
        area.border.push_back(v);
        const int side = side_beyond(area, v);
        if (side != 0 && side == -common) return 0;
        if (side != 0) common = side;
    }
    return common;
}

/// Largest edge-path distance from a vertex of the area to its border [mm].
double CapBorder::inner_radius(const Area& area) {
    std::vector<VertexId> front = area.border;
    for (const VertexId v : front) depth_[v] = 1e-300;  // seen
    double deepest = 0.0;
    for (std::size_t i = 0; i < front.size(); ++i) {
        const VertexId v = front[i];
        deepest = std::max(deepest, depth_[v]);
        for (const VertexId u : surface_.topology->rings().row(v)) {
            if (depth_[u] > 0.0 || !touches(area, u)) continue;
            depth_[u] = depth_[v] + (surface_.points()[u] - surface_.points()[v]).norm();
            front.push_back(u);
        }
    }
    for (const VertexId v : front) depth_[v] = 0.0;
    return deepest;
}

/// Walks from a border vertex away from the area and down (to the given side), ring by ring.
bool CapBorder::drops(const Area& area, VertexId start, int side, double radius) const {
    const Positions& x = surface_.points();
    const CompressedRows& rings = surface_.topology->rings();
    const Vec3 down = static_cast<double>(side) * area.normal;
    Vec3 outward = Vec3::Zero();
    for (const VertexId u : rings.row(start))
        if (!touches(area, u)) outward += x[u] - x[start];
    outward -= outward.dot(down) * down;
    outward.normalize();
    VertexId at = start;
    double way = 0.0;
    for (int ring = 1;; ++ring) {
        VertexId next = at;
        double best = 0.0;
        for (const VertexId u : rings.row(at)) {
            const double gain = (x[u] - x[at]).dot(outward + down);
            if (!(gain > best) || touches(area, u)) continue;
            best = gain;
            next = u;
        }
        way += (x[next] - x[at]).norm();
        at = next;
        const Vec3 passed = x[at] - x[start];
        const double drop = passed.dot(down), run = passed.dot(outward);
        const bool steep = drop > 0.0 && drop >= kSteep * run;
        if (best == 0.0 || (ring >= kSomeRings && (steep || way > kRimWidth * radius)))
            return steep;
    }
}

bool CapBorder::encloses_cap(std::span<const TriangleId> triangles, const Vec3& normal) {
    Area area{++last_area_, normal, {}};
    count_corners(area, triangles);
    const int side = common_side(area);
    if (side == 0) return false;
    const double radius = inner_radius(area);
    if (area_of(surface_, triangles) > kElongation * std::numbers::pi * radius * radius)
        return false;
    const auto dropping = std::count_if(area.border.begin(), area.border.end(),
                                        [&](VertexId v) { return drops(area, v, side, radius); });
    return static_cast<double>(dropping) >= kNearlyAll * static_cast<double>(area.border.size());
}

}  // namespace vesselbench
