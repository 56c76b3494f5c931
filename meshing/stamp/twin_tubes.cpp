#include "meshing/stamp/twin_tubes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <Eigen/Cholesky>

#include "geometry/kernel/measure.h"
#include "geometry/kernel/robust.h"
#include "geometry/kernel/statistics.h"
#include "geometry/kernel/surface_distance.h"

namespace vesselbench {

namespace {

constexpr double kStation = 0.5;           ///< distance of a tube's centres [radii]
constexpr std::size_t kFewest = 6;         ///< centres of a tube
constexpr std::size_t kMost = 80;          ///< centres of a tube
constexpr std::size_t kMostPoints = 5000;  ///< of the wall that are looked at
constexpr int kRounds = 24;
constexpr double kFirstReach = 0.7;  ///< of the biweight [radii]
constexpr double kShrinking = 0.85;  ///< of that reach, by each round
constexpr double kLastReach = 0.18;  ///< of the biweight [radii]
constexpr double kNear = 0.15;       ///< wall so near to the other tube is not used [radii]
constexpr double kFree = 0.6;        ///< wall so far from the other tube is used in full [radii]
constexpr double kBending = 0.5;     ///< weight of the line's second differences [-]
constexpr double kTapering = 2.0;    ///< weight of the radii's second differences [-]
constexpr double kAnchor = 1.0;      ///< weight of the arms' centres [-]
constexpr double kExplained = 0.2;   ///< wall and tube agree within this [radii]
constexpr int kAround = 24;          ///< places around a tube, to compare it with the wall

struct WallPoint {
    Vec3 point;
    double area = 0.0;  ///< [mm^2]
};

std::vector<WallPoint> wall_points(const Surface& part) {
    std::vector<WallPoint> all;
    for (const Vec3& p : part.points()) all.push_back({p, 0.0});
    for (const Triangle& t : part.triangles())
        for (const VertexId v : t) all[v].area += area_normal(part.points(), t).norm() / 6.0;
    const std::size_t step = all.size() / kMostPoints + 1;
    std::vector<WallPoint> chosen;
    for (std::size_t i = 0; i < all.size(); i += step)
        chosen.push_back({all[i].point, all[i].area * static_cast<double>(step)});
    return chosen;
}

/// The cubic between two arms. Source: Hermite interpolation, tangents as long as the chord.
Tube first_guess(const ContactArm& from, const ContactArm& to) {
    const double span = (to.centre - from.centre).norm();
    const double usual = 0.5 * (from.radius + to.radius);
    const auto count =
        std::clamp(static_cast<std::size_t>(span / (kStation * usual)) + 2, kFewest, kMost);
    Positions points;
    std::vector<double> radii;
    for (std::size_t i = 0; i < count; ++i) {
        const double t = static_cast<double>(i) / static_cast<double>(count - 1);
        const double t2 = t * t, t3 = t2 * t;
        points.push_back((2 * t3 - 3 * t2 + 1) * from.centre -
                         (t3 - 2 * t2 + t) * span * from.outward + (3 * t2 - 2 * t3) * to.centre +
                         (t3 - t2) * span * to.outward);
        radii.push_back((1.0 - t) * from.radius + t * to.radius);
    }
    return {std::move(points), std::move(radii)};
}

double smooth_step(double low, double high, double x) {
    const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

/// The normal equations of one tube: unknowns are x, y, z and radius of each centre.
class TubeEquations {
public:
    explicit TubeEquations(const Tube& tube)
        : tube_(tube),
          matrix_(Eigen::MatrixXd::Zero(size(), size())),
          right_(Eigen::VectorXd::Zero(size())) {}

    /// The wall at a point shall be on the tube.
    void add_wall(const Vec3& point, const AxisPlace& at, double height, double weight) {
        const Vec3 out = point - tube_.centre(at);
        const double length = out.norm();
        if (!(length > 0.0) || weight == 0.0) return;
        Eigen::Matrix<double, 8, 1> row;
        row << -(1.0 - at.t) * out / length, -(1.0 - at.t), -at.t * out / length, -at.t;
        const auto first = static_cast<Eigen::Index>(4 * at.segment);
        matrix_.block<8, 8>(first, first) += weight * row * row.transpose();
        right_.segment<8>(first) -= weight * height * row;
    }

    void add_anchor(std::size_t centre, const ContactArm& arm) {
        const auto first = static_cast<Eigen::Index>(4 * centre);
        for (Eigen::Index k = 0; k < 4; ++k) matrix_(first + k, first + k) += kAnchor;
        right_.segment<3>(first) += kAnchor * (arm.centre - tube_.points()[centre]);
        right_[first + 3] += kAnchor * (arm.radius - tube_.radii()[centre]);
    }

    void add_stiffness() {
        for (std::size_t i = 1; i + 1 < tube_.points().size(); ++i)
            for (Eigen::Index k = 0; k < 4; ++k) {
                const double weight = k < 3 ? kBending : kTapering;
                const auto at = [&](std::size_t j) { return static_cast<Eigen::Index>(4 * j) + k; };
                const auto value = [&](std::size_t j) {
                    return k < 3 ? tube_.points()[j][k] : tube_.radii()[j];
                };
                const std::array<double, 3> stencil = {1.0, -2.0, 1.0};
                const double bend = value(i - 1) - 2.0 * value(i) + value(i + 1);
                for (std::size_t p = 0; p < 3; ++p) {
                    right_[at(i - 1 + p)] -= weight * stencil[p] * bend;
                    for (std::size_t q = 0; q < 3; ++q)
                        matrix_(at(i - 1 + p), at(i - 1 + q)) += weight * stencil[p] * stencil[q];
                }
            }
    }

    [[nodiscard]] Tube solved() const {
        const Eigen::VectorXd step = matrix_.ldlt().solve(right_);
        Positions points = tube_.points();
        std::vector<double> radii = tube_.radii();
        for (std::size_t i = 0; i < points.size(); ++i) {
            const auto first = static_cast<Eigen::Index>(4 * i);
            const double radius = radii[i], most = 0.5 * radius;
            Vec3 shift = step.segment<3>(first);
            if (shift.norm() > most) shift *= most / shift.norm();
            points[i] += shift;
            radii[i] = std::clamp(radius + step[first + 3], 0.5 * radius, 1.5 * radius);
        }
        return {std::move(points), std::move(radii)};
    }

private:
    [[nodiscard]] Eigen::Index size() const {
        return static_cast<Eigen::Index>(4 * tube_.points().size());
    }

    const Tube& tube_;
    Eigen::MatrixXd matrix_;
    Eigen::VectorXd right_;
};

/// \return the same twins, fitted once to the wall within `reach` of them [radii]
TwinTubes refitted(const TwinTubes& twins, const ContactZone& zone,
                   const std::vector<WallPoint>& wall, double reach) {
    TwinTubes better = twins;
    std::array<TubeEquations, 2> equations = {TubeEquations(twins.tubes[0]),
                                              TubeEquations(twins.tubes[1])};
    const std::array<double, 2> radius = {mean(twins.tubes[0].radii()),
                                          mean(twins.tubes[1].radii())};
    const double thinner = std::min(radius[0], radius[1]);
    for (const WallPoint& each : wall) {
        const std::array places = {twins.tubes[0].nearest_wall(each.point),
                                   twins.tubes[1].nearest_wall(each.point)};
        const std::size_t own = std::abs(places[0].second) <= std::abs(places[1].second) ? 0 : 1;
        const auto& [place, height] = places[own];
        const double free = smooth_step(kNear * thinner, kFree * thinner, places[1 - own].second);
        const double length = kStation * radius[own];
        const double share = each.area / (2.0 * std::numbers::pi * radius[own] * length);
        equations[own].add_wall(each.point, place, height,
                                share * free * biweight(height, reach * radius[own]));
    }
    for (std::size_t k = 0; k < 2; ++k) {
        equations[k].add_anchor(0, zone.arms[twins.arms[k][0]]);
        equations[k].add_anchor(twins.tubes[k].points().size() - 1, zone.arms[twins.arms[k][1]]);
        equations[k].add_stiffness();
        better.tubes[k] = equations[k].solved();
    }
    return better;
}

/// Area of a tube that is not near the wall, and all of it [mm^2].
std::pair<double, double> bare_area(const Tube& tube, const SurfaceDistance& wall) {
    double bare = 0.0, all = 0.0;
    for (std::size_t i = 0; i + 1 < tube.points().size(); ++i) {
        const Vec3 step = tube.points()[i + 1] - tube.points()[i];
        const double radius = 0.5 * (tube.radii()[i] + tube.radii()[i + 1]);
        const double area = 2.0 * std::numbers::pi * radius * step.norm() / kAround;
        const Vec3 x = step.unitOrthogonal(), y = step.normalized().cross(x);
        for (int k = 0; k < kAround; ++k) {
            const double angle = 2.0 * std::numbers::pi * k / kAround;
            const Vec3 at = 0.5 * (tube.points()[i] + tube.points()[i + 1]) +
                            radius * (std::cos(angle) * x + std::sin(angle) * y);
            all += area;
            if (!wall.closest_point(at, kExplained * radius)) bare += area;
        }
    }
    return {bare, all};
}

void judge(TwinTubes& twins, const ContactZone& zone, const std::vector<WallPoint>& wall) {
    double odd = 0.0, all = 0.0;
    std::vector<double> deviations;
    const std::array<double, 2> radius = {mean(twins.tubes[0].radii()),
                                          mean(twins.tubes[1].radii())};
    for (const WallPoint& each : wall) {
        const std::array<double, 2> heights = {twins.tubes[0].height(each.point),
                                               twins.tubes[1].height(each.point)};
        const std::size_t own = std::abs(heights[0]) <= std::abs(heights[1]) ? 0 : 1;
        all += each.area;
        if (std::abs(heights[own]) > kExplained * radius[own]) odd += each.area;
        if (heights[1 - own] > kFree * std::min(radius[0], radius[1]))
            deviations.push_back(heights[own]);
    }
    const SurfaceDistance distance(zone.part.surface);
    for (const Tube& tube : twins.tubes) {
        const auto [bare, whole] = bare_area(tube, distance);
        odd += bare;
        all += whole;
    }
    twins.misfit = odd / all;
    twins.noise = scatter_of(std::move(deviations));
    twins.overlap = 0.0;
    for (std::size_t i = 0; i < twins.tubes[0].points().size(); ++i) {
        const double apart = twins.tubes[1].height(twins.tubes[0].points()[i]);
        twins.overlap = std::max(
            twins.overlap, (twins.tubes[0].radii()[i] - apart) / std::min(radius[0], radius[1]));
    }
}

}  // namespace

TwinTubes twin_tubes(const ContactZone& zone, std::size_t partner) {
    const std::vector<WallPoint> wall = wall_points(zone.part.surface);
    TwinTubes twins;
    twins.arms[0] = {0, partner};
    twins.arms[1] = partner == 1   ? std::array<std::size_t, 2>{2, 3}
                    : partner == 2 ? std::array<std::size_t, 2>{1, 3}
                                   : std::array<std::size_t, 2>{1, 2};
    for (std::size_t k = 0; k < 2; ++k)
        twins.tubes[k] = first_guess(zone.arms[twins.arms[k][0]], zone.arms[twins.arms[k][1]]);
    double reach = kFirstReach;
    for (int round = 0; round < kRounds; ++round) {
        twins = refitted(twins, zone, wall, reach);
        reach = std::max(kLastReach, kShrinking * reach);
    }
    judge(twins, zone, wall);
    return twins;
}

}  // namespace vesselbench
