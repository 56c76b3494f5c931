#include "geometry/vessel/artefacts/wall_relief.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include <tbb/parallel_for.h>

#include "geometry/kernel/disjoint_sets.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/wall_edges.h"
#include "geometry/vessel/centerlines/branch_queries.h"
#include "geometry/vessel/centerlines/line_radii.h"
#include "geometry/vessel/tree/tube_fit.h"

namespace vesselbench {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// Lengths in radii of the vessel.
constexpr double kHalfStretch = 1.25;
constexpr double kStep = 0.25;      ///< between the middles of two stretches
constexpr double kFromEnds = 0.75;  ///< caps and rounded ends are no tube
constexpr double kFarthest = 1.8;   ///< from the line: what is farther off is another body's wall

/// An ellipse around a line and a radius that bend as a vessel does.
using Fit = TubeFit<3, 2>;

constexpr std::size_t kFewest = 4 * Fit::kUnknowns;  ///< vertices of a stretch
constexpr int kSectors = 8;  ///< each has vertices, or the wall is not all around
/// The deviation is kNormalScatter to three digits, with which the limits of findings were chosen;
/// below `least` no vertex is an outlier [radii].
constexpr TubeWeights kWeights = {.deviation = 1.483, .least = 0.004, .ridge = 1e-10};

/// Vertices in the coordinates of a stretch, in radii.
struct StretchWall {
    std::vector<VertexId> vertices;
    std::vector<TubeSample> samples;
};

bool is_all_around(const std::vector<TubeSample>& points) {
    std::array<int, kSectors> counts{};
    for (const TubeSample& at : points) {
        const double turn = (at.angle + std::numbers::pi) / (2.0 * std::numbers::pi);
        ++counts[static_cast<std::size_t>(
            std::clamp(static_cast<int>(turn * kSectors), 0, kSectors - 1))];
    }
    return std::ranges::count(counts, 0) == 0;
}

/// The wall of one branch, vertices in the order of their places along it.
struct BranchWall {
    const CenterlineBranch* line = nullptr;
    double from = 0.0, to = 0.0;  ///< where the wall is that of a tube [mm]
    std::vector<std::pair<double, VertexId>> vertices;
};

/// Inward from a node, up to where the branch's wall is its own [mm].
double beyond_node(const CenterlineGraph& graph, std::size_t branch, std::size_t node) {
    if (graph.nodes[node].is_tip()) return kFromEnds * tip_radius(graph, node);
    return furcation_zone_end(graph, branch, node) + kStep * graph.nodes[node].radius;
}

std::vector<BranchWall> walls_of(const Surface& surface, const CenterlineGraph& graph) {
    std::vector<BranchWall> walls(graph.branches.size());
    for (std::size_t b = 0; b < walls.size(); ++b) {
        const CenterlineBranch& line = graph.branches[b];
        walls[b].line = &line;
        walls[b].from = beyond_node(graph, b, line.start_node);
        walls[b].to = branch_length(line) - beyond_node(graph, b, line.end_node);
    }
    const std::vector<std::uint8_t> on_wall = vertices_of_wall(surface);
    const std::vector<BranchPlace> places = places_on_nearest_lines(graph, surface.points());
    for (VertexId v = 0; v < places.size(); ++v)
        if (on_wall[v] != 0) walls[places[v].branch].vertices.emplace_back(places[v].abscissa, v);
    for (BranchWall& wall : walls) std::ranges::sort(wall.vertices);
    return walls;
}

/// Fits the stretches of one branch; writes to the branch's own vertices only.
class BranchRelief {
public:
    BranchRelief(const Surface& surface, const BranchWall& wall, WallRelief& relief)
        : surface_(surface), wall_(wall), relief_(relief) {}

    void fill(const Progress& cancel) {
        double at = wall_.from;
        while (at < wall_.to) {
            cancel.check_cancelled();
            const double radius = radius_at(*wall_.line, at);
            if (!(radius > 0.0)) return;
            const double next = at + kStep * radius;
            fit_at(0.5 * (at + std::min(next, wall_.to)), radius, {at, std::min(next, wall_.to)});
            at = next;
        }
    }

private:
    /// \param own the places along the line whose vertices get their heights from this stretch
    void fit_at(double middle, double radius, std::pair<double, double> own) {
        const double half = kHalfStretch * radius;
        const auto [vertices, samples] = wall_between(
            std::max(middle - half, wall_.from), std::min(middle + half, wall_.to), middle, radius);
        if (samples.size() < kFewest || !is_all_around(samples)) return;
        const Fit fit(samples, 0.1, kWeights, Fit::Normal::Zero(), Fit::Unknowns::Zero());
        if (!fit.determined) return;
        for (std::size_t i = 0; i < samples.size(); ++i) {
            const double place = middle + samples[i].along * radius;
            if (place < own.first || place >= own.second) continue;
            relief_.heights[vertices[i]] = fit.rest[static_cast<Eigen::Index>(i)];
            relief_.radii[vertices[i]] = radius;
            relief_.scatter[vertices[i]] = fit.deviation;
        }
    }

