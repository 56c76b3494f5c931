#include "smoothing/context/voxel_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "geometry/kernel/statistics.h"
#include "geometry/kernel/surface.h"

namespace vesselbench {

namespace {

constexpr double kInPlane = 0.004;  // sine of the angle between a plane and an edge in it
constexpr double kOblique = 0.05;   // of one that does not lie in it
constexpr double kShortEdge = 0.3;  // of the median length: shorter edges have no safe direction
constexpr std::size_t kMostEdges = 6000;
constexpr std::size_t kFewestEdges = 100;
constexpr std::size_t kTrials = 1500;  // one pair of edges in ten shares a plane
constexpr std::size_t kTrialEdges = 600;
constexpr double kShareInPlanes = 0.5;  // of the edges in planes of any axis; marching cubes: 2/3
constexpr double kShareOfAxis = 0.04;   // of the edges in planes of one axis alone; chance: 0.004

constexpr double kSamePlane = 2e-4;  // of the median edge: vertices of one plane
constexpr double kOnPlanes = 0.25;   // share of the vertices in planes of an axis, at least
constexpr std::size_t kFewestPlanes = 4;
constexpr double kOffPeriod = 0.06;      // of the distance, for planes that fit it
constexpr double kPlanesInPeriod = 0.8;  // share of such planes, at least

constexpr double kAlongDirection = 2.0;  // between a mask's face and its direction [deg]
constexpr double kShareOfMask = 0.9;     // of the faces, at least; whole masks have 0.99

/// Directions of the edges; at most about kMostEdges of them.
std::vector<Vec3> edge_directions(const Topology& topology, const Positions& positions,
                                  double& median_length) {
    const auto triangles = topology.triangles();
    const std::size_t step = std::max<std::size_t>(1, 3 * triangles.size() / kMostEdges / 3);
    std::vector<Vec3> edges;
    std::vector<double> lengths;
    for (std::size_t t = 0; t < triangles.size(); t += step)
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 e = positions[triangles[t][(k + 1) % 3]] - positions[triangles[t][k]];
            const double length = e.norm();
            if (!std::isfinite(length) || !(length > 0.0)) continue;
            edges.emplace_back(e);
            lengths.push_back(length);
        }
    median_length = lengths.empty() ? 0.0 : median(std::move(lengths));
    std::erase_if(edges, [&](const Vec3& e) { return e.norm() < kShortEdge * median_length; });
    for (Vec3& e : edges) e.normalize();
    return edges;
}

std::size_t edges_in_planes(const std::vector<Vec3>& edges, const Vec3& axis, std::size_t step) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < edges.size(); i += step)
        count += std::abs(edges[i].dot(axis)) < kInPlane ? 1 : 0;
    return count;
}

/// The direction that most edges are at a right angle to, among those of random pairs of edges.
Vec3 first_axis(const std::vector<Vec3>& edges) {
    std::uint64_t state = 1;  // fixed: the same axis every time
    const auto draw = [&] {
        state = state * 6364136223846793005ULL + 1442695040888963407ULL;
        return static_cast<std::size_t>(state >> 33U) % edges.size();
    };
    const std::size_t step = std::max<std::size_t>(1, edges.size() / kTrialEdges);
    Vec3 best = Vec3::UnitZ();
    std::size_t most = 0;
    for (std::size_t trial = 0; trial < kTrials; ++trial) {
        const Vec3 across = edges[draw()].cross(edges[draw()]);
        if (across.norm() < 0.3) continue;
        const std::size_t count = edges_in_planes(edges, across.normalized(), step);
        if (count <= most) continue;
        most = count;
        best = across.normalized();
    }
    return best;
}

/// The axis that fits the edges in its planes best. Edges that only nearly lie in them turn it by
/// more than the planes are apart, so that fewer count each time.
Vec3 refined_axis(const std::vector<Vec3>& edges, Vec3 axis) {
    for (const double share : {1.0, 0.5, 0.2, 0.1, 0.05}) {
        Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
        for (const Vec3& e : edges)
            if (std::abs(e.dot(axis)) < share * kInPlane) sum += e * e.transpose();
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(sum);
        if (!(solver.eigenvalues()[1] > 0.0)) break;
        const Vec3 next = solver.eigenvectors().col(0);
        axis = next.dot(axis) < 0.0 ? Vec3(-next) : next;
    }
    return axis;
}

/// An axis at a right angle to the first one: that of most edges outside the first one's planes.
Vec3 second_axis(const std::vector<Vec3>& edges, const Vec3& first) {
    constexpr int kBins = 720;  // of a right angle
    const Vec3 u = first.unitOrthogonal(), v = first.cross(u);
    std::array<int, kBins> counts{};
    const auto angle_of = [&](const Vec3& e) {
        const Vec3 across = e.cross(first);
        const double angle = std::atan2(across.dot(v), across.dot(u)) / (0.5 * std::numbers::pi);
        return angle - std::floor(angle);  // in right angles: the third axis counts for the second
    };
    for (const Vec3& e : edges)
        if (std::abs(e.dot(first)) > kOblique && e.cross(first).norm() > kOblique)
            ++counts[static_cast<std::size_t>(angle_of(e) * kBins) % kBins];
    std::size_t best = 0;
    const auto around = [&](std::size_t b) {
        return counts[b] + counts[(b + 1) % kBins] + counts[(b + kBins - 1) % kBins];
    };
    for (std::size_t b = 0; b < kBins; ++b)
        if (around(b) > around(best)) best = b;
    const double angle = (static_cast<double>(best) + 0.5) / kBins * 0.5 * std::numbers::pi;
    return refined_axis(edges, std::cos(angle) * u + std::sin(angle) * v);
}

