#pragma once

#include <optional>
#include <vector>

#include "geometry/kernel/surface.h"

namespace vesselbench {

struct Plane {
    Vec3 point = Vec3::Zero();    ///< [mm]
    Vec3 normal = Vec3::UnitZ();  ///< of length 1

    /// Signed distance [mm], positive on the normal's side.
    [[nodiscard]] double distance(const Vec3& x) const { return normal.dot(x - point); }

    [[nodiscard]] Vec3 projected(const Vec3& x) const { return x - distance(x) * normal; }
};

/// The point where a section meets an edge of the surface: (1 - t) below + t above.
struct SectionCrossing {
    VertexId below = 0;  ///< signed distance < 0
    VertexId above = 0;  ///< signed distance >= 0
    double t = 0.0;      ///< [-], in (0, 1]
};

/// One connected curve of intersection of a plane and a surface. On an outward surface, the outline
/// of a vessel runs counter-clockwise around the normal.
struct SectionCurve {
    Positions points;                        ///< [mm]; not repeated at the end
    std::vector<SectionCrossing> crossings;  ///< of each point
    std::vector<TriangleId> triangles;       ///< triangle i leads from points[i] to points[i + 1]
    bool closed = false;                     ///< false: it ends at the surface's border
    double area = 0.0;             ///< [mm^2], signed, of the curve closed by a straight line
    double perimeter = 0.0;        ///< [mm]
    Vec3 centroid = Vec3::Zero();  ///< of the enclosed area [mm]

    /// Diameter of the circle of the same area [mm].
    [[nodiscard]] double diameter() const;
};

/// All curves of intersection of the plane and the surface, in the order of their lowest triangle.
/// A vertex in the plane counts as above it, so every curve is simple.
[[nodiscard]] std::vector<SectionCurve> cross_sections(const Surface& surface, const Plane& plane);

/// True if a point of the plane lies inside the curve.
[[nodiscard]] bool encloses(const SectionCurve& curve, const Plane& plane, const Vec3& point);

/// The vessel's section at the plane's point: the smallest closed curve that encloses it; if there
/// is none, the curve nearest to it. Empty if the plane misses the surface.
[[nodiscard]] std::optional<SectionCurve> cross_section_at(const Surface& surface,
                                                           const Plane& plane);

/// Two unit vectors perpendicular to the normal and to each other: (u, v, normal) is
/// right-handed.
[[nodiscard]] std::pair<Vec3, Vec3> plane_axes(const Vec3& normal);

}  // namespace vesselbench
