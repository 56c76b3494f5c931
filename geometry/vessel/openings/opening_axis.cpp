#include "geometry/vessel/openings/opening_axis.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <Eigen/Dense>

#include "geometry/kernel/edges.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/statistics.h"
#include "geometry/vessel/openings/wall_axis.h"

namespace vesselbench {

namespace {

/// Sections along the vessel [diameters].
constexpr double kSectionStep = 0.125;
constexpr int kSections = 16;
constexpr double kMostOutward = 1.0;
/// The vessel is the same one while the area of its sections stays within this factor of their
/// median, and from one section to the next within the second one.
constexpr double kLargestAreaRatio = 1.4;
constexpr double kLargestAreaStep = 1.6;
/// Beyond the opening, sections count while they have this share of its area.
constexpr double kWholeOutward = 0.9;
/// A centroid that leaps farther belongs to another vessel [diameters].
constexpr double kLargestLeap = 0.2;
/// The way on is that of the last centroids.
constexpr std::size_t kWayFrom = 5, kWayOver = 9;

/// Where the direction is taken [diameters inward]: at the opening itself it rests on one side's
/// sections only.
constexpr double kDirectionAt = 0.1;
/// Standard deviations of a vessel's curvature [rad per diameter] and of its change.
constexpr double kUsualCurvature = 0.25;
constexpr double kUsualChange = 0.125;
/// The centroids' error from that of the radii: a step of a staircase moves a section aside as much
/// as it widens it, and part of the widening looks like a taper.
constexpr double kErrorToScatter = 3.0;
constexpr double kLeastError = 1e-4;  // diameters
/// Errors of sections this close together are alike [diameters].
constexpr double kErrorLength = 0.2;
constexpr double kOwnError = 0.05;  // fraction of the variance that is each section's own

/// A clean wall that shows the direction so well is believed rather than its sections: what
/// smoothing has moved aside alike does not show in their radii [deg].
constexpr double kKnownDoubt = 2.0;

struct TrackSection {
    Vec3 centroid = Vec3::Zero();
    double radius = 0.0;  ///< [mm]
    double depth = 0.0;   ///< along the track, positive inward [diameters]
};

using Track = std::vector<TrackSection>;

double median_radius(const Track& track) {
    std::vector<double> radii;
    for (const TrackSection& section : track) radii.push_back(section.radius);
    return median(radii);
}

bool within(double ratio, double factor) {
    return ratio * ratio < factor && ratio * ratio > 1.0 / factor;
}

/// Direction of the line through the last centroids.
Vec3 way_on(const Track& track, const Vec3& before) {
    if (track.size() < kWayFrom) return before;
    const std::size_t count = std::min(track.size(), kWayOver);
    const std::size_t first = track.size() - count;
    Vec3 way = Vec3::Zero();
    for (std::size_t i = 0; i < count; ++i)
        way += (static_cast<double>(i) - 0.5 * static_cast<double>(count - 1)) *
               track[first + i].centroid;
    return way.normalized();
}

/// The sections from the plane onward, the plane's own first. \param side 1 inward, -1 outward
Track track_from(const Surface& surface, const Plane& plane, double diameter, double side,
                 int sections) {
    Track track = {{plane.point, 0.5 * diameter, 0.0}};
    Vec3 way = -side * plane.normal;
    Vec3 from = plane.point;
    for (int k = 1; k <= sections; ++k) {
        const Plane next{from + kSectionStep * diameter * way, way};
        const auto curve = cross_section_at(surface, next);
        if (!curve || !curve->closed) {
            if (k > 1) break;
            from = next.point;  // an uneven rim
            continue;
        }
        const TrackSection& last = track.back();
        const double radius = 0.5 * curve->diameter();
        const double leap = (curve->centroid - next.point).norm();
        if (!within(radius / median_radius(track), kLargestAreaRatio) ||
            !within(radius / last.radius, kLargestAreaStep) || leap > kLargestLeap * diameter)
            break;
        if (side < 0.0 && radius * radius < kWholeOutward * 0.25 * diameter * diameter) break;
        from = curve->centroid;
        track.push_back(
            {from, radius, last.depth + side * (from - last.centroid).norm() / diameter});
        way = way_on(track, way);
    }
    return track;
}

/// \param outward [mm]
Track track_of(const Surface& surface, const Plane& plane, double diameter, double outward) {
    const double beyond = std::clamp(outward / diameter, 0.0, kMostOutward);
    Track track = track_from(surface, plane, diameter, 1.0, kSections);
    const Track outer =
        track_from(surface, plane, diameter, -1.0, static_cast<int>(beyond / kSectionStep));
    track.insert(track.end(), outer.begin() + 1, outer.end());
    return track;
}

/// Powers 0 to `degree` of the sections' depths, #sections x (degree + 1).
Eigen::MatrixXd powers(const Track& track, Eigen::Index degree) {
    Eigen::MatrixXd A(static_cast<Eigen::Index>(track.size()), degree + 1);
    for (Eigen::Index i = 0; i < A.rows(); ++i)
        for (Eigen::Index k = 0; k <= degree; ++k)
            A(i, k) = std::pow(track[static_cast<std::size_t>(i)].depth, static_cast<double>(k));
    return A;
}

/// Scatter of the radii around a smooth change [diameters].
double radius_scatter(const Track& track, double diameter) {
    const auto n = static_cast<Eigen::Index>(track.size());
    const Eigen::MatrixXd A = powers(track, std::min<Eigen::Index>(2, n - 2));
    Eigen::VectorXd r(n);
    for (Eigen::Index i = 0; i < n; ++i)
        r[i] = track[static_cast<std::size_t>(i)].radius / diameter;
    const Eigen::VectorXd rest = r - A * A.colPivHouseholderQr().solve(r);
    return std::sqrt(rest.squaredNorm() / static_cast<double>(n - A.cols()));
}

/// The vessel's line by depth inward [diameters]: a cubic and what is known of its slope.
class VesselLine {
public:
    VesselLine(const Track& track, double diameter) {
        const auto n = static_cast<Eigen::Index>(track.size());
        const Eigen::MatrixXd A = powers(track, 3);
        Eigen::MatrixXd points(n, 3), covariance(n, n);
        const double error =
            std::max(kErrorToScatter * radius_scatter(track, diameter), kLeastError);
        for (Eigen::Index i = 0; i < n; ++i) {
            const auto& at = track[static_cast<std::size_t>(i)];
            points.row(i) = (at.centroid - track.front().centroid).transpose() / diameter;
            for (Eigen::Index j = 0; j < n; ++j) {
                const double apart =
                    (at.depth - track[static_cast<std::size_t>(j)].depth) / kErrorLength;
                covariance(i, j) =
                    error * error * (std::exp(-0.5 * apart * apart) + (i == j ? kOwnError : 0.0));
            }
        }
        const Eigen::LLT<Eigen::MatrixXd> noise(covariance);
        Eigen::Matrix4d normal = A.transpose() * noise.solve(A);
        // Half and a sixth: the coefficients of a curvature and of its change.
        normal(2, 2) += std::pow(0.5 * kUsualCurvature, -2.0);
        normal(3, 3) += std::pow(kUsualChange / 6.0, -2.0);
        spread_ = normal.inverse();
        cubic_ = spread_ * A.transpose() * noise.solve(points);
    }

