#include "geometry/vessel/posing/rod_energy.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Cholesky>

#include "geometry/kernel/cross_section.h"

namespace vesselbench {

namespace {

/// A step turns no element by more: the linearisation would not hold [rad].
constexpr double kLargestTurn = 0.2;
constexpr double kShorter = 0.8;  ///< of the step before, or the next one is damped
constexpr double kLeastDamping = 0.1;
constexpr int kSweeps = 400;  ///< of projected Gauss-Seidel
constexpr double kRegular = 1e-9;

Eigen::Map<const Vec3> part(const Eigen::VectorXd& all, std::size_t element) {
    return Eigen::Map<const Vec3>(all.data() + 3 * element);
}

Bends bends_of(const Eigen::VectorXd& all) {
    Bends bends(static_cast<std::size_t>(all.size()) / 3);
    for (std::size_t e = 0; e < bends.size(); ++e) bends[e] = part(all, e);
    return bends;
}

/// min 1/2 x S x - b x, x >= 0
Eigen::VectorXd pushes(const Eigen::MatrixXd& s, const Eigen::VectorXd& b) {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(b.size());
    for (int sweep = 0; sweep < kSweeps; ++sweep)
        for (Eigen::Index i = 0; i < x.size(); ++i)
            if (s(i, i) > 0.0) x[i] = std::max(0.0, x[i] + (b[i] - s.row(i).dot(x)) / s(i, i));
    return x;
}

}  // namespace

RodEnergy::RodEnergy(const Armature& armature, Bends natural,
                     const std::function<double(double)>& reach)
    : armature_(armature) {
    std::size_t count = 0;
    for (const Rod& rod : armature.rods) {
        first_.push_back(count);
        count += rod.elements.size();
    }
    const auto size = static_cast<Eigen::Index>(3 * count);
    stiffness_.resize(size);
    natural_ = Eigen::VectorXd::Zero(size);
    for (std::size_t e = 0; e < natural.size(); ++e)
        natural_.segment<3>(static_cast<Eigen::Index>(3 * e)) = natural[e];
    bends_ = natural_;
    std::size_t e = 0;
    for (const Rod& rod : armature.rods)
        for (const RodElement& element : rod.elements)
            stiffness_.segment<3>(static_cast<Eigen::Index>(3 * e++))
                .setConstant(element.radius * element.radius /
                             (element.length * element.flexibility));
    poses_ = pose(armature, bends_of(bends_));
    add_springs(reach);
}

void RodEnergy::add_springs(const std::function<double(double)>& reach) {
    const double pi4 = std::pow(std::numbers::pi, 4);
    for (std::size_t r = 0; r < armature_.rods.size(); ++r) {
        const Rod& rod = armature_.rods[r];
        const auto add = [&](std::size_t point, double length, double radius) {
            const double k = 4.0 * radius * radius * pi4 / std::pow(reach(radius), 4);
            const Binding at{.rod = static_cast<std::uint32_t>(r),
                             .segment = static_cast<std::uint32_t>(point - 1),
                             .t = 1.0};
            // The natural shape may be another one than that at rest.
            const Vec3& rest = poses_[r].points[point];
            springs_.push_back({at, rest, rest, std::sqrt(k * length)});
        };
        for (const RodElement& e : rod.elements) add(e.last, e.length, e.radius);
        if (rod.elements.empty()) continue;
        const double rest = rod.length() - rod.along()[rod.elements.back().last];
        if (rest > 0.0) add(rod.points().size() - 1, rest, rod.radii().back());
    }
    for (const Spring& spring : springs_) pull_weight_ = std::max(pull_weight_, spring.root_weight);
}

void RodEnergy::hold_displaced(std::size_t rod, double from, const Vec3& by) {
    for (Spring& spring : springs_)
        if (spring.at.rod == rod && armature_.rods[rod].along()[spring.at.segment + 1] > from)
            spring.held = spring.rest + by;
}

/// Derivative of a carried point's component along a direction by all bends.
Eigen::RowVectorXd RodEnergy::row(const Binding& at, const Vec3& point,
                                  const Vec3& direction) const {
    Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(bends_.size());
    if (at.rod == Binding::kFixed) return row;
    double place = std::lerp(armature_.rods[at.rod].along()[at.segment],
                             armature_.rods[at.rod].along()[at.segment + 1], at.t);
    for (std::optional<std::size_t> r = at.rod; r; r = armature_.rods[*r].parent) {
        const Rod& rod = armature_.rods[*r];
        for (std::size_t e = 0; e < rod.elements.size(); ++e) {
            const RodElement& element = rod.elements[e];
            const double share =
                std::clamp((place - rod.along()[element.first]) / element.length, 0.0, 1.0);
            if (share == 0.0) break;
            const std::size_t middle = (element.first + element.last) / 2;
            const RodPose& bent = poses_[*r];
            const Vec3 moment = (point - bent.points[middle]).cross(direction);
            row.segment<3>(static_cast<Eigen::Index>(3 * (first_[*r] + e))) =
                share * (bent.turns[middle].conjugate() * moment);
        }
        place = std::numeric_limits<double>::infinity();
    }
    return row;
}

void RodEnergy::factorise(const RodPull* pull) {
    const auto count = static_cast<Eigen::Index>(springs_.size());
    const Eigen::Index size = 3 * count + (pull ? 1 : 0);
    Eigen::MatrixXd rows(size, bends_.size());
    Eigen::VectorXd away(size);
    for (Eigen::Index s = 0; s < count; ++s) {
        const Spring& spring = springs_[static_cast<std::size_t>(s)];
        const Vec3 now = poses_[spring.at.rod].points[spring.at.segment + 1];
        for (int axis = 0; axis < 3; ++axis) {
            rows.row(3 * s + axis) = spring.root_weight * row(spring.at, now, Vec3::Unit(axis));
            away[3 * s + axis] = spring.root_weight * (now - spring.held)[axis];
        }
    }
    if (pull) {
        const Vec3 now = carried(poses_, armature_, pull->at, pull->rest);
        rows.row(3 * count) = pull_weight_ * row(pull->at, now, pull->along);
        away[3 * count] = pull_weight_ * pull->along.dot(now - pull->to);
    }
    Eigen::MatrixXd h = stiffness_.asDiagonal();
    h.selfadjointView<Eigen::Lower>().rankUpdate(rows.transpose());
    hessian_.compute(h);
    gradient_ = stiffness_.cwiseProduct(bends_ - natural_) + rows.transpose() * away;
}

void RodEnergy::advance(const Eigen::VectorXd& change) {
    double most = 0.0;
    for (std::size_t e = 0; 3 * e < static_cast<std::size_t>(change.size()); ++e)
        most = std::max(most, part(change, e).norm());
    const double share = most > kLargestTurn ? kLargestTurn / most : 1.0;
    bends_ += share * change;
    // Steps that do not become shorter overshoot: the springs' own curvature is left out.
    damping_ = share * most > kShorter * last_turn_ ? std::max(kLeastDamping, 0.5 * damping_)
                                                    : std::min(1.0, 1.1 * damping_);
    last_turn_ = share * most;
    poses_ = pose(armature_, bends_of(bends_));
}

double RodEnergy::step(const RodPull& pull) {
    factorise(&pull);
    const auto [first, second] = plane_axes(pull.along);
    const Vec3 now = carried(poses_, armature_, pull.at, pull.rest);
    Eigen::MatrixXd rows(2, bends_.size());
    rows.row(0) = row(pull.at, now, first);
    rows.row(1) = row(pull.at, now, second);
    const Eigen::Vector2d missing(first.dot(pull.to - now), second.dot(pull.to - now));
    const Eigen::MatrixXd x = hessian_.solve(rows.transpose());
    const Eigen::VectorXd downhill = hessian_.solve(gradient_);
    Eigen::Matrix2d s = rows * x;
    s.diagonal().array() += kRegular * s.trace();
    advance(x * s.ldlt().solve(missing + damping_ * (rows * downhill)) - damping_ * downhill);
    return pull.missing(carried(poses_, armature_, pull.at, pull.rest)).norm();
}

void RodEnergy::step(std::span<const RodGap> gaps) {
    factorise(nullptr);
    const auto count = static_cast<Eigen::Index>(gaps.size());
    Eigen::MatrixXd rows(count, bends_.size());
    Eigen::VectorXd missing(count);
    for (Eigen::Index i = 0; i < count; ++i) {
        const RodGap& gap = gaps[static_cast<std::size_t>(i)];
        const Vec3 from = carried(poses_, armature_, gap.from, gap.from_rest),
                   to = carried(poses_, armature_, gap.to, gap.to_rest);
        const Vec3 apart = (to - from).normalized();
        rows.row(i) = row(gap.to, to, apart) - row(gap.from, from, apart);
        missing[i] = gap.least - (to - from).norm();
    }
    const Eigen::MatrixXd x = hessian_.solve(rows.transpose());
    const Eigen::VectorXd downhill = hessian_.solve(gradient_);
    Eigen::MatrixXd s = rows * x;
    s.diagonal().array() += kRegular * s.trace();
    advance(x * pushes(s, missing + damping_ * (rows * downhill)) - damping_ * downhill);
}

}  // namespace vesselbench
