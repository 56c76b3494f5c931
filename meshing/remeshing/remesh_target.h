#pragma once

#include <limits>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "geometry/kernel/surface.h"
#include "geometry/kernel/surface_distance.h"
#include "meshing/remeshing/surface_walk.h"

namespace vesselbench {

/// A place on the surface for a remeshed vertex.
struct TargetPlace {
    Vec3 point = Vec3::Zero();   ///< [mm]
    Vec3 normal = Vec3::Zero();  ///< outward unit normal; zero on rims
    double size = 0.0;           ///< target edge length there [mm]
    TriangleId near = kNowhere;  ///< hint for the next search: a triangle, on rims a segment

    static constexpr TriangleId kNowhere = std::numeric_limits<TriangleId>::max();
};

/// The geometry that a remeshed surface must follow: each patch of the input (a flat one exactly in
/// its plane), and the rims between them (a round one exactly on its circle, others on their
/// polyline).
class RemeshTarget {
public:
    /// \param sizes target edge length at each vertex [mm], #V
    RemeshTarget(const Surface& surface, std::span<const double> sizes);

    /// \param sizes target edge length at each vertex [mm], #V
    void set_sizes(std::span<const double> sizes) { sizes_.assign(sizes.begin(), sizes.end()); }

    /// The place of patch `patch` that is closest to x; near a triangle of the patch, the place
    /// reached downhill from it.
    [[nodiscard]] TargetPlace on_patch(std::uint32_t patch, const Vec3& x, TriangleId near) const;

    /// The place of the rim between two patches that is closest to x. A patch number beyond the
    /// table means any hole.
    [[nodiscard]] TargetPlace on_rim(std::uint32_t p, std::uint32_t q, const Vec3& x,
                                     TriangleId near) const;

    /// The outward unit normal of a flat patch; empty for the others.
    [[nodiscard]] std::optional<Vec3> plane_normal(std::uint32_t patch) const;

private:
    struct Plane {
        Vec3 origin, normal;
    };

    struct Circle {
        Vec3 centre, axis;
        double radius;
    };

    struct PatchTarget {
        std::optional<Plane> plane;
        std::vector<TriangleId> triangles;
        std::optional<SurfaceDistance> search;
    };

    struct RimTarget {
        std::vector<Triangle> segments;  ///< {a, b, b}
        std::optional<Circle> circle;
        std::optional<SurfaceDistance> search;
    };

    using RimKey = std::pair<std::uint32_t, std::uint32_t>;

    [[nodiscard]] const Triangle& triangle(TriangleId t) const { return surface_.triangles()[t]; }

    [[nodiscard]] RimKey key(std::uint32_t p, std::uint32_t q) const;
    void find_planes();
    void flatten();
    void find_rims();
    [[nodiscard]] std::optional<Plane> fitted_plane(const PatchTarget& patch) const;
    [[nodiscard]] std::optional<Circle> fitted_circle(const RimTarget& rim, const Vec3& axis) const;
    [[nodiscard]] SurfaceWalk::Place closest_on(std::uint32_t patch, const Vec3& x,
                                                TriangleId near) const;
    [[nodiscard]] SurfacePoint closest_on(const RimTarget& rim, const Vec3& x,
                                          TriangleId near) const;
    [[nodiscard]] double size_at(const Triangle& triangle, const Vec3& weights) const;

    Surface surface_;
    std::vector<double> sizes_;
    Positions normals_;  ///< unit, by triangle
    std::optional<SurfaceWalk> walk_;
    std::vector<PatchTarget> patches_;
    std::map<RimKey, RimTarget> rims_;
};

}  // namespace vesselbench
