#include "geometry/vessel/openings/wall_axis.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/Geometry>

#include "geometry/kernel/unsmoothed.h"
#include "geometry/kernel/wall_edges.h"
#include "geometry/vessel/openings/angle.h"
#include "geometry/vessel/tree/tube_fit.h"

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
constexpr int kTurns = 6, kWeightings = 3;
constexpr int kFootSteps = 3;

/// A line of degree 5, an outline out of round by its second and third harmonic.
constexpr Eigen::Index kPowers = 6, kShape = 4;
using Fit = TubeFit<kPowers, kShape>;
/// Standard deviations of the derivatives of a vessel's line, of those of its radius, and of the
/// harmonics.
constexpr double kUsualDerivative[kPowers] = {0.0, 0.0, 0.25, 0.25, 0.5, 1.0};
constexpr double kUsualTaper = 0.5, kUsualShape = 0.05;

using Line = Eigen::Matrix<double, kPowers, 3>;

Fit::Series slopes(double t) {
    Fit::Series row = Fit::Series::Zero();
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
        const Fit::Series slope = slopes(t);
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
            const Vec3 off = p - (Fit::powers(t) * line_).transpose();
            t = std::clamp(t + off.dot(way) / way.squaredNorm(), stretch_.from - 0.5,
                           stretch_.to + 0.5);
        }
        return t;
    }

    /// The points along the stretch.
    std::vector<TubeSample> samples(const Vec3& forward, const Vec3& u, const Vec3& v) {
        std::vector<TubeSample> found;
        for (std::size_t i = 0; i < points_.size(); ++i) {
            const double t = feet_[i] = foot_of(points_[i], feet_[i]);
            if (t < stretch_.from || t > stretch_.to) continue;
            const Vec3 way = direction(t);
            Vec3 off = points_[i] - (Fit::powers(t) * line_).transpose();
            off -= off.dot(way) * way;
            const double distance = off.norm();
            const double radius = radius_[0] + t * (radius_[1] + t * radius_[2]);
            if (distance < kInnermost * radius || distance > kOutermost * radius) continue;
            const Vec3 out = off / distance;
            const Vec3 turned = Eigen::Quaterniond::FromTwoVectors(way, forward) * out;
            found.push_back({.along = t,
                             .angle = std::atan2(turned.dot(v), turned.dot(u)),
                             .distance = distance,
                             .out = {out.dot(u), out.dot(v)}});
        }
        return found;
    }

    /// What is known of the unknowns before: inverse variances, and means times these.
    void add_usual(Fit::Normal& normal, Fit::Unknowns& right, const Vec3& u, const Vec3& v) const {
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
        for (Eigen::Index k = 1; k < Fit::kRadius; ++k) add(Fit::kRadiusAt + k, kUsualTaper, 0.0);
        for (Eigen::Index k = 0; k < kShape; ++k) add(Fit::kShapeAt + k, kUsualShape, 0.0);
    }

    bool improve(int turn) {
        const Vec3 forward = direction(0.0), u = forward.unitOrthogonal(), v = forward.cross(u);
        const std::vector<TubeSample> wall = samples(forward, u, v);
        if (wall.size() < kFewest) return false;
        Fit::Normal usual = Fit::Normal::Zero();
        Fit::Unknowns right = Fit::Unknowns::Zero();
        add_usual(usual, right, u, v);
        const Fit fit(wall, scatter_,
                      {.rounds = turn > 0 ? kWeightings : 1,
                       .deviation = 1.48,
                       .reach = kOutlier,
                       .least = kLeastScatter,
                       .alike = kAlike},
                      usual, right);
        if (!fit.determined) return false;
        scatter_ = fit.scatter;
        spread_ = fit.spread;
        const Fit::Unknowns& found = fit.unknowns;
        line_ += found.segment<kPowers>(0) * u.transpose() +
                 found.segment<kPowers>(kPowers) * v.transpose();
        radius_ = found.segment<Fit::kRadius>(Fit::kRadiusAt);
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
    Eigen::Matrix<double, Fit::kRadius, 1> radius_;
    double scatter_ = 0.02;
    Fit::Normal spread_ = Fit::Normal::Zero();
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
