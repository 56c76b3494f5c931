#pragma once

#include <vector>

#include "geometry/kernel/cross_section.h"

namespace vesselbench {

/// A closed planar curve through given corners, smooth (cubic, C1), by share of its arc length.
class ClosedProfile {
public:
    /// \param corners in the plane [mm], counter-clockwise round its normal, at least 3
    ClosedProfile(Positions corners, const Plane& plane);

    /// \param share of the perimeter from the first corner; any real number
    [[nodiscard]] Vec3 at(double share) const;

    /// Corner before the place and how far it is on the way to the next one, [0, 1).
    [[nodiscard]] std::pair<std::size_t, double> segment(double share) const;

    /// Share of the perimeter of each corner, from 0 to below 1.
    [[nodiscard]] const std::vector<double>& shares() const { return shares_; }

    [[nodiscard]] double perimeter() const { return perimeter_; }

    /// Of the polygon of the corners [mm^2].
    [[nodiscard]] double area() const;

    [[nodiscard]] const Vec3& centroid() const { return centroid_; }

    /// The point of a circle with a given radius round the centroid that belongs to a share of the
    /// perimeter: turned so that corresponding points are as near as can be.
    [[nodiscard]] Vec3 on_circle(double share, double radius) const;

private:
    Positions corners_;
    Plane plane_;
    Positions slopes_;  ///< derivative by share at each corner [mm]
    std::vector<double> shares_;
    double perimeter_ = 0.0;
    Vec3 centroid_ = Vec3::Zero();  ///< [mm]
    double start_angle_ = 0.0;      ///< of share 0 on the circle [rad]
};

/// Signed area and centroid of a planar polygon, counter-clockwise round the normal [mm^2], [mm].
[[nodiscard]] std::pair<double, Vec3> polygon_area(const Positions& corners, const Vec3& normal);

}  // namespace vesselbench
