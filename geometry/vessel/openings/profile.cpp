#include "geometry/vessel/openings/profile.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "geometry/kernel/errors.h"

namespace vesselbench {

ClosedProfile::ClosedProfile(Positions corners, const Plane& plane)
    : corners_(std::move(corners)), plane_(plane) {
    const std::size_t n = corners_.size();
    if (n < 3) throw InvalidInput("a profile needs at least 3 corners");
    for (std::size_t i = 0; i < n; ++i) {
        shares_.push_back(perimeter_);
        perimeter_ += (corners_[(i + 1) % n] - corners_[i]).norm();
    }
    for (double& share : shares_) share /= perimeter_;
    const auto step = [&](std::size_t i) {
        return i + 1 < n ? shares_[i + 1] - shares_[i] : 1.0 - shares_[i];
    };
    for (std::size_t i = 0; i < n; ++i) {
        // Slope of the parabola through the corner and both neighbours.
        const std::size_t before = (i + n - 1) % n;
        const double a = step(before), b = step(i);
        const Vec3 back = (corners_[i] - corners_[before]) / a;
        const Vec3 forth = (corners_[(i + 1) % n] - corners_[i]) / b;
        slopes_.push_back((b * back + a * forth) / (a + b));
    }
    const auto [u, v] = plane_axes(plane_.normal);
    centroid_ = polygon_area(corners_, plane_.normal).second;
    double along = 0.0, across = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
        const Vec3 p = corners_[i] - centroid_;
        const double angle = 2.0 * std::numbers::pi * shares_[i],
                     weight = step(i) + step((i + n - 1) % n);
        const double x = u.dot(p), y = v.dot(p);
        along += weight * (x * std::cos(angle) + y * std::sin(angle));
        across += weight * (y * std::cos(angle) - x * std::sin(angle));
    }
    start_angle_ = std::atan2(across, along);
}

std::pair<std::size_t, double> ClosedProfile::segment(double share) const {
    share -= std::floor(share);
    const auto after = std::upper_bound(shares_.begin(), shares_.end(), share);
    const auto i = static_cast<std::size_t>(after - shares_.begin()) - 1;
    const double end = i + 1 < shares_.size() ? shares_[i + 1] : 1.0;
    return {i, (share - shares_[i]) / (end - shares_[i])};
}

Vec3 ClosedProfile::at(double share) const {
    const auto [i, t] = segment(share);
    const std::size_t next = (i + 1) % corners_.size();
    const double h = (next == 0 ? 1.0 : shares_[next]) - shares_[i];
    const double t2 = t * t, t3 = t2 * t;
    return (2 * t3 - 3 * t2 + 1) * corners_[i] + (t3 - 2 * t2 + t) * h * slopes_[i] +
           (3 * t2 - 2 * t3) * corners_[next] + (t3 - t2) * h * slopes_[next];
}

double ClosedProfile::area() const {
    return polygon_area(corners_, plane_.normal).first;
}

Vec3 ClosedProfile::on_circle(double share, double radius) const {
    const auto [u, v] = plane_axes(plane_.normal);
    const double angle = start_angle_ + 2.0 * std::numbers::pi * share;
    return centroid_ + radius * (std::cos(angle) * u + std::sin(angle) * v);
}

std::pair<double, Vec3> polygon_area(const Positions& corners, const Vec3& normal) {
    double area = 0.0;
    Vec3 moment = Vec3::Zero();
    const Vec3 origin = corners.front();
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec3 p = corners[i] - origin, q = corners[(i + 1) % corners.size()] - origin;
        const double part = 0.5 * normal.dot(p.cross(q));
        area += part;
        moment += part * (p + q) / 3.0;
    }
    return {area, area != 0.0 ? Vec3(origin + moment / area) : origin};
}

}  // namespace vesselbench
