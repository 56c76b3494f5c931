#include "geometry/vessel/sac/sac_regions.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <queue>
#include <utility>

#include "geometry/vessel/centerlines/branch_queries.h"
#include "geometry/vessel/openings/branch_part.h"

namespace vesselbench {

namespace {

/// Widths that differ by less do not decide which vessel is the parent [-].
constexpr double kAsWide = 0.05;

constexpr std::size_t kNoVessel = std::numeric_limits<std::size_t>::max();

Vec3 middle_of(const Surface& surface, TriangleId t) {
    const auto& [a, b, c] = surface.triangles()[t];
    return (surface.points()[a] + surface.points()[b] + surface.points()[c]) / 3.0;
}

/// A neck's outline, to measure distances from.
class Outline {
public:
    explicit Outline(const SacPart& sac) : ends_(sac.outline), centre_(sac.neck_centroid) {
        for (const Vec3& x : ends_) radius_ = std::max(radius_, (x - centre_).norm());
    }

    [[nodiscard]] bool is_within(double reach, const Vec3& x) const {
        if ((x - centre_).norm() > reach + radius_) return false;
        for (std::size_t i = 0; i + 1 < ends_.size(); i += 2) {
            const Vec3 edge = ends_[i + 1] - ends_[i];
            const double length = edge.squaredNorm();
            const double t = length > 0.0 ? edge.dot(x - ends_[i]) / length : 0.0;
            if ((ends_[i] + std::clamp(t, 0.0, 1.0) * edge - x).norm() <= reach) return true;
        }
        return false;
    }

private:
    Positions ends_;
    Vec3 centre_;
    double radius_ = 0.0;
};

/// A vessel as it is found: the branch by which it leaves the surroundings, and where.
struct LeavingVessel {
    std::size_t branch = 0;
    std::size_t towards = 0;  ///< node of the graph outside
    Vec3 place = Vec3::Zero();
    double diameter = 0.0;
};

/// Walks from the sac's furcation along all other lines until they are out of reach.
class VesselWalk {
public:
    VesselWalk(const CenterlineGraph& graph, std::size_t own, const Outline& outline, double reach)
        : graph_(graph), outline_(outline), reach_(reach), vessel_of_(graph.branches.size()) {
        vessel_of_[own] = kNoVessel;
    }

    void from(std::size_t node) {
        std::queue<std::size_t> nodes;
        nodes.push(node);
        while (!nodes.empty()) {
            const std::size_t at = nodes.front();
            nodes.pop();
            for (const std::size_t b : graph_.nodes[at].branches)
                if (!vessel_of_[b])
                    if (const auto next = follow(b, at)) nodes.push(*next);
        }
    }

    [[nodiscard]] const std::vector<LeavingVessel>& vessels() const { return vessels_; }

    /// Of a branch: its vessel, kNoVessel between vessels; none: it was not reached.
    [[nodiscard]] std::optional<std::size_t> vessel_of(std::size_t branch) const {
        return vessel_of_[branch];
    }

private:
    /// \return the branch's other node, if the branch lies within reach
    std::optional<std::size_t> follow(std::size_t b, std::size_t node) {
        const CenterlineBranch& branch = graph_.branches[b];
        const bool forward = branch.start_node == node;
        const std::size_t count = branch.points.size(),
                          other = forward ? branch.end_node : branch.start_node;
        const auto at = [&](std::size_t k) { return forward ? k : count - 1 - k; };
        std::size_t i = 0;
        // The line is a radius away from its wall.
        while (i + 1 < count &&
               outline_.is_within(reach_ + branch.radii[at(i)], branch.points[at(i)]))
            ++i;
        if (i + 1 == count && !graph_.nodes[other].is_tip()) {
            vessel_of_[b] = kNoVessel;
            return other;
        }
        vessel_of_[b] = vessels_.size();
        vessels_.push_back({b, other, branch.points[at(i)], 2.0 * branch.radii[at(i)]});
        return std::nullopt;
    }

