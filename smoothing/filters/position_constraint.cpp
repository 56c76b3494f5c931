#include "smoothing/filters/position_constraint.h"

#include "geometry/kernel/errors.h"

namespace vesselbench {

Vec3 PositionConstraint::clamped(const Vec3& start, const Vec3& position) const {
    const Vec3 half = 0.5 * size;
    const Vec3 moved = axes.transpose() * (position - start);
    if (cell == Cell::Voxel) {
        const Vec3 inside = moved.cwiseMax(-half).cwiseMin(half);
        return inside == moved ? position : Vec3(start + axes * inside);
    }
    const double outside = moved.cwiseAbs().cwiseQuotient(half).sum();
    return outside <= 1.0 ? position : Vec3(start + (position - start) / outside);
}

void require_valid(const PositionConstraint& constraint) {
    const bool positive = constraint.size.allFinite() && constraint.size.minCoeff() > 0.0;
    if (!positive) throw InvalidInput("the cell of a position constraint needs three sizes > 0");
    const Eigen::Matrix3d gram = constraint.axes.transpose() * constraint.axes;
    if (!gram.isApprox(Eigen::Matrix3d::Identity(), 1e-6))
        throw InvalidInput("the axes of a position constraint are not orthonormal");
}

}  // namespace vesselbench
