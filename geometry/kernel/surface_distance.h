#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "geometry/kernel/derived_cache.h"
#include "geometry/kernel/surface.h"

namespace vesselbench {

struct DistanceTree;

/// A point on a surface.
struct SurfacePoint {
    Vec3 point = Vec3::Zero();  ///< [mm]
    TriangleId triangle = 0;
    double distance = std::numeric_limits<double>::infinity();  ///< from the query [mm]
};

/// An intersection of a ray with a surface.
struct SurfaceHit {
    Vec3 point = Vec3::Zero();  ///< [mm]
    TriangleId triangle = 0;
    double distance = 0.0;     ///< along the ray [mm]
    bool from_inside = false;  ///< the ray meets the triangle's inner side
};

/// Distances, rays and inside tests on a surface: build once, query often, from any thread. Copies
/// share the tree. Works on any triangles; the inside test is exact for closed outward surfaces and
/// sensible for surfaces with openings. Equal distances resolve to the lowest triangle index.
class SurfaceDistance {
public:
    /// Copies the data it needs. \throw InvalidInput if the surface has no triangle
    explicit SurfaceDistance(const Surface& surface);
    SurfaceDistance(const Positions& positions, std::span<const Triangle> triangles);

    [[nodiscard]] SurfacePoint closest_point(const Vec3& p) const;

    /// None if nothing lies within `reach` [mm]; faster for smaller `reach`.
    [[nodiscard]] std::optional<SurfacePoint> closest_point(const Vec3& p, double reach) const;

    /// First intersection of the ray from `origin` along `direction` (any length but 0), at most
    /// `reach` [mm] away. Triangles through the origin itself count (distance 0).
    [[nodiscard]] std::optional<SurfaceHit> first_hit(
        const Vec3& origin, const Vec3& direction,
        double reach = std::numeric_limits<double>::infinity()) const;

    /// All intersections, by distance.
    [[nodiscard]] std::vector<SurfaceHit> all_hits(
        const Vec3& origin, const Vec3& direction,
        double reach = std::numeric_limits<double>::infinity()) const;

    /// Winding number of the surface around p: 1 inside, 0 outside a closed outward surface; in
    /// between near openings.
    /// Source: Jacobson et al., "Robust inside-outside segmentation using generalized winding
    /// numbers", SIGGRAPH 2013; distant parts by their dipole as in Barill et al., "Fast winding
    /// numbers for soups and clouds", SIGGRAPH 2018.
    [[nodiscard]] double winding_number(const Vec3& p) const;

    [[nodiscard]] bool inside(const Vec3& p) const { return winding_number(p) > 0.5; }

    /// Distance [mm], negative inside.
    [[nodiscard]] double signed_distance(const Vec3& p) const;

    /// Triangles within `radius` [mm] of `centre`, ascending.
    [[nodiscard]] std::vector<TriangleId> triangles_within(const Vec3& centre, double radius) const;

    /// The same for many points, in parallel; results in the order of the points.
    [[nodiscard]] std::vector<SurfacePoint> closest_points(std::span<const Vec3> points) const;
    [[nodiscard]] std::vector<double> signed_distances(std::span<const Vec3> points) const;

    /// The tree, for searches elsewhere; it lives as long as this object.
    [[nodiscard]] const DistanceTree& tree() const;

    /// Memory [bytes].
    [[nodiscard]] std::size_t bytes() const;

private:
    struct Data;
    std::shared_ptr<const Data> data_;
};

/// The same as SurfaceDistance(surface), but taken from the cache, or built and kept there. For
/// surfaces that live on; a short-lived one would only evict others.
/// \throw InvalidInput if the surface has no triangle
[[nodiscard]] SurfaceDistance distance_to(const Surface& surface,
                                          DerivedCache& cache = derived_cache());
[[nodiscard]] SurfaceDistance distance_to(const Positions& positions,
                                          std::span<const Triangle> triangles,
                                          DerivedCache& cache = derived_cache());

/// The point of triangle a, b, c nearest to p.
/// Source: Ericson, "Real-Time Collision Detection", 2005, section 5.1.5.
[[nodiscard]] Vec3 closest_point_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b,
                                             const Vec3& c);

}  // namespace vesselbench