std::optional<Eigen::Matrix3d> grid_axes(const std::vector<Vec3>& edges) {
    if (edges.size() < kFewestEdges) return {};
    const Vec3 a = refined_axis(edges, first_axis(edges)), b = second_axis(edges, a);
    if (std::abs(a.dot(b)) > kInPlane) return {};
    Eigen::Matrix3d axes;
    axes.col(0) = (b - b.dot(a) * a).normalized();
    axes.col(1) = a.cross(Vec3(axes.col(0)));
    axes.col(2) = a;
    std::size_t in_planes = 0;
    std::array<std::size_t, 3> alone{};
    for (const Vec3& e : edges) {
        const Vec3 along = (axes.transpose() * e).cwiseAbs();
        in_planes += along.minCoeff() < kInPlane ? 1 : 0;
        for (int k = 0; k < 3; ++k)
            if (along[k] < kInPlane && along[(k + 1) % 3] > kOblique &&
                along[(k + 2) % 3] > kOblique)
                ++alone[static_cast<std::size_t>(k)];
    }
    const auto all = static_cast<double>(edges.size());
    if (static_cast<double>(in_planes) < kShareInPlanes * all) return {};
    if (static_cast<double>(*std::ranges::min_element(alone)) < kShareOfAxis * all) return {};
    return axes;
}

/// Vertices at one height.
struct Level {
    double height = 0.0;
    std::size_t vertices = 0;
};

/// Heights at which several vertices lie, ascending. A few lie at the same height by chance: they
/// are no plane beside those that hold many.
std::vector<Level> levels_of(std::vector<double> heights, double tolerance) {
    std::ranges::sort(heights);
    constexpr std::size_t kEnough = 4;  // vertices of a plane
    constexpr std::size_t kChance = 8;  // times fewer than those of the largest
    std::vector<Level> levels;
    std::size_t most = 0;
    for (std::size_t first = 0, last = 0; first < heights.size(); first = last) {
        for (last = first + 1; last < heights.size(); ++last)
            if (heights[last] - heights[last - 1] > tolerance) break;
        if (last - first < kEnough || heights[last - 1] - heights[first] > 4.0 * tolerance)
            continue;
        levels.push_back({heights[first + (last - first) / 2], last - first});
        most = std::max(most, last - first);
    }
    std::erase_if(levels, [&](const Level& level) { return kChance * level.vertices < most; });
    return levels;
}

/// Distance of the planes across an axis that hold many vertices [mm]; none without such planes.
std::optional<double> plane_distance(const Positions& positions, const Vec3& axis,
                                     double median_length) {
    std::vector<double> heights;
    for (const Vec3& p : positions)
        if (p.allFinite()) heights.push_back(p.dot(axis));
    const auto count = static_cast<double>(heights.size());
    const std::vector<Level> planes = levels_of(std::move(heights), kSamePlane * median_length);
    std::size_t vertices = 0;
    for (const Level& plane : planes) vertices += plane.vertices;
    if (planes.size() < kFewestPlanes || static_cast<double>(vertices) < kOnPlanes * count)
        return {};
    std::vector<double> gaps;
    for (std::size_t i = 1; i < planes.size(); ++i)
        gaps.push_back(planes[i].height - planes[i - 1].height);
    const double period = median(gaps);
    const auto fitting = std::ranges::count_if(gaps, [&](double gap) {
        const double periods = gap / period;
        return periods > 0.5 && std::abs(periods - std::round(periods)) < kOffPeriod;
    });
    if (static_cast<double>(fitting) < kPlanesInPeriod * static_cast<double>(gaps.size()))
        return {};
    return period;
}

}  // namespace

int VoxelGrid::longest() const {
    int longest = 2;
    for (int k = 0; k < 2; ++k)
        if (spacing[k] > kCubic * spacing[longest]) longest = k;
    return longest;
}

bool VoxelGrid::is_cubic() const {
    return spacing.maxCoeff() <= kCubic * spacing.minCoeff();
}

std::optional<VoxelGrid> interpolated_grid(const Topology& topology, const Positions& positions) {
    double median_length = 0.0;
    const auto axes = grid_axes(edge_directions(topology, positions, median_length));
    if (!axes) return {};
    VoxelGrid grid{.axes = *axes};
    for (int k = 0; k < 3; ++k) {
        const auto distance = plane_distance(positions, axes->col(k), median_length);
        if (!distance) return {};
        grid.spacing[k] = *distance;
    }
    return grid;
}

std::vector<Vec3> mask_directions(const VoxelGrid& grid) {
    std::vector<Vec3> directions;
    const auto sign = [](int digits) { return static_cast<double>(digits % 3 - 1); };
    for (int code = 14; code < 27; ++code) {  // one of each pair of opposites
        const Vec3 steps(sign(code / 9), sign(code / 3), sign(code));
        directions.push_back((grid.axes * steps.cwiseQuotient(grid.spacing)).normalized());
    }
    return directions;
}

bool is_of_mask(const Topology& topology, const Positions& positions, const VoxelGrid& grid) {
    const std::vector<Vec3> directions = mask_directions(grid);
    const double limit = std::cos(kAlongDirection * std::numbers::pi / 180.0);
    std::size_t valid = 0, along = 0;
    for (const Triangle& t : topology.triangles()) {
        const Vec3 normal = area_normal(positions, t);
        const double length = normal.norm();
        if (!(length > 0.0) || !std::isfinite(length)) continue;
        ++valid;
        along += std::ranges::any_of(
            directions, [&](const Vec3& d) { return std::abs(normal.dot(d)) >= limit * length; });
    }
    return valid > 0 && static_cast<double>(along) >= kShareOfMask * static_cast<double>(valid);
}

}  // namespace vesselbench
