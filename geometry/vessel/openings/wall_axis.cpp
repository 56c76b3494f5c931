#include "geometry/vessel/openings/wall_axis.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/Dense>
#include <Eigen/Geometry>

#include "geometry/kernel/statistics.h"
#include "geometry/kernel/unsmoothed.h"
#include "geometry/kernel/wall_edges.h"
#include "geometry/vessel/openings/angle.h"

namespace vesselbench {

namespace {

// Lengths are in diameters, the plane's point is the origin.

/// A wall that scatters more has noise, or the steps of voxels: sections, which average it, show
/// its direction better. Surfaces made from voxels scatter by 0.003 to 0.05, those whose vertices
/// lie on the wall by 0.0001 to 0.001.
constexpr double kCleanScatter = 0.002;
/// One fit that is so far from clean spares the others.
constexpr double kHopeless = 10.0;  // kCleanScatter
constexpr double kLeastScatter = 5e-4;
/// Vertices' errors are alike where the line wanders more than the fit: a variance so many times
/// that of vertices by themselves.
constexpr double kAlike = 4.0;
/// The direction is taken so far inside where the wall is whole, and at most so far from the plane.
constexpr double kInside = 0.12;
constexpr double kFarthestInside = 0.22;
/// Lengths that are fitted, and how far a fit may reach beyond the last whole section.
constexpr double kLengths[] = {0.75, 1.0, 1.5, 2.0};
constexpr double kLongest = 2.0;
constexpr double kBeyondLast = 0.15;
constexpr double kShortest = 0.3;
constexpr std::size_t kFewest = 20, kMost = 500;  // vertices
/// A vertex belongs to the vessel within these fractions of its radius.
constexpr double kInnermost = 0.6, kOutermost = 1.45;
/// One that was moved by more was not smoothed, but moved on purpose.
constexpr double kSmoothedAway = 0.4;
/// A vertex farther off the wall than this many times the usual distance does not count.
constexpr double kOutlier = 4.0;
constexpr int kTurns = 6;
constexpr int kFootSteps = 3;

/// Unknowns: the line's offsets along two axes, the radius, the second and third harmonic of its
/// outline.
constexpr Eigen::Index kPowers = 6, kRadius = 3, kShape = 4;
constexpr Eigen::Index kRadiusAt = 2 * kPowers, kShapeAt = kRadiusAt + kRadius;
constexpr Eigen::Index kUnknowns = kShapeAt + kShape;
/// Standard deviations of the derivatives of a vessel's line, of those of its radius, and of the
/// harmonics.
constexpr double kUsualDerivative[kPowers] = {0.0, 0.0, 0.25, 0.25, 0.5, 1.0};
constexpr double kUsualTaper = 0.5, kUsualShape = 0.05;

using Powers = Eigen::Matrix<double, 1, kPowers>;
using Line = Eigen::Matrix<double, kPowers, 3>;
using Unknowns = Eigen::Matrix<double, kUnknowns, 1>;
using Normal = Eigen::Matrix<double, kUnknowns, kUnknowns>;
using Rows = Eigen::Matrix<double, Eigen::Dynamic, kUnknowns>;

Powers powers(double t) {
    Powers row;
    double p = 1.0;
    for (Eigen::Index k = 0; k < kPowers; ++k, p *= t) row[k] = p;
    return row;
}

Powers slopes(double t) {
    Powers row = Powers::Zero();
    double p = 1.0;
    for (Eigen::Index k = 1; k < kPowers; ++k, p *= t) row[k] = static_cast<double>(k) * p;
    return row;
}

/// The wall's vertices near a plane, in diameters from its point; every so-many-th if they are
/// many.
std::vector<Vec3> wall_near(const Surface& surface, const Plane& plane, double diameter,
                            const Stretch& whole) {
    const std::vector<std::uint8_t> on_wall = vertices_of_wall(surface);
    const Positions before = unsmoothed(surface);
    const double reach = std::max(-whole.from, std::min(whole.to, kLongest)) + kOutermost;
    std::vector<Vec3> near;
    for (std::size_t v = 0; v < before.size(); ++v) {
        if (on_wall[v] == 0) continue;
        const Vec3& now = surface.points()[v];
        const bool smoothed = (before[v] - now).norm() < kSmoothedAway * diameter;
        const Vec3 p = ((smoothed ? before[v] : now) - plane.point) / diameter;
        const double along = -p.dot(plane.normal);
        if (p.norm() < reach && along > whole.from - kShortest) near.push_back(p);
    }
    const std::size_t every = near.size() / kMost + 1;
    std::vector<Vec3> chosen;
    for (std::size_t i = 0; i < near.size(); i += every) chosen.push_back(near[i]);
    return chosen;
}

/// A tube around a line, fitted to points.
class FittedWall {
public:
    FittedWall(const std::vector<Vec3>& points, const Vec3& inward, const Stretch& stretch)
        : points_(points), stretch_(stretch) {
        line_.setZero();
        line_.row(1) = inward.transpose();
        radius_ = {0.5, 0.0, 0.0};
        for (const Vec3& p : points_) feet_.push_back(p.dot(inward));
    }

