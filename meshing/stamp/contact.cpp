#include "meshing/stamp/contact.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "geometry/editing/local_part.h"
#include "geometry/kernel/cross_section.h"

namespace vesselbench {

namespace {

constexpr int kDirections = 120;      ///< tried of the half sphere: 15 degrees apart
constexpr double kFarthest = 4.0;     ///< of the way across the lumen: what is looked at [-]
constexpr double kFinestTurn = 0.01;  ///< [rad]
constexpr double kWider = 1.5;  ///< sections beside a waist are larger by this [-]: what narrows
                                ///< less between two wide places may be a vessel of its own
/// Where that is asked, in square roots of its area [-]: a bridge may be longer than wide.
constexpr std::array kBeside = {0.6, 1.0, 1.6};

/// Evenly over the half sphere. Source: Fibonacci lattice, Gonzalez, "Measurement of areas on a
/// sphere using Fibonacci and latitude-longitude lattices", 2010.
std::vector<Vec3> half_sphere() {
    std::vector<Vec3> directions;
    for (int i = 0; i < kDirections; ++i) {
        const double z = (i + 0.5) / kDirections;
        const double angle = std::numbers::pi * (3.0 - std::sqrt(5.0)) * i;
        const double r = std::sqrt(1.0 - z * z);
        directions.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
    }
    return directions;
}

/// The smallest closed section around the plane's point.
std::optional<SectionCurve> section_around(const Surface& part, const Plane& plane) {
    std::optional<SectionCurve> smallest;
    for (const SectionCurve& curve : cross_sections(part, plane))
        if (curve.closed && curve.area > 0.0 && encloses(curve, plane, plane.point) &&
            (!smallest || curve.area < smallest->area))
            smallest = curve;
    return smallest;
}

struct Waist {
    Plane plane;
    SectionCurve curve;
};

/// Turned and slid by steps that get shorter, as long as the section gets smaller.
void improve(const Surface& part, Waist& waist) {
    const double first = std::numbers::pi / 12.0;
    for (double turn = first; turn > kFinestTurn; turn *= 0.5) {
        bool better = true;
        for (int round = 0; better && round < 8; ++round) {
            better = false;
            const auto [x, y] = plane_axes(waist.plane.normal);
            const double slide = 0.5 * turn * std::sqrt(waist.curve.area);
            const Vec3 normal = waist.plane.normal, centre = waist.curve.centroid;
            for (const auto& [direction, step] : {std::pair(Vec3(normal + turn * x), 0.0),
                                                  {Vec3(normal - turn * x), 0.0},
                                                  {Vec3(normal + turn * y), 0.0},
                                                  {Vec3(normal - turn * y), 0.0},
                                                  {normal, slide},
                                                  {normal, -slide}}) {
                const Plane plane{centre + step * normal, direction.normalized()};
                auto curve = section_around(part, plane);
                if (!curve || curve->area >= 0.999 * waist.curve.area) continue;
                waist = {plane, std::move(*curve)};
                better = true;
            }
        }
    }
}

/// Both sides of a waist are wider lumen; a section that is open there belongs to something wide.
bool is_waist(const Surface& part, const SurfaceDistance& places, const Waist& waist) {
    const auto is_wide = [&](double aside) {
        const Plane plane{
            waist.curve.centroid + aside * std::sqrt(waist.curve.area) * waist.plane.normal,
            waist.plane.normal};
        const auto curve = section_around(part, plane);
        return curve ? curve->area > kWider * waist.curve.area : places.inside(plane.point);
    };
    return std::ranges::all_of(std::array{-1.0, 1.0}, [&](double side) {
        return std::ranges::any_of(kBeside, [&](double aside) { return is_wide(side * aside); });
    });
}

/// So that the same contact has the same direction, from whichever side it is found.
Vec3 pointing_up(const Vec3& direction) {
    constexpr double kLevel = 1e-6;
    for (int axis = 2; axis >= 0; --axis)
        if (std::abs(direction[axis]) > kLevel)
            return direction[axis] > 0.0 ? direction : -direction;
    return direction;
}

Contact contact_of(const Waist& waist) {
    Contact contact{.centre = waist.curve.centroid,
                    .direction = pointing_up(waist.plane.normal),
                    .area = waist.curve.area};
    const auto [x, y] = plane_axes(contact.direction);
    Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
    for (const Vec3& p : waist.curve.points) {
        const Eigen::Vector2d at((p - contact.centre).dot(x), (p - contact.centre).dot(y));
        spread += at * at.transpose();
    }
    const Eigen::Vector2d longest =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(spread).eigenvectors().col(1);
    contact.along = pointing_up(longest[0] * x + longest[1] * y);
    const Vec3 across = contact.direction.cross(contact.along);
    const auto extent = [&](const Vec3& axis) {
        double farthest = 0.0;
        for (const Vec3& p : waist.curve.points)
            farthest = std::max(farthest, std::abs((p - contact.centre).dot(axis)));
        return 2.0 * farthest;
    };
    contact.length = extent(contact.along);
    contact.width = extent(across);
    return contact;
}

}  // namespace

std::optional<Contact> contact_at(const Surface& surface, const SurfaceDistance& places,
                                  const Vec3& point) {
    const SurfacePoint at = places.closest_point(point);
    const Vec3 inward = -area_normal(surface.points(), surface.triangles()[at.triangle]);
    if (!(inward.norm() > 0.0)) return std::nullopt;
    const Vec3 direction = inward.normalized();
    const double skin = 1e-6 * (1.0 + at.point.norm());
    const auto opposite = places.first_hit(at.point + skin * direction, direction);
    if (!opposite) return std::nullopt;
    const Vec3 middle = 0.5 * (at.point + opposite->point);
    const double farthest = kFarthest * (opposite->point - at.point).norm();
    std::vector<std::uint8_t> marked(surface.triangle_count(), 0);
    for (const TriangleId t : places.triangles_within(middle, farthest)) marked[t] = 1;
    const Surface part = part_of(surface, marked).surface;
    std::optional<Waist> waist;
    for (const Vec3& normal : half_sphere()) {
        auto curve = section_around(part, {middle, normal});
        if (curve && (!waist || curve->area < waist->curve.area))
            waist = Waist{{middle, normal}, std::move(*curve)};
    }
    if (!waist) return std::nullopt;
    improve(part, *waist);
    if (!is_waist(part, places, *waist)) return std::nullopt;
    return contact_of(*waist);
}

}  // namespace vesselbench
