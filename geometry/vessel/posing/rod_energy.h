#pragma once

#include <functional>
#include <span>
#include <vector>

#include "geometry/vessel/posing/pose.h"

namespace vesselbench {

/// A point of an axis that shall be on a line. Where on it follows from the rod's length; nearer to
/// the line's point costs less energy.
struct RodPull {
    Binding at;
    Vec3 rest = Vec3::Zero();    ///< where it is at rest [mm]
    Vec3 to = Vec3::Zero();      ///< on the line [mm]
    Vec3 along = Vec3::UnitZ();  ///< unit direction of the line

    /// What is missing of the move, across the line [mm].
    [[nodiscard]] Vec3 missing(const Vec3& now) const {
        return (to - now) - along.dot(to - now) * along;
    }
};

/// Two points that shall be apart.
struct RodGap {
    Binding from, to;
    Vec3 from_rest = Vec3::Zero(), to_rest = Vec3::Zero();  ///< [mm]
    double least = 0.0;                                     ///< distance [mm]
};

/// Elastic rods at their least energy under constraints.
///
/// Inextensible Kirchhoff rods whose natural shape is the one at rest, on an elastic foundation
/// that holds each place at rest: E = 1/2 sum r^2 |b - b0|^2 / l + 1/2 sum k l |u|^2 with bends b,
/// lengths l, displacements u. A thick vessel bends less. The stiffness k = 4 r^2 pi^4 / reach^4
/// lets the displacement by a force fade within `reach` (beam on an elastic foundation, Hetenyi
/// 1946). Minimised by Gauss-Newton steps over the bends, constraints linearised (Bergou et al.,
/// "Discrete elastic rods", SIGGRAPH 2008, for the model).
class RodEnergy {
public:
    /// \param armature whose rods are divided; is kept as a reference
    /// \param natural bends without energy; empty: none
    /// \param reach length along a rod on each side of a force over which displacements fade
    ///        [mm], by the vessel's radius [mm]
    RodEnergy(const Armature& armature, Bends natural, const std::function<double(double)>& reach);

    /// Holds what lies beyond an arc length of a rod [mm] displaced [mm] instead of at rest.
    void hold_displaced(std::size_t rod, double from, const Vec3& by);

    /// One step towards least energy with the pulled point on its line.
    /// \return its distance from the line after the step [mm]
    double step(const RodPull& pull);

    /// One step towards least energy with all gaps open.
    void step(std::span<const RodGap> gaps);

    [[nodiscard]] const std::vector<RodPose>& poses() const { return poses_; }

    /// The largest turn of the last step [rad].
    [[nodiscard]] double last_turn() const { return last_turn_; }

private:
    struct Spring {
        Binding at;
        Vec3 rest;
        Vec3 held;           ///< to where it is drawn
        double root_weight;  ///< square root of k l
    };

    void add_springs(const std::function<double(double)>& reach);
    [[nodiscard]] Eigen::RowVectorXd row(const Binding& at, const Vec3& point,
                                         const Vec3& direction) const;
    /// \param pull null: none
    void factorise(const RodPull* pull);
    void advance(const Eigen::VectorXd& change);

    const Armature& armature_;
    std::vector<std::size_t> first_;  ///< number of each rod's first element
    std::vector<Spring> springs_;
    double pull_weight_ = 0.0;   ///< square root of a pull's stiffness along its line
    Eigen::VectorXd stiffness_;  ///< of each component of each bend
    Eigen::VectorXd bends_, natural_;
    std::vector<RodPose> poses_;
    Eigen::LLT<Eigen::MatrixXd> hessian_;
    Eigen::VectorXd gradient_;
    double damping_ = 1.0;  ///< share of a step towards least energy that is taken
    double last_turn_ = 0.0;
};

}  // namespace vesselbench