    /// False if there are too few points.
    bool fit() {
        for (int turn = 0; turn < kTurns; ++turn)
            if (!improve(turn)) return false;
        return true;
    }

    /// Inward, unit.
    [[nodiscard]] Vec3 direction(double t) const {
        return (slopes(t) * line_).transpose().normalized();
    }

    [[nodiscard]] double scatter() const { return scatter_; }

    /// Standard deviation of the direction [deg].
    [[nodiscard]] double doubt_deg(double t) const {
        const Powers slope = slopes(t);
        double variance = 0.0;
        for (const Eigen::Index at : {Eigen::Index{0}, kPowers})
            variance += (slope * spread_.block<kPowers, kPowers>(at, at)).dot(slope);
        return std::sqrt(variance) * 180.0 / std::numbers::pi;
    }

private:
    /// Where the line passes a point.
    double foot_of(const Vec3& p, double t) const {
        for (int step = 0; step < kFootSteps; ++step) {
            const Vec3 way = (slopes(t) * line_).transpose();
            const Vec3 off = p - (powers(t) * line_).transpose();
            t = std::clamp(t + off.dot(way) / way.squaredNorm(), stretch_.from - 0.5,
                           stretch_.to + 0.5);
        }
        return t;
    }

    /// The equations of the points along the stretch. \return false if there are too few
    bool take_points(const Vec3& forward, const Vec3& u, const Vec3& v) {
        std::vector<Eigen::Matrix<double, 1, kUnknowns>> rows;
        std::vector<double> distances;
        for (std::size_t i = 0; i < points_.size(); ++i) {
            const double t = feet_[i] = foot_of(points_[i], feet_[i]);
            if (t < stretch_.from || t > stretch_.to) continue;
            const Vec3 way = direction(t);
            Vec3 off = points_[i] - (powers(t) * line_).transpose();
            off -= off.dot(way) * way;
            const double distance = off.norm();
            const double radius = radius_[0] + t * (radius_[1] + t * radius_[2]);
            if (distance < kInnermost * radius || distance > kOutermost * radius) continue;
            const Vec3 out = off / distance;
            const Vec3 turned = Eigen::Quaterniond::FromTwoVectors(way, forward) * out;
            const double angle = std::atan2(turned.dot(v), turned.dot(u));
            Eigen::Matrix<double, 1, kUnknowns> row;
            row.segment<kPowers>(0) = out.dot(u) * powers(t);
            row.segment<kPowers>(kPowers) = out.dot(v) * powers(t);
            row.segment<kRadius>(kRadiusAt) = powers(t).head<kRadius>();
            row.segment<kShape>(kShapeAt) << std::cos(2.0 * angle), std::sin(2.0 * angle),
                std::cos(3.0 * angle), std::sin(3.0 * angle);
            rows.push_back(row);
            distances.push_back(distance);
        }
        if (rows.size() < kFewest) return false;
        const auto n = static_cast<Eigen::Index>(rows.size());
        rows_.resize(n, kUnknowns);
        for (Eigen::Index i = 0; i < n; ++i) rows_.row(i) = rows[static_cast<std::size_t>(i)];
        distances_ = Eigen::Map<const Eigen::VectorXd>(distances.data(), n);
        return true;
    }

    /// What is known of the unknowns before: inverse variances, and means times these.
    void add_usual(Normal& normal, Unknowns& right, const Vec3& u, const Vec3& v) const {
        const auto add = [&](Eigen::Index at, double deviation, double mean) {
            normal(at, at) += 1.0 / (deviation * deviation);
            right[at] += mean / (deviation * deviation);
        };
        double factorial = 1.0;
        for (Eigen::Index k = 2; k < kPowers; ++k) {
            factorial *= static_cast<double>(k);
            add(k, kUsualDerivative[k] / factorial, -line_.row(k).dot(u));
            add(kPowers + k, kUsualDerivative[k] / factorial, -line_.row(k).dot(v));
        }
        for (Eigen::Index k = 1; k < kRadius; ++k) add(kRadiusAt + k, kUsualTaper, 0.0);
        for (Eigen::Index k = 0; k < kShape; ++k) add(kShapeAt + k, kUsualShape, 0.0);
    }

