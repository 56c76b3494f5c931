#include "geometry/vessel/centerlines/flight_path.h"

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

std::size_t other_end(const CenterlineBranch& branch, std::size_t node) {
    return branch.start_node == node ? branch.end_node : branch.start_node;
}

/// The branch by which each node is reached on the shortest way from a start; none: not reached.
std::vector<std::optional<std::size_t>> ways_from(const CenterlineGraph& graph, std::size_t start) {
    std::vector<double> distances(graph.nodes.size(), std::numeric_limits<double>::infinity());
    std::vector<std::optional<std::size_t>> ways(graph.nodes.size());
    ShortestPaths paths(distances);
    paths.lower(static_cast<std::uint32_t>(start), 0.0);
    while (const auto at = paths.next())
        for (const std::size_t b : graph.nodes[at->vertex].branches) {
            const CenterlineBranch& branch = graph.branches[b];
            const std::size_t end = other_end(branch, at->vertex);
            const double distance = at->distance + branch_length(branch);
            if (distance < distances[end]) ways[end] = b;
            paths.lower(static_cast<std::uint32_t>(end), distance);
        }
    ways[start].reset();
    return ways;
}

void append(FlightPath& path, const CenterlineBranch& branch, bool backwards) {
    const std::size_t count = branch.points.size();
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t at = backwards ? count - 1 - i : i;
        const Vec3& point = branch.points[at];
        if (!path.points.empty() && !((point - path.points.back()).norm() > 1e-9)) continue;
        path.points.push_back(point);
        path.radii.push_back(branch.radii[at]);
    }
}

/// Of values at the points of a path.
template <class Value>
Value interpolated(const FlightPath& path, const std::vector<Value>& values, double abscissa) {
    const auto next = std::ranges::upper_bound(path.abscissas, abscissa);
    if (next == path.abscissas.begin()) return values.front();
    if (next == path.abscissas.end()) return values.back();
    const auto i = static_cast<std::size_t>(next - path.abscissas.begin());
    const double share =
        (abscissa - path.abscissas[i - 1]) / (path.abscissas[i] - path.abscissas[i - 1]);
    return values[i - 1] + share * (values[i] - values[i - 1]);
}

/// Along the vessel, about as far as its radius reaches, so that the view does not shake.
Vec3 direction_at(const FlightPath& path, double abscissa) {
    const double radius = interpolated(path, path.radii, abscissa);
    const double length = path.length();
    const double ahead = std::min(abscissa + kAhead * radius, length);
    const double behind = std::max(std::min(abscissa, length - radius) - kBehind * radius, 0.0);
    const Vec3 way =
        interpolated(path, path.points, ahead) - interpolated(path, path.points, behind);
    if (way.norm() > 1e-9) return way.normalized();
    return (path.points.back() - path.points.front()).stableNormalized();
}

/// The part of `up` that is perpendicular to a direction; any such vector if there is none.
Vec3 upright(const Vec3& up, const Vec3& direction) {
    const Vec3 part = up - up.dot(direction) * direction;
    return part.norm() > 1e-3 ? Vec3(part.normalized()) : plane_axes(direction).first;
}

void complete(FlightPath& path) {
    path.abscissas.assign(1, 0.0);
    for (std::size_t i = 1; i < path.points.size(); ++i)
        path.abscissas.push_back(path.abscissas.back() +
                                 (path.points[i] - path.points[i - 1]).norm());
    Vec3 up = Vec3(0, -1, 0);  // the patient's front, for vessels that run along the body
    if (std::abs(direction_at(path, 0.0).dot(up)) > 0.7) up = Vec3::UnitZ();
    for (const double abscissa : path.abscissas) {
        up = upright(up, direction_at(path, abscissa));
        path.ups.push_back(up);
    }
}

std::optional<FlightPath> path_to(const CenterlineGraph& graph, std::size_t end,
                                  const std::vector<std::optional<std::size_t>>& ways) {
    std::vector<std::pair<std::size_t, bool>> branches;  // from the end; true: flown backwards
    for (std::size_t node = end; ways[node];) {
        const CenterlineBranch& branch = graph.branches[*ways[node]];
        branches.emplace_back(*ways[node], branch.end_node != node);
        node = other_end(branch, node);
    }
    FlightPath path;
    for (auto i = branches.rbegin(); i != branches.rend(); ++i)
        append(path, graph.branches[i->first], i->second);
    if (path.points.size() < 2) return std::nullopt;
    complete(path);
    return path;
}

std::vector<FlightPath> paths_of_loops(const CenterlineGraph& graph) {
    std::vector<FlightPath> paths;
    for (const CenterlineBranch& branch : graph.branches) {
        FlightPath path{.name = "Branch " + std::to_string(paths.size() + 1)};
        append(path, branch, false);
        if (path.points.size() < 2) continue;
        complete(path);
        paths.push_back(std::move(path));
    }
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
        auto path = path_to(graph, tip, ways);
        if (!path) continue;
        const PatchMeasures* opening = opening_at(openings, graph, tip);
        path->name = opening != nullptr ? opening->name : tip_name(graph, tip);
        paths.push_back(std::move(*path));
    }
    return paths;
}

FlightPlace place_on(const FlightPath& path, double abscissa) {
    if (path.points.size() < 2) throw InvalidInput("a flight path needs two points");
    const double at = std::clamp(abscissa, 0.0, path.length());
    FlightPlace place{.eye = interpolated(path, path.points, at),
                      .view = direction_at(path, at),
                      .radius = interpolated(path, path.radii, at)};
    const auto next = std::ranges::lower_bound(path.abscissas, at) - path.abscissas.begin();
    place.up = upright(path.ups[std::min(static_cast<std::size_t>(next), path.ups.size() - 1)],
                       place.view);
    return place;
}

}  // namespace vesselbench
