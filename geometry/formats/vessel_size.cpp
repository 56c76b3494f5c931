#include "geometry/formats/vessel_size.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "geometry/kernel/measure.h"

namespace vesselbench {

namespace {

/// Natural logarithms of typical radius, extent and mean edge [mm].
using Sizes = Eigen::Vector3d;

/// Vessels of a kind, as one Gaussian.
struct Kind {
    Sizes mean;
    Eigen::Matrix3d covariance;
};

Eigen::Matrix3d symmetric(double radius, double radius_extent, double radius_edge, double extent,
                          double extent_edge, double edge) {
    return (Eigen::Matrix3d() << radius, radius_extent, radius_edge, radius_extent, extent,
            extent_edge, radius_edge, extent_edge, edge)
        .finished();
}

/// Thin, medium and wide ones, from intracranial arteries to aortas and atria.
const std::array<Kind, 3>& kinds() {
    static const std::array<Kind, 3> known = {
        {{{0.21, 3.39, -0.64}, symmetric(0.08, -0.01, 0.0, 0.27, 0.04, 0.40)},
         {{0.87, 3.64, -0.61}, symmetric(0.09, 0.14, 0.06, 0.52, 0.19, 0.61)},
         {{2.22, 5.28, 0.16}, symmetric(0.07, -0.03, 0.03, 0.24, 0.09, 0.47)}}};
    return known;
}

constexpr double kOutlier = 1e-4;  ///< density of what is none of them

/// Where models lie: most in the patient's coordinates, whose distance from the origin is a
/// Gaussian in its logarithm; some were moved to the origin, which tells nothing; some are
/// anywhere.
constexpr double kDistanceMean = 4.77, kDistanceDeviation = 0.74;
constexpr double kOfPatient = 0.7;
constexpr double kCentred = 0.25 * 0.3;
constexpr double kAnywhere = 0.05 / 12.0;
constexpr double kNearOrigin = 0.75;  ///< of the extent

/// Limits [mm]: the thinnest lumen that images resolve, the widest valve of a heart, the root of
/// the area of a heart or of both lungs' arteries (0.1 m^2), the smallest excerpt, a whole body.
constexpr double kThinnestOpening = 0.5;
constexpr double kWidestOpening = 25.0;
constexpr double kLargestSide = 450.0;
constexpr double kSmallestExtent = 6.0;
constexpr double kLargestExtent = 1000.0;
constexpr double kPerLimit = 2.0;   ///< of the logarithm by which a limit is missed
constexpr double kNoVessel = 20.0;  ///< such a reading loses against any other

/// Above this ratio of extent to radius the volume is meaningless (scattered or reversed
/// triangles).
constexpr double kSlimmestTree = 400.0;

/// Area and length of a loop: its equivalent radius if it is round, else 0.
double round_radius(const Positions& points, const std::vector<VertexId>& loop) {
    constexpr std::size_t kFewestEdges = 8;
    constexpr double kRound = 0.7;  // isoperimetric ratio [-]
    if (loop.size() < kFewestEdges) return 0.0;
    Vec3 normal = Vec3::Zero();
    double length = 0.0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Vec3 &a = points[loop[i]], &b = points[loop[(i + 1) % loop.size()]];
        normal += 0.5 * (a - points[loop[0]]).cross(b - points[loop[0]]);
        length += (b - a).norm();
    }
    const double enclosed = normal.norm();
    if (4.0 * std::numbers::pi * enclosed < kRound * length * length) return 0.0;
    return std::sqrt(enclosed / std::numbers::pi);
}

/// Density of the sizes from `first` on.
double density(const Kind& kind, const Sizes& sizes, Eigen::Index first) {
    const Eigen::Index count = sizes.size() - first;
    const Eigen::MatrixXd covariance = kind.covariance.bottomRightCorner(count, count);
    const Eigen::VectorXd off = (sizes - kind.mean).tail(count);
    const double exponent = -0.5 * off.dot(covariance.ldlt().solve(off));
    return std::exp(exponent) /
           std::sqrt(std::pow(2.0 * std::numbers::pi, double(count)) * covariance.determinant());
}

double shape_density(const VesselSize& size, double millimetres) {
    const bool has_radius = size.radius > 0.0;
    const Sizes sizes(has_radius ? std::log(millimetres * size.radius) : 0.0,
                      std::log(millimetres * size.extent), std::log(millimetres * size.edge));
    double sum = 0.0;
    for (const Kind& kind : kinds()) sum += density(kind, sizes, has_radius ? 0 : 1);
    return sum / static_cast<double>(kinds().size()) + kOutlier;
}

double place_density(const VesselSize& size, double millimetres) {
    double result = kAnywhere;
    if (size.distance < kNearOrigin * size.extent) result += kCentred;
    if (size.distance == 0.0) return result;
    const double off = (std::log(millimetres * size.distance) - kDistanceMean) / kDistanceDeviation;
    return result + kOfPatient * std::exp(-0.5 * off * off) /
                        (kDistanceDeviation * std::sqrt(2.0 * std::numbers::pi));
}

double too_small(double value, double limit) {
    return value > 0.0 && value < limit ? std::log(limit / value) : 0.0;
}

double too_large(double value, double limit) {
    return value > limit ? std::log(value / limit) : 0.0;
}

}  // namespace

VesselSize vessel_size(const Surface& surface) {
    const auto box = bounds(surface);
    VesselSize size{.extent = box.diagonal(),
                    .edge = mean_edge_length(surface),
                    .distance = box.centre().norm()};
    const double surface_area = area(surface);
    size.side = std::sqrt(surface_area);
    if (surface_area > 0.0) size.radius = 2.0 * std::abs(volume(surface)) / surface_area;
    if (size.extent > kSlimmestTree * size.radius) size.radius = 0.0;
    for (const auto& loop : surface.topology->boundary_loops()) {
        const double radius = round_radius(surface.points(), loop);
        if (radius > 0.0 && (size.opening == 0.0 || radius < size.opening)) size.opening = radius;
        size.mouth = std::max(size.mouth, radius);
    }
    return size;
}

double log_plausibility(const VesselSize& size, double millimetres) {
    if (size.extent == 0.0 || size.edge == 0.0) return 0.0;
    const double missed = too_small(millimetres * size.opening, kThinnestOpening) +
                          too_large(millimetres * size.mouth, kWidestOpening) +
                          too_large(millimetres * size.side, kLargestSide) +
                          too_small(millimetres * size.extent, kSmallestExtent);
    return std::log(shape_density(size, millimetres)) + std::log(place_density(size, millimetres)) -
           kPerLimit * missed - (is_beyond_vessels(millimetres * size.extent) ? kNoVessel : 0.0);
}

bool is_beyond_vessels(double extent) {
    return extent > kLargestExtent;
}

}  // namespace vesselbench