    const CenterlineGraph& graph_;
    const Outline& outline_;
    double reach_;
    std::vector<std::optional<std::size_t>> vessel_of_;
    std::vector<LeavingVessel> vessels_;
};

/// True if a line leads from a node to the tip without one of the branches.
bool leads_to(const CenterlineGraph& graph, std::size_t tip, std::size_t node,
              std::size_t without) {
    std::vector<std::uint8_t> seen(graph.nodes.size(), 0);
    std::queue<std::size_t> nodes;
    nodes.push(node);
    seen[node] = 1;
    while (!nodes.empty()) {
        const std::size_t at = nodes.front();
        nodes.pop();
        if (at == tip) return true;
        for (const std::size_t b : graph.nodes[at].branches) {
            if (b == without) continue;
            const std::size_t next = other_node(graph, b, at);
            if (std::exchange(seen[next], 1) == 0) nodes.push(next);
        }
    }
    return false;
}

/// Index of the vessel by which the blood arrives.
std::size_t parent_among(const std::vector<LeavingVessel>& vessels,
                         const std::optional<Vec3>& inlet, const CenterlineGraph& graph,
                         const SacPart& sac) {
    if (const auto tip = inlet ? nearest_tip(graph, *inlet) : std::nullopt)
        for (std::size_t i = 0; i < vessels.size(); ++i)
            if (leads_to(graph, *tip, vessels[i].towards, vessels[i].branch)) return i;
    const auto weight = [&](const LeavingVessel& vessel) {
        const Vec3 away = (vessel.place - sac.neck_centroid).normalized();
        return vessel.diameter * (1.0 - kAsWide * away.dot(sac.neck.normal));
    };
    const auto widest = std::ranges::max_element(vessels, {}, weight);
    return static_cast<std::size_t>(widest - vessels.begin());
}

/// The branch whose tube's wall is nearest to a point.
std::size_t branch_at(const CenterlineGraph& graph, std::size_t without, const Vec3& x) {
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t b = 0; b < graph.branches.size(); ++b) {
        if (b == without) continue;
        const auto& [start, end, points, radii] = graph.branches[b];
        for (std::size_t i = 0; i < points.size(); ++i)
            if (const double height = (points[i] - x).norm() - radii[i]; height < least) {
                least = height;
                best = b;
            }
    }
    return best;
}

/// 1 at the sac's triangles, #T; those across the neck belong to the side of their middle.
std::vector<std::uint8_t> triangles_of(const SacPart& sac, const Surface& surface) {
    std::vector<std::uint8_t> vertices(surface.vertex_count(), 0);
    for (const TriangleId t : sac.whole)
        for (const VertexId v : surface.triangles()[t]) vertices[v] = 1;
    std::vector<std::uint8_t> found(surface.triangle_count(), 0);
    for (TriangleId t = 0; t < surface.triangle_count(); ++t) {
        const Triangle& c = surface.triangles()[t];
        const bool touches = std::ranges::any_of(c, [&](VertexId v) { return vertices[v] != 0; });
        found[t] = touches && sac.neck.distance(middle_of(surface, t)) > 0.0 ? 1 : 0;
    }
    return found;
}

/// Two vessels are the parent's two sides.
std::vector<NeckVessel> vessels_of(const VesselWalk& walk, std::size_t parent) {
    std::vector<NeckVessel> vessels;
    const std::size_t count = walk.vessels().size();
    for (std::size_t i = 0; i < count; ++i)
        vessels.push_back({count > 2 && i != parent ? SacRegion::Daughters : SacRegion::Parent,
                           walk.vessels()[i].diameter});
    return vessels;
}

}  // namespace

std::string to_string(SacRegion region) {
    switch (region) {
        case SacRegion::Sac:
            return "sac";
        case SacRegion::Parent:
            return "parent";
        case SacRegion::Daughters:
            return "daughters";
        case SacRegion::Elsewhere:
            break;
    }
    return "elsewhere";
}

std::optional<Vec3> inlet_place(const Surface& surface) {
    Vec3 sum = Vec3::Zero();
    double count = 0.0;
    for (TriangleId t = 0; t < surface.triangle_count(); ++t) {
        if (surface.patch_of(t).kind != PatchKind::Inlet) continue;
        sum += middle_of(surface, t);
        count += 1.0;
    }
    return count > 0.0 ? std::optional<Vec3>(sum / count) : std::nullopt;
}

SacRegions sac_regions(const Surface& surface, const SacNeck& neck, const SacRegionOptions& options,
                       const Progress& progress) {
    const SacAtNeck found = sac_beyond(surface, neck, progress);
    const NamedBranch branch = branch_at_tip(surface, neck.dome, progress);
    const CenterlineGraph& graph = *branch.graph;
    const std::size_t own = branch_of_tip(graph, branch.tip);
    const Outline outline(found.sac);
    const double distance = options.reach * found.parent_diameter;
    VesselWalk walk(graph, own, outline, distance);
    walk.from(other_node(graph, own, branch.tip));
    const auto inlet = options.inlet ? options.inlet : inlet_place(surface);
    SacRegions regions;
    regions.vessels = vessels_of(walk, parent_among(walk.vessels(), inlet, graph, found.sac));
    const auto region_of = [&](const Vec3& x) {
        if (!outline.is_within(distance, x)) return SacRegion::Elsewhere;
        const auto vessel = walk.vessel_of(branch_at(graph, own, x));
        if (!vessel) return SacRegion::Elsewhere;
        return *vessel == kNoVessel ? SacRegion::Parent : regions.vessels[*vessel].region;
    };
    const std::vector<std::uint8_t> in_sac = triangles_of(found.sac, surface);
    for (TriangleId t = 0; t < surface.triangle_count(); ++t)
        regions.triangles.push_back(in_sac[t] != 0 ? SacRegion::Sac
                                    : surface.patch_of(t).kind != PatchKind::Wall
                                        ? SacRegion::Elsewhere
                                        : region_of(middle_of(surface, t)));
    return regions;
}

}  // namespace vesselbench
