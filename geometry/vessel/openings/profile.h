#pragma once

#include <vector>

#include "geometry/kernel/cross_section.h"

namespace vesselbench {

/// A closed planar curve through given corners, smooth (cubic, C1), by fraction of its arc length.
class ClosedProfile {
public:
    /// \param corners in the plane [mm], counter-clockwise around its normal, at least 3
    ClosedProfile(Positions corners, const Plane& plane);

    /// \param share fraction of the perimeter from the first corner; any real number
    [[nodiscard]] Vec3 at(double share) const;

    /// The corner before the place, and the fraction of the way to the next one, [0, 1).
    [[nodiscard]] std::pair<std::size_t, double> segment(double share) const;

    /// Fraction of the perimeter at each corner, from 0 to below 1.
    [[nodiscard]] const std::vector<double>& shares() const { return shares_; }

    [[nodiscard]] double perimeter() const { return perimeter_; }

    /// Area of the polygon of the corners [mm^2].
    [[nodiscard]] double area() const;

    [[nodiscard]] const Vec3& centroid() const { return centroid_; }

    /// The point of a circle with a given radius around the centroid that corresponds to a fraction
    /// of the perimeter: turned so that corresponding points are as close as possible.
    [[nodiscard]] Vec3 on_circle(double share, double radius) const;

private:
    Positions corners_;
    Plane plane_;
    Positions slopes_;  ///< derivative by the fraction at each corner [mm]
    std::vector<double> shares_;
    double perimeter_ = 0.0;
    Vec3 centroid_ = Vec3::Zero();  ///< [mm]
    double start_angle_ = 0.0;      ///< of fraction 0 on the circle [rad]
};

/// Signed area and centroid of a planar polygon, counter-clockwise around the normal [mm^2], [mm].
[[nodiscard]] std::pair<double, Vec3> polygon_area(const Positions& corners, const Vec3& normal);

}  // namespace vesselbench