    /// Unit, inward.
    [[nodiscard]] Vec3 direction(double depth) const {
        return (slope_of(depth).transpose() * cubic_).transpose().normalized();
    }

    /// Standard deviation of the direction [deg].
    [[nodiscard]] double doubt_deg(double depth) const {
        const Eigen::Vector4d slope = slope_of(depth);
        return std::sqrt(2.0 * slope.dot(spread_ * slope)) * 180.0 / std::numbers::pi;
    }

private:
    static Eigen::Vector4d slope_of(double depth) {
        return {0.0, 1.0, 2.0 * depth, 3.0 * depth * depth};
    }

    Eigen::Matrix<double, 4, 3> cubic_;
    Eigen::Matrix4d spread_;
};

}  // namespace

std::optional<OpeningAxis> axis_inward(const Surface& surface, const Plane& plane, double diameter,
                                       double outward) {
    const Track track = track_of(surface, plane, diameter, outward);
    if (track.size() < 4) return std::nullopt;
    const VesselLine line(track, diameter);
    const double last = std::ranges::max_element(track, {}, &TrackSection::depth)->depth;
    const double turned = std::min(kDirectionAt + 1.0, last);
    const Vec3 inward = line.direction(kDirectionAt);
    const double span = turned - kDirectionAt;
    OpeningAxis axis{
        .direction = -inward,
        .bend_deg = span > 0.0 ? angle_deg(inward, line.direction(turned)) / span : 0.0,
        .doubt_deg = line.doubt_deg(kDirectionAt),
        .diameter = diameter,
        .depth = last,
        .sections = static_cast<int>(track.size()) - 1};
    axis.tilt_deg = angle_deg(axis.direction, plane.normal);
    return axis;
}

std::optional<OpeningAxis> axis_by_wall(const Surface& surface, const Plane& plane,
                                        const OpeningAxis& by_sections, double whole) {
    const double diameter = by_sections.diameter;
    const auto wall = wall_axis(surface, plane, diameter, {whole / diameter, by_sections.depth});
    if (!wall || wall->doubt_deg > std::max(by_sections.doubt_deg, kKnownDoubt))
        return std::nullopt;
    OpeningAxis axis = by_sections;
    axis.direction = wall->direction;
    axis.tilt_deg = angle_deg(wall->direction, plane.normal);
    axis.bend_deg = wall->bend_deg;
    axis.doubt_deg = wall->doubt_deg;
    return axis;
}

std::optional<OpeningAxis> axis_at_patch(const Surface& surface, std::size_t patch) {
    const PatchShape shape = patch_shape(surface, patch);
    const Surface part = part_near(surface, shape.plane.point, 2.5 * shape.diameter());
    const auto by_sections = axis_inward(part, shape.plane, shape.diameter());
    if (!by_sections) return std::nullopt;
    const auto by_wall = axis_by_wall(part, shape.plane, *by_sections);
    return by_wall ? by_wall : by_sections;
}

double opening_tilt_deg(const Surface& surface, std::size_t patch) {
    const auto axis = axis_at_patch(surface, patch);
    return axis ? axis->tilt_deg : 90.0;
}

}  // namespace vesselbench
