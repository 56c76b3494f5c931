#include "geometry/vessel/tree/flight_path.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "geometry/kernel/cross_section.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/shortest_paths.h"
#include "geometry/vessel/centerlines/branch_queries.h"
#include "geometry/vessel/centerlines/tip_name.h"

namespace vesselbench {

namespace {

constexpr double kNear = 2.0;    ///< an opening so many radii from an end is that end's [-]
constexpr double kAhead = 1.5;   ///< the camera looks towards what is so many radii ahead [-]
constexpr double kBehind = 0.5;  ///< and away from what is so far behind

const PatchMeasures* opening_at(const std::vector<PatchMeasures>& openings,
                                const CenterlineGraph& graph, std::size_t tip) {
    const Vec3& place = graph.nodes[tip].position;
    const PatchMeasures* nearest = nullptr;
    double reach = kNear * tip_radius(graph, tip);
    for (const PatchMeasures& opening : openings) {
        const double distance = (opening.centroid - place).norm();
        if (distance >= reach) continue;
        reach = distance;
        nearest = &opening;
    }
    return nearest;
}

std::size_t start_of(const CenterlineGraph& graph, const std::vector<PatchMeasures>& openings,
                     const std::vector<std::size_t>& tips) {
    for (const std::size_t tip : tips) {
        const PatchMeasures* opening = opening_at(openings, graph, tip);
        if (opening != nullptr && opening->kind == PatchKind::Inlet) return tip;
    }
    return tips.front();
}

/// The branch by which each node is reached on the shortest way from a start; none: not reached.
std::vector<std::optional<std::size_t>> ways_from(const CenterlineGraph& graph, std::size_t start) {
    std::vector<double> distances(graph.nodes.size(), std::numeric_limits<double>::infinity());
    std::vector<std::optional<std::size_t>> ways(graph.nodes.size());
    ShortestPaths paths(distances);
    paths.lower(static_cast<std::uint32_t>(start), 0.0);
    while (const auto at = paths.next())
        for (const std::size_t b : graph.nodes[at->vertex].branches) {
            const std::size_t end = other_node(graph, b, at->vertex);
            const double distance = at->distance + branch_length(graph.branches[b]);
            if (distance < distances[end]) ways[end] = b;
            paths.lower(static_cast<std::uint32_t>(end), distance);
        }
    ways[start].reset();
    return ways;
}

/// A branch and whether it is flown from its end to its start.
using Flown = std::pair<std::size_t, bool>;

/// Along the vessel, about as far as its radius reaches, so that the view does not shake.
Vec3 direction_at(const Tube& tube, double abscissa) {
    const double radius = tube.radius(abscissa), length = tube.length();
    const double ahead = std::min(abscissa + kAhead * radius, length);
    const double behind = std::max(std::min(abscissa, length - radius) - kBehind * radius, 0.0);
    const Vec3 way = tube.centre(tube.at(ahead)) - tube.centre(tube.at(behind));
    if (way.norm() > 1e-9) return way.normalized();
    return (tube.points().back() - tube.points().front()).stableNormalized();
}

/// None: the branches have no length.
std::optional<FlightPath> path_along(const CenterlineGraph& graph, std::string name,
                                     const std::vector<Flown>& branches) {
    Positions points;
    std::vector<double> radii;
    for (const auto& [b, backwards] : branches) {
        const CenterlineBranch& branch = graph.branches[b];
        const std::size_t count = branch.points.size();
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t at = backwards ? count - 1 - i : i;
            const Vec3& point = branch.points[at];
            if (!points.empty() && !((point - points.back()).norm() > 1e-9)) continue;
            points.push_back(point);
            radii.push_back(branch.radii[at]);
        }
    }
    if (points.size() < 2) return std::nullopt;
    Vec3 up = Vec3(0, -1, 0);  // the patient's front, for vessels that run along the body
    const Tube tube(points, radii);
    if (std::abs(direction_at(tube, 0.0).dot(up)) > 0.7) up = Vec3::UnitZ();
    return FlightPath{std::move(name), Tube(std::move(points), std::move(radii), up)};
}

/// The branches from the start to an end.
std::vector<Flown> way_to(const CenterlineGraph& graph, std::size_t end,
                          const std::vector<std::optional<std::size_t>>& ways) {
    std::vector<Flown> branches;
    for (std::size_t node = end; ways[node];) {
        const CenterlineBranch& branch = graph.branches[*ways[node]];
        branches.emplace_back(*ways[node], branch.end_node != node);
        node = other_node(graph, *ways[node], node);
    }
    std::ranges::reverse(branches);
    return branches;
}

std::vector<FlightPath> paths_of_loops(const CenterlineGraph& graph) {
    std::vector<FlightPath> paths;
    for (std::size_t b = 0; b < graph.branches.size(); ++b)
        if (auto path =
                path_along(graph, "Branch " + std::to_string(paths.size() + 1), {{b, false}}))
            paths.push_back(std::move(*path));
    return paths;
}

}  // namespace

std::vector<FlightPath> flight_paths(const CenterlineGraph& graph,
                                     const std::vector<PatchMeasures>& openings) {
    const std::vector<std::size_t> tips = tips_by_radius(graph);
    if (tips.empty()) return paths_of_loops(graph);
    const std::size_t start = start_of(graph, openings, tips);
    const auto ways = ways_from(graph, start);
    std::vector<FlightPath> paths;
    for (const std::size_t tip : tips) {
        if (tip == start) continue;
        const PatchMeasures* opening = opening_at(openings, graph, tip);
        if (auto path = path_along(graph, opening ? opening->name : tip_name(graph, tip),
                                   way_to(graph, tip, ways)))
            paths.push_back(std::move(*path));
    }
    return paths;
}

FlightPlace place_on(const FlightPath& path, double abscissa) {
    const Tube& tube = path.tube;
    if (tube.points().size() < 2) throw InvalidInput("a flight path needs two points");
    const double along = std::clamp(abscissa, 0.0, tube.length());
    const AxisPlace at = tube.at(along);
    FlightPlace place{
        .eye = tube.centre(at), .view = direction_at(tube, along), .radius = tube.radius(at)};
    const Vec3 up = tube.first(at) - tube.first(at).dot(place.view) * place.view;
    place.up = up.norm() > 1e-3 ? Vec3(up.normalized()) : plane_axes(place.view).first;
    return place;
}

}  // namespace vesselbench
