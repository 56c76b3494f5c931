#include "geometry/vessel/artefacts/short_branches.h"

#include <algorithm>
#include <cstdint>

#include "geometry/vessel/centerlines/branch_queries.h"
#include "geometry/vessel/centerlines/strands.h"
#include "geometry/vessel/centerlines/vessel_wall.h"

namespace vesselbench {

namespace {

constexpr double kShort = 2.5;       ///< length [diameters]
constexpr double kLeastRise = 0.25;  ///< of a branch without a line [radii of its parent]
constexpr double kAtEnd = 1.0;       ///< of a tip from an end's centre [radii of the end]

bool is_at_end(const Vec3& tip, std::span<const VesselEnd> ends) {
    return std::ranges::any_of(ends, [&](const VesselEnd& end) {
        return (tip - end.centre).norm() < kAtEnd * end.radius;
    });
}

/// A tip's branch, as far as it is outside its parent.
ShortBranch branch_at(const CenterlineGraph& graph, std::size_t tip) {
    const std::size_t branch = branch_of_tip(graph, tip);
    const std::size_t node = other_node(graph, branch, tip);
    const double radius = tip_radius(graph, tip);
    return {.tip = graph.nodes[tip].position,
            .length = branch_length(graph.branches[branch]) - parents_exit(graph, branch, node) +
                      graph.nodes[tip].radius,
            .diameter = 2.0 * radius,
            .parent = 2.0 * graph.nodes[node].radius,
            .has_line = true};
}

/// True for branches that leave a vessel sideways, by branch.
std::vector<std::uint8_t> side_branches(const CenterlineGraph& graph) {
    std::vector<std::uint8_t> sideways(graph.branches.size(), 0);
    for (const Strand& strand : find_strands(graph))
        if (strand.pieces.size() == 1) sideways[strand.pieces.front().branch] = 1;
    return sideways;
}

bool leaves_a_vessel(const CenterlineGraph& graph, std::size_t tip) {
    return !graph.nodes[other_node(graph, branch_of_tip(graph, tip), tip)].is_tip();
}

}  // namespace

std::vector<ShortBranch> short_branches(const Surface& surface, const CenterlineGraph& graph,
                                        std::span<const Stub> stubs, const Progress& progress) {
    const std::vector<VesselEnd> ends = vessel_wall_of(surface, progress).ends;
    const std::vector<std::uint8_t> sideways = side_branches(graph);
    std::vector<ShortBranch> found;
    for (const std::size_t tip : tips_by_radius(graph)) {
        if (sideways[branch_of_tip(graph, tip)] == 0 || !leaves_a_vessel(graph, tip) ||
            is_at_end(graph.nodes[tip].position, ends))
            continue;
        const ShortBranch branch = branch_at(graph, tip);
        if (branch.length < kShort * branch.diameter) found.push_back(branch);
    }
    for (const Stub& stub : stubs) {
        if (stub.length < kLeastRise * stub.parent || is_at_end(stub.tip, ends)) continue;
        found.push_back({.tip = stub.tip,
                         .length = stub.length,
                         .diameter = 2.0 * stub.widest,
                         .parent = 2.0 * stub.parent});
    }
    std::ranges::stable_sort(
        found, {}, [](const ShortBranch& branch) { return branch.length / branch.diameter; });
    return found;
}

}  // namespace vesselbench
