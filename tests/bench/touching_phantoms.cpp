#include "tests/bench/touching_phantoms.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "geometry/image/extract_surface.h"
#include "geometry/image/threshold.h"
#include "geometry/kernel/surface_distance.h"
#include "geometry/phantoms/imaging.h"
#include "tests/forest/dice.h"

namespace vesselbench::bench {

namespace {

using forest::Dice;

/// The middle line of a contact: an arc that rises out of its plane, and the direction from one
/// vessel to the other, which turns along it.
struct Course {
    double bend = 0.0;   ///< curvature [1/mm]
    double twist = 0.0;  ///< [rad/mm]
    Vec3 tangent, up;

    [[nodiscard]] Vec3 at(double s) const {
        const Vec3 side = up.cross(tangent);
        if (std::abs(bend) < 1e-9) return s * tangent;
        return std::sin(bend * s) / bend * tangent + (1.0 - std::cos(bend * s)) / bend * side;
    }

    [[nodiscard]] Vec3 direction(double s) const {
        return std::cos(bend * s) * tangent + std::sin(bend * s) * up.cross(tangent);
    }

    [[nodiscard]] Vec3 across(double s) const {
        return Eigen::AngleAxisd(twist * s, direction(s)) * up;
    }
};

/// A vessel beside the course. \param away distance of its axis from the course, signed [mm]
VesselShape beside(const Course& course, double away, double radius, double half, double taper,
                   double leaving) {
    VesselShape shape;
    const double reach = half + 6.5 * radius;
    for (int i = -7; i <= 7; ++i) {
        const double s = reach * i / 7.0;
        const double beyond = std::max(0.0, std::abs(s) - half) / radius;
        const double parting = leaving * radius * beyond * beyond / (1.0 + 0.3 * beyond);
        shape.points.push_back(course.at(s) +
                               (away + std::copysign(parting, away)) * course.across(s));
        shape.radii.push_back(radius * (1.0 + taper * s / reach));
    }
    return shape;
}

/// From the last point of one vessel to the last one of another, around the outside.
VesselShape far_link(const VesselShape& from, const VesselShape& to) {
    VesselShape link;
    const Vec3 p = from.points.back(), q = to.points.back();
    const Vec3 out = (p - from.points[from.points.size() - 2]).normalized() +
                     (q - to.points[to.points.size() - 2]).normalized();
    const double span = (p - q).norm(), radius = std::min(from.radii.back(), to.radii.back());
    for (int i = 0; i <= 4; ++i) {
        const double t = i / 4.0;
        link.points.push_back((1.0 - t) * p + t * q +
                              std::sin(std::numbers::pi * t) * (0.5 * span + 2.0 * radius) *
                                  out.normalized());
        link.radii.push_back((1.0 - t) * from.radii.back() + t * to.radii.back());
    }
    return link;
}

}  // namespace

TouchingPhantom::TouchingPhantom(std::uint64_t number) : seed(number) {
    Dice dice(number);
    const double radius = dice.between(3.0, 6.0) * voxel;
    const double other = radius * dice.between(0.6, 1.0);
    thinner = other;
    const double gap = dice.between(0.1, 1.6) * voxel, waist = dice.between(0.1, 0.85);
    const bool is_long = dice.chance(0.5);
    ring = dice.chance(0.33);
    length = is_long ? dice.between(2.0, 5.0) * 2.0 * other : 0.0;
    Course course{.tangent = dice.direction(), .up = Vec3::Zero()};
    course.up = dice.across(course.tangent);
    course.bend = is_long ? dice.between(-1.0, 1.0) / (8.0 * radius) : 0.0;
    course.twist = is_long ? dice.between(-0.7, 0.7) / length : 0.0;
    const double leaving = dice.between(0.03, 0.12);
    VesselShape a = beside(course, -(radius + 0.5 * gap), radius, 0.5 * length,
                           dice.between(-0.1, 0.1), is_long ? 2.0 * leaving : leaving);
    Course turned = course;
    if (!is_long)
        turned.tangent =
            Eigen::AngleAxisd(dice.between(25.0, 90.0) * std::numbers::pi / 180.0, course.up) *
            course.tangent;
    VesselShape b = beside(turned, other + 0.5 * gap, other, 0.5 * length, dice.between(-0.1, 0.1),
                           is_long ? 2.0 * leaving : leaving);
    const VesselShape link = far_link(a, b);
    vessels_ = {{"a", std::move(a)}, {"b", std::move(b)}};
    if (ring) vessels_.push_back({"link", link});
    VesselShape leak;
    const int steps = is_long ? 6 : 1;
    for (int i = 0; i <= steps; ++i) {
        const double s =
            is_long ? length * (static_cast<double>(i) / steps - 0.5) : 0.02 * other * (2 * i - 1);
        middles_.push_back(course.at(s));
        sides_.push_back(turned.direction(s).cross(course.across(s)).normalized());
        leak.points.push_back(middles_.back());
        leak.radii.push_back(waist * other);
    }
    middle = course.at(0.0);
    sideways = sides_[sides_.size() / 2];
    imaged_.parts = vessels_;
    const bool fillet = dice.chance(0.5);
    if (fillet)
        imaged_.parts[1].blend =
            4.0 * (std::hypot(0.85 * waist * other, other + 0.5 * gap) - other);
    else
        imaged_.parts.push_back({"leak", leak});
    truth_ = std::make_unique<PhantomField>(vessels_);
    imaged_.imaging.spacing = Vec3::Constant(voxel);
    imaged_.imaging.blur = Vec3::Constant(dice.between(0.5, 0.9) * voxel);
    imaged_.imaging.noise = dice.between(10.0, 50.0);
    imaged_.seed = seed;
}

Surface TouchingPhantom::surface() const {
    const Image image = phantom_image(imaged_, PhantomField(imaged_.parts));
    ExtractionParameters parameters;
    parameters.method = ExtractionMethod::Threshold;
    parameters.threshold = bright_threshold(image);
    parameters.with_topology = false;
    return extract_surface(image, std::nullopt, parameters).surface;
}

double TouchingPhantom::waist(const Surface& surface) const {
    const SurfaceDistance wall(surface);
    double widest = 0.0;
    for (std::size_t i = 0; i < middles_.size(); ++i) {
        if (!wall.inside(middles_[i])) continue;
        double width = 0.0;
        for (const double side : {-1.0, 1.0})
            if (const auto hit = wall.first_hit(middles_[i], side * sides_[i]))
                width += hit->distance;
        widest = std::max(widest, width);
    }
    return widest / (2.0 * thinner);
}

double TouchingPhantom::error(const Vec3& p) const {
    return std::abs((*truth_)(p));
}

Vec3 TouchingPhantom::place(const Surface& surface) const {
    const SurfaceDistance wall(surface);
    std::size_t widest = middles_.size() / 2;
    if (!wall.inside(middles_[widest]))
        for (std::size_t i = 0; i < middles_.size(); ++i)
            if (wall.inside(middles_[i])) widest = i;
    const auto hit = wall.first_hit(middles_[widest], sides_[widest]);
    return hit ? hit->point : middles_[widest];
}

}  // namespace vesselbench::bench