    /// Solves with the weights, and measures the scatter that is left.
    Unknowns solved(const Eigen::VectorXd& weights, const Vec3& u, const Vec3& v) {
        const double each = 1.0 / (kAlike * scatter_ * scatter_);
        const Normal data = each * rows_.transpose() * weights.asDiagonal() * rows_;
        Unknowns right = each * rows_.transpose() * weights.cwiseProduct(distances_);
        Normal normal = data;
        add_usual(normal, right, u, v);
        const Eigen::LLT<Normal> solver(normal);
        spread_ = solver.solve(Normal::Identity());
        const Unknowns found = solver.solve(right);
        rest_ = distances_ - rows_ * found;
        // Unknowns that the points determine, not what is usual.
        const double determined = (data * spread_).trace(), count = weights.sum();
        scatter_ = std::max(
            std::sqrt(weights.dot(rest_.cwiseAbs2()) / std::max(count - determined, 0.15 * count)),
            kLeastScatter);
        return found;
    }

    Eigen::VectorXd weights_of_rest() const {
        const Eigen::VectorXd size = rest_.cwiseAbs();
        const double usual =
            std::max(1.48 * median(std::vector<double>(size.begin(), size.end())), kLeastScatter);
        return (1.0 - (size / (kOutlier * usual)).array().square()).cwiseMax(0.0).square();
    }

    bool improve(int turn) {
        constexpr int kWeightings = 3;
        const Vec3 forward = direction(0.0), u = forward.unitOrthogonal(), v = forward.cross(u);
        if (!take_points(forward, u, v)) return false;
        Eigen::VectorXd weights = Eigen::VectorXd::Ones(rows_.rows());
        Unknowns found = solved(weights, u, v);
        for (int i = 1; turn > 0 && i < kWeightings; ++i) {
            weights = weights_of_rest();
            found = solved(weights, u, v);
        }
        line_ += found.segment<kPowers>(0) * u.transpose() +
                 found.segment<kPowers>(kPowers) * v.transpose();
        radius_ = found.segment<kRadius>(kRadiusAt);
        // The parameter is the length along the line at the plane.
        const double pace = line_.row(1).norm();
        double p = 1.0;
        for (Eigen::Index k = 0; k < kPowers; ++k, p *= pace) line_.row(k) /= p;
        return true;
    }

    const std::vector<Vec3>& points_;
    Stretch stretch_;
    std::vector<double> feet_;
    Line line_;
    Eigen::Matrix<double, kRadius, 1> radius_;
    Rows rows_;
    Eigen::VectorXd distances_, rest_;
    double scatter_ = 0.02;
    Normal spread_ = Normal::Zero();
};

std::optional<WallAxis> axis_of_stretch(const std::vector<Vec3>& points, const Vec3& inward,
                                        const Stretch& stretch, double at) {
    FittedWall tube(points, inward, stretch);
    if (!tube.fit()) return std::nullopt;
    const double turned = std::max(std::min(at + 1.0, stretch.to), at + 0.1);
    return WallAxis{
        .direction = -tube.direction(at),
        .bend_deg = angle_deg(tube.direction(at), tube.direction(turned)) / (turned - at),
        .doubt_deg = tube.doubt_deg(at),
        .scatter = tube.scatter()};
}

}  // namespace

std::optional<WallAxis> wall_axis(const Surface& surface, const Plane& plane, double diameter,
                                  const Stretch& whole) {
    const std::vector<Vec3> points = wall_near(surface, plane, diameter, whole);
    const double at = std::min(std::max(0.0, whole.from) + kInside, kFarthestInside);
    std::optional<WallAxis> best;
    double before = whole.from + kShortest;
    for (const double length : kLengths) {
        const double to = std::min(length, whole.to + kBeyondLast);
        if (to <= before) continue;
        before = to;
        const auto axis = axis_of_stretch(points, -plane.normal, {whole.from, to}, at);
        if (!axis) continue;
        if (axis->scatter > kHopeless * kCleanScatter) break;
        if (axis->scatter < kCleanScatter && (!best || axis->doubt_deg < best->doubt_deg))
            best = axis;
    }
    // A short vessel may have too few vertices beyond its rounded end.
    if (!best && whole.from > 0.0) return wall_axis(surface, plane, diameter, {0.0, whole.to});
    return best;
}

}  // namespace vesselbench
