#include "geometry/vessel/sac/sac_measures.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include "geometry/kernel/wording.h"

namespace vesselbench {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Hull = CGAL::Surface_mesh<Kernel::Point_3>;

/// Sections of a sac that are compared for its width.
constexpr int kSections = 100;
/// From here on a neck is in doubt: neck_diameter / neck_hydraulic, 1 for a circle [-].
constexpr double kUnroundNeck = 1.2;
/// The same: length / height, 1 if the dome is above the neck's middle [-].
constexpr double kWallBeside = 1.3;

/// The points of the outline twice, as ends of its segments: the mean over its length.
double mean_distance(const Positions& outline, const Vec3& centre) {
    double sum = 0.0, length = 0.0;
    for (std::size_t i = 0; i + 1 < outline.size(); i += 2) {
        const double edge = (outline[i + 1] - outline[i]).norm();
        sum += edge * (0.5 * (outline[i] + outline[i + 1]) - centre).norm();
        length += edge;
    }
    return sum / length;
}

Hull hull_of(const Positions& points) {
    std::vector<Kernel::Point_3> corners;
    corners.reserve(points.size());
    for (const Vec3& x : points) corners.emplace_back(x.x(), x.y(), x.z());
    Hull hull;
    CGAL::convex_hull_3(corners.begin(), corners.end(), hull);
    return hull;
}

Positions corners_of(const Hull& hull) {
    Positions corners;
    for (const auto v : hull.vertices()) {
        const auto& x = hull.point(v);
        corners.emplace_back(x.x(), x.y(), x.z());
    }
    return corners;
}

/// A face's corners from the least one on, relative to the neck's point: the hull's own order
/// depends on what else was computed.
Positions corners_of(const Hull& hull, Hull::Face_index face, const Plane& neck) {
    Positions x;
    for (const auto v : CGAL::vertices_around_face(hull.halfedge(face), hull)) {
        const auto& p = hull.point(v);
        x.emplace_back(p.x() - neck.point.x(), p.y() - neck.point.y(), p.z() - neck.point.z());
    }
    const auto before = [](const Vec3& a, const Vec3& b) {
        return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
    };
    std::rotate(x.begin(), std::min_element(x.begin(), x.end(), before), x.end());
    return x;
}

/// The same bits in whatever order the parts come.
double sorted_sum(std::vector<double> parts) {
    std::sort(parts.begin(), parts.end());
    return std::accumulate(parts.begin(), parts.end(), 0.0);
}

/// Volume and area without the faces in the neck's plane, from which volumes are measured.
std::pair<double, double> hull_measures(const Hull& hull, const Plane& neck, double size) {
    std::vector<double> volumes, areas;
    for (const auto face : hull.faces()) {
        const Positions x = corners_of(hull, face, neck);
        const bool in_neck = std::all_of(x.begin(), x.end(), [&](const Vec3& p) {
            return std::abs(neck.normal.dot(p)) < 1e-9 * size;
        });
        if (in_neck) continue;
        volumes.push_back(x[0].dot(x[1].cross(x[2])) / 6.0);
        areas.push_back(0.5 * (x[1] - x[0]).cross(x[2] - x[0]).norm());
    }
    return {sorted_sum(std::move(volumes)), sorted_sum(std::move(areas))};
}

/// 0 for a hemisphere on its neck [Raghavan].
double off_hemisphere(double volume, double area) {
    return 1.0 - std::cbrt(18.0 * std::numbers::pi) * std::cbrt(volume * volume) / area;
}

double largest_distance(const Positions& points) {
    double squared = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i)
        for (std::size_t k = i + 1; k < points.size(); ++k)
            squared = std::max(squared, (points[i] - points[k]).squaredNorm());
    return std::sqrt(squared);
}

/// The widest of the sections parallel to the neck: hydraulic diameter and distance [mm].
std::pair<double, double> widest_section(const SacPart& sac, double height) {
    const Surface wall = make_surface(sac.points, sac.triangles);
    std::pair<double, double> widest{4.0 * sac.neck_area / sac.neck_perimeter, 0.0};
    for (int i = 1; i < kSections; ++i) {
        const double z = height * i / kSections;
        const Plane plane{sac.neck.point + z * sac.neck.normal, sac.neck.normal};
        for (const SectionCurve& curve : cross_sections(wall, plane))
            if (curve.closed)
                if (const double d = 4.0 * std::abs(curve.area) / curve.perimeter; d > widest.first)
                    widest = {d, z};
    }
    return widest;
}

}  // namespace

SacMeasures measure_sac(const SacPart& sac, double parent_diameter) {
    SacMeasures m{.dome_area = sac.wall_area,
                  .neck_area = sac.neck_area,
                  .volume = sac.volume,
                  .parent_diameter = parent_diameter};
    m.neck_diameter = 2.0 * mean_distance(sac.outline, sac.neck_centroid);
    m.neck_hydraulic = 4.0 * sac.neck_area / sac.neck_perimeter;
    for (const Vec3& x : sac.points) {
        m.height = std::max(m.height, sac.neck.distance(x));
        m.length = std::max(m.length, (x - sac.neck_centroid).norm());
    }
    const Hull hull = hull_of(sac.points);
    m.neck_width = largest_distance(sac.outline);
    m.diameter = largest_distance(corners_of(hull));
    double widest_at = 0.0;
    std::tie(m.width, widest_at) = widest_section(sac, m.height);
    m.aspect_ratio = m.height / m.neck_diameter;
    m.size_ratio = parent_diameter > 0.0 ? m.length / parent_diameter : 0.0;
    m.bottleneck_factor = m.width / m.neck_hydraulic;
    m.bulge_location = widest_at / m.height;
    const auto [hull_volume, hull_area] = hull_measures(hull, sac.neck, m.length);
    m.undulation = 1.0 - m.volume / hull_volume;
    m.ellipticity = off_hemisphere(hull_volume, hull_area);
    m.nonsphericity = off_hemisphere(m.volume, m.dome_area);
    return m;
}

bool neck_in_doubt(const SacMeasures& m) {
    return !why_neck_in_doubt(m).empty();
}

std::string why_neck_in_doubt(const SacMeasures& m) {
    std::vector<std::string> reasons;
    if (m.neck_diameter > kUnroundNeck * m.neck_hydraulic)
        reasons.emplace_back("its outline is long for its area");
    if (m.length > kWallBeside * m.height) reasons.emplace_back("wall lies far beside it");
    return enumerated(reasons);
}

}  // namespace vesselbench
