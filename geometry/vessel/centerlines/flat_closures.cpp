#include "geometry/vessel/centerlines/flat_closures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <tuple>

#include "geometry/kernel/surface_distance.h"

namespace vesselbench {
namespace {

constexpr double kPlane = 0.9994;     ///< cosine of 2 degrees: normals of one plane
constexpr double kRim = 0.77;         ///< cosine of 40 degrees: the wall turns away by more
constexpr double kSharpRim = 0.9;     ///< fraction of the rim that must be sharp
constexpr double kRoundness = 0.6;    ///< 4 pi area / perimeter^2 of a disc; an ellipse of 1 : 2.4
constexpr double kWidestLumen = 1.4;  ///< distance to the wall two radii behind it, in radii
constexpr double kMostFlat = 0.3;  ///< fraction of the area; with more, the surface is not a vessel

constexpr TriangleId kNone = static_cast<TriangleId>(-1);

/// The triangle across each of a triangle's edges; kNone unless there is exactly one.
std::vector<std::array<TriangleId, 3>> neighbours_of(std::span<const Triangle> triangles) {
    struct Side {
        VertexId a, b;
        TriangleId triangle;
        std::uint8_t edge;
    };

    std::vector<Side> sides;
    for (TriangleId t = 0; t < triangles.size(); ++t) {
        for (std::uint8_t k = 0; k < 3; ++k) {
            const auto [a, b] = std::minmax(triangles[t][k], triangles[t][(k + 1U) % 3]);
            sides.push_back({a, b, t, k});
        }
    }
    std::sort(sides.begin(), sides.end(), [](const Side& x, const Side& y) {
        return std::tie(x.a, x.b, x.triangle, x.edge) < std::tie(y.a, y.b, y.triangle, y.edge);
    });
    std::vector<std::array<TriangleId, 3>> near(triangles.size(), {kNone, kNone, kNone});
    for (std::size_t i = 0; i < sides.size();) {
        std::size_t end = i;
        while (end < sides.size() && sides[end].a == sides[i].a && sides[end].b == sides[i].b) {
            ++end;
        }
        if (end - i == 2) {
            near[sides[i].triangle][sides[i].edge] = sides[i + 1].triangle;
            near[sides[i + 1].triangle][sides[i + 1].edge] = sides[i].triangle;
        }
        i = end;
    }
    return near;
}

/// Finds planar regions and classifies them.
class Search {
public:
    Search(const Positions& points, std::span<const Triangle> triangles)
        : points_(points), triangles_(triangles), near_(neighbours_of(triangles)) {
        for (const Triangle& t : triangles) {
            const Vec3 a = 0.5 * (points[t[1]] - points[t[0]]).cross(points[t[2]] - points[t[0]]);
            areas_.push_back(a.norm());
            normals_.push_back(a.norm() > 0.0 ? Vec3(a.normalized()) : Vec3(Vec3::Zero()));
        }
    }

    /// The planar region around a triangle; its triangles are marked as used.
    std::vector<TriangleId> grow(TriangleId seed, std::vector<bool>& taken) const {
        std::vector<TriangleId> region{seed};
        taken[seed] = true;
        for (std::size_t i = 0; i < region.size(); ++i) {
            for (const TriangleId t : near_[region[i]]) {
                if (t == kNone || taken[t]) continue;
                if (areas_[t] > 0.0 && normals_[t].dot(normals_[seed]) < kPlane) continue;
                taken[t] = true;
                region.push_back(t);
            }
        }
        std::sort(region.begin(), region.end());
        return region;
    }

    bool closes_vessel(const std::vector<TriangleId>& region,
                       const SurfaceDistance& surface) const {
        double area = 0.0;
        Vec3 normal = Vec3::Zero();
        Vec3 centre = Vec3::Zero();
        for (const TriangleId t : region) {
            area += areas_[t];
            normal += areas_[t] * normals_[t];
            for (const VertexId v : triangles_[t]) centre += areas_[t] / 3.0 * points_[v];
        }
        centre /= area;
        normal.normalize();
        double rim = 0.0;
        double sharp = 0.0;
        for (const TriangleId t : region) {
            for (std::size_t k = 0; k < 3; ++k) {
                const TriangleId other = near_[t][k];
                if (other != kNone && std::binary_search(region.begin(), region.end(), other)) {
                    continue;
                }
                const double length =
                    (points_[triangles_[t][(k + 1) % 3]] - points_[triangles_[t][k]]).norm();
                rim += length;
                if (other != kNone && normals_[other].dot(normal) < kRim) sharp += length;
            }
        }
        if (sharp < kSharpRim * rim) return false;
        if (4.0 * std::numbers::pi * area < kRoundness * rim * rim) return false;
        const double radius = std::sqrt(area / std::numbers::pi);
        const double behind = surface.closest_point(centre - 2.0 * radius * normal).distance;
        return behind < kWidestLumen * radius && surface.inside(centre - radius * normal);
    }

    double area(const std::vector<TriangleId>& region) const {
        double sum = 0.0;
        for (const TriangleId t : region) sum += areas_[t];
        return sum;
    }

    double whole_area() const {
        double sum = 0.0;
        for (const double a : areas_) sum += a;
        return sum;
    }

private:
    const Positions& points_;
    std::span<const Triangle> triangles_;
    std::vector<std::array<TriangleId, 3>> near_;
    std::vector<double> areas_;
    Positions normals_;
};

}  // namespace

std::vector<std::vector<TriangleId>> find_flat_closures(const Positions& points,
                                                        std::span<const Triangle> triangles,
                                                        const SurfaceDistance& surface) {
    const Search search(points, triangles);
    const double whole = search.whole_area();
    std::vector<bool> taken(triangles.size(), false);
    std::vector<std::vector<TriangleId>> discs;
    double flat = 0.0;
    for (TriangleId t = 0; t < triangles.size(); ++t) {
        if (taken[t]) continue;
        auto region = search.grow(t, taken);
        // A disc has at least as many triangles as a hexagon, and is not tiny.
        if (region.size() < 4 || search.area(region) < 1e-5 * whole) continue;
        if (!search.closes_vessel(region, surface)) continue;
        flat += search.area(region);
        discs.push_back(std::move(region));
    }
    if (flat > kMostFlat * whole) discs.clear();
    return discs;
}

}  // namespace vesselbench
