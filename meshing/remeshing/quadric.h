#pragma once

#include <algorithm>

#include <Eigen/Core>
#include <Eigen/LU>

#include "geometry/kernel/vec3.h"

namespace vesselbench {

/// Weighted sum of squared distances from planes and points, as a function of position: x'Ax + 2b'x
/// + c.
/// Source: Garland & Heckbert, "Surface simplification using quadric error metrics", SIGGRAPH 1997.
struct Quadric {
    Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
    Vec3 b = Vec3::Zero();
    double c = 0.0;

    /// Adds the squared distance from the plane through p. \param normal of length 1
    void add_plane(const Vec3& normal, const Vec3& p, double weight) {
        const double d = -normal.dot(p);
        A += weight * normal * normal.transpose();
        b += weight * d * normal;
        c += weight * d * d;
    }

    /// Adds the squared distance from p.
    void add_point(const Vec3& p, double weight) {
        A += weight * Eigen::Matrix3d::Identity();
        b -= weight * p;
        c += weight * p.squaredNorm();
    }

    Quadric& operator+=(const Quadric& other) {
        A += other.A;
        b += other.b;
        c += other.c;
        return *this;
    }

    [[nodiscard]] double at(const Vec3& x) const {
        return std::max(0.0, x.dot(A * x + 2.0 * b) + c);
    }

    /// The minimum of the sum, close to `start` in directions that A leaves undetermined.
    [[nodiscard]] Vec3 least(const Vec3& start) const {
        return start - A.inverse() * (A * start + b);
    }
};

}  // namespace vesselbench