    [[nodiscard]] StretchWall wall_between(double from, double to, double middle,
                                           double radius) const {
        const Vec3 centre = point_at(*wall_.line, middle);
        const Vec3 axis = tangent_at(*wall_.line, middle, radius);
        const Vec3 x = axis.unitOrthogonal(), y = axis.cross(x);
        StretchWall found;
        const auto first =
            std::ranges::lower_bound(wall_.vertices, from, {}, &std::pair<double, VertexId>::first);
        for (auto it = first; it != wall_.vertices.end() && it->first <= to; ++it) {
            const Vec3 d = (surface_.points()[it->second] - centre) / radius;
            const Eigen::Vector2d off(d.dot(x), d.dot(y));
            if (off.norm() > kFarthest) continue;
            found.vertices.push_back(it->second);
            found.samples.push_back({.along = (it->first - middle) / radius,
                                     .angle = std::atan2(off.y(), off.x()),
                                     .distance = off.norm(),
                                     .out = off.normalized()});
        }
        return found;
    }

    const Surface& surface_;
    const BranchWall& wall_;
    WallRelief& relief_;
};

// What makes a spot.
constexpr double kLeastHeight = 0.06;  ///< [radii]
constexpr double kLeastScatter = 2.5;  ///< [standard deviations]
constexpr std::size_t kLeastVertices = 3;
constexpr double kWidest = 1.0;  ///< radius of its circle [radii]

/// 1: a bump's, -1: a dent's, 0: none.
int side_of(const WallRelief& relief, VertexId v) {
    const double height = relief.heights[v];
    const double least = std::max(kLeastHeight, kLeastScatter * relief.scatter[v]);
    if (!(std::abs(height) > least)) return 0;
    return height > 0.0 ? 1 : -1;
}

/// A third of the area of each triangle is its corner's [mm^2].
std::vector<double> vertex_areas(const Surface& surface) {
    std::vector<double> areas(surface.vertex_count(), 0.0);
    for (const Triangle& triangle : surface.triangles())
        for (const VertexId v : triangle)
            areas[v] += triangle_area(surface.points(), triangle) / 3.0;
    return areas;
}

WallSpot spot_of(const Surface& surface, const WallRelief& relief,
                 const std::vector<VertexId>& vertices, const std::vector<double>& areas) {
    double area = 0.0;
    for (const VertexId v : vertices) area += areas[v];
    const VertexId top = *std::ranges::max_element(
        vertices, {}, [&](VertexId v) { return std::abs(relief.heights[v]); });
    const double radius = relief.radii[top];
    return {surface.points()[top], relief.heights[top] * radius, std::sqrt(area / std::numbers::pi),
            radius, relief.scatter[top] * radius};
}

}  // namespace

WallRelief wall_relief(const Surface& surface, const CenterlineGraph& graph,
                       const Progress& progress) {
    WallRelief relief{.heights = std::vector<double>(surface.vertex_count(), kNone),
                      .radii = std::vector<double>(surface.vertex_count(), 0.0),
                      .scatter = std::vector<double>(surface.vertex_count(), 0.0)};
    const std::vector<BranchWall> walls = walls_of(surface, graph);
    tbb::parallel_for(std::size_t{0}, walls.size(), [&](std::size_t b) {
        BranchRelief(surface, walls[b], relief).fill(progress);
    });
    return relief;
}

std::vector<WallSpot> wall_spots(const Surface& surface, const WallRelief& relief) {
    DisjointSets sets(surface.vertex_count());
    const CompressedRows& rings = surface.topology->rings();
    const auto count = static_cast<VertexId>(surface.vertex_count());
    for (VertexId v = 0; v < count; ++v)
        if (const int side = side_of(relief, v); side != 0)
            for (const VertexId u : rings.row(v))
                if (side_of(relief, u) == side) sets.join(u, v);
    std::map<VertexId, std::vector<VertexId>> groups;
    for (VertexId v = 0; v < count; ++v)
        if (side_of(relief, v) != 0) groups[sets.root(v)].push_back(v);
    const std::vector<double> areas = vertex_areas(surface);
    std::vector<WallSpot> spots;
    for (const auto& [root, vertices] : groups) {
        if (vertices.size() < kLeastVertices) continue;
        const WallSpot spot = spot_of(surface, relief, vertices, areas);
        if (spot.size <= kWidest * spot.radius) spots.push_back(spot);
    }
    std::ranges::stable_sort(spots, std::greater{}, [](const WallSpot& spot) {
        return std::abs(spot.height) / spot.scatter;
    });
    return spots;
}

}  // namespace vesselbench
