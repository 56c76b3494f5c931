#include "geometry/vessel/centerlines/centerlines.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/disjoint_sets.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/surface_key.h"
#include "geometry/kernel/wording.h"
#include "geometry/vessel/centerlines/lumen_bridges.h"
#include "geometry/vessel/centerlines/lumen_grid.h"
#include "geometry/vessel/centerlines/refinement.h"
#include "geometry/vessel/centerlines/skeleton.h"
#include "geometry/vessel/centerlines/stubs.h"
#include "geometry/vessel/centerlines/thin_vessels.h"
#include "geometry/vessel/centerlines/thinning.h"
#include "geometry/vessel/centerlines/vessel_wall.h"
#include "geometry/vessel/centerlines/wall_section.h"

namespace vesselbench {
namespace {

constexpr double kThinFraction =
    0.02;  ///< fraction of the wall's area that may be thinner than the grid resolves
constexpr double kVoxelsPerRadius = 3.5;  ///< of thin vessels
constexpr double kMostLumen = 1.5e6;      ///< voxels
constexpr double kMostRefined = 3.0e6;    ///< voxels of a finer grid, tried for false loops
constexpr double kMostGrid = 4.0e7;       ///< voxels including the empty ones around
constexpr double kMostBorder = 1.25;      ///< times as many with the border of a flat or long box
constexpr double kMostFiner = 3.4;        ///< times as many in finer grids: one finer one at least
constexpr double kLeastLumen = 3e4;       ///< voxels: finer than thin vessels need, for good lines
constexpr double kSmallestComponent = 0.01;
constexpr std::size_t kLeastTriangles = 8;  ///< of the wall, a branch: with fewer, it is torn
constexpr int kAttempts = 3;
/// A blind end's least distance beyond its furcation [voxels]: of a thin branch, and of a wider
/// one. Thin vessels have radii of 2 voxels, and short branches of them hardly rise, least of all
/// those that lean along their parent. Lower summits are bumps of the voxels.
constexpr double kLeastRise = 1.0;
constexpr double kUsualRise = 4.0;

void check(const CenterlineParameters& p) {
    if (!(p.spacing >= 0.02 && p.spacing <= 0.5)) {
        throw InvalidInput("centerline spacing " + std::to_string(p.spacing) +
                           " is outside [0.02, 0.5] radii");
    }
    if (!(p.blind_beyond_parent >= 0.0 && p.blind_slenderness >= 0.0)) {
        throw InvalidInput("the rules for blind branches must not be negative");
    }
}

Eigen::AlignedBox3d box_of(const VesselWall& wall) {
    Eigen::AlignedBox3d box;
    for (const Triangle& t : wall.closed) {
        for (const VertexId v : t) box.extend(wall.points[v]);
    }
    return box;
}

double first_spacing(const VesselWall& wall, const Eigen::AlignedBox3d& box, double thin) {
    double spacing = thin / kVoxelsPerRadius;
    for (const VesselEnd& end : wall.ends) {
        if (end.radius > 0.3 * thin) {
            spacing = std::min(spacing, end.radius / kVoxelsPerRadius);
        }
    }
    spacing = std::min(spacing, std::cbrt(wall.volume / kLeastLumen));
    spacing = std::max(spacing, std::cbrt(wall.volume / kMostLumen));
    spacing = std::max(spacing, std::cbrt(box.volume() / kMostGrid));
    while (voxel_count(box, spacing) > kMostBorder * kMostGrid) spacing *= 1.25;
    return spacing;
}

/// Anchors of the thinning.
struct Anchors {
    std::vector<VoxelId> fixed;       ///< openings, then given points
    std::vector<VesselEnd> openings;  ///< of the first anchors
    std::vector<VoxelId> blind;
    std::vector<VoxelId> low;  ///< those of `blind` that hardly rise
};

/// A hole in the wall of a much larger lumen is a defect, not a vessel's end.
bool is_stray_hole(const LumenGrid& grid, const VesselEnd& end) {
    VoxelId v = 0;
    const double r = end.radius;
    if (r < 1.5 * grid.spacing) return true;
    if (!grid.nearest(end.centre - 4.0 * r * end.outward, r, v)) return false;
    return grid.depth[v] > 3.0 * r;
}

void anchor_openings(const VesselWall& wall, const LumenGrid& grid, Anchors& anchors) {
    for (const VesselEnd& end : wall.ends) {
        VoxelId v = 0;
        if (is_stray_hole(grid, end)) continue;
        if (!grid.nearest(end.centre, 1.5 * end.radius + 4.0 * grid.spacing, v)) continue;
        if (std::count(anchors.fixed.begin(), anchors.fixed.end(), v) > 0) continue;
        anchors.fixed.push_back(v);
        anchors.openings.push_back(end);
    }
}

void anchor_points(const Positions& points, const LumenGrid& grid, Anchors& anchors) {
    for (const Vec3& p : points) {
        VoxelId v = 0;
        const double deepest = *std::max_element(grid.depth.begin(), grid.depth.end());
        if (!grid.nearest(p, deepest + 4.0 * grid.spacing, v) ||
            (grid.centre(v) - p).norm() > grid.depth[v] + 4.0 * grid.spacing) {
            throw InvalidInput("the given end " + place_text(p) +
                               " is not in or near the vessel; give a point on its wall");
        }
        if (std::count(anchors.fixed.begin(), anchors.fixed.end(), v) == 0) {
            anchors.fixed.push_back(v);
        }
    }
}

/// Of the lowest number among equals.
VoxelId farthest(const std::vector<float>& distance, const std::vector<VoxelId>& reached) {
    return *std::ranges::max_element(reached, [&](VoxelId a, VoxelId b) {
        return distance[a] != distance[b] ? distance[a] < distance[b] : a > b;
    });
}

bool near_opening(const Anchors& anchors, const Vec3& p) {
    return std::any_of(anchors.openings.begin(), anchors.openings.end(),
                       [&](const VesselEnd& e) { return (e.centre - p).norm() < 1.6 * e.radius; });
}

/// Candidates for blind ends, one component after the other. A component without any known end
/// starts from one of its two farthest points.
void anchor_blind_ends(const LumenGrid& grid, Anchors& anchors, const Progress& cancel) {
    constexpr float kUnreached = std::numeric_limits<float>::infinity();
    std::vector<float> all(grid.lumen.size(), kUnreached), from_seed = all;
    for (const VoxelId seed : grid.voxels) {
        if (std::isfinite(all[seed])) continue;
        const auto component = add_geodesic_distances(grid, seed, from_seed, cancel);
        const auto known = std::ranges::find_if(
            anchors.fixed, [&](VoxelId v) { return std::isfinite(from_seed[v]); });
        const VoxelId root = known != anchors.fixed.end() ? *known : farthest(from_seed, component);
        if (known == anchors.fixed.end()) anchors.blind.push_back(root);
        for (const VoxelId v : component) from_seed[v] = kUnreached;  // other components are apart
        add_geodesic_distances(grid, root, all, cancel);
    }
    for (const auto& [v, rise] : summits(grid, all, kLeastRise * grid.spacing, cancel)) {
        const bool taken = std::count(anchors.fixed.begin(), anchors.fixed.end(), v) +
                               std::count(anchors.blind.begin(), anchors.blind.end(), v) >
                           0;
        if (taken || near_opening(anchors, grid.centre(v))) continue;
        anchors.blind.push_back(v);
        if (rise < kUsualRise * grid.spacing) anchors.low.push_back(v);
    }
}

/// Loops of a skeleton: edges - nodes + components.
int loop_count(const Skeleton& skeleton) {
    DisjointSets sets(skeleton.nodes.size());
    int loops = 0;
    for (const SkeletonBranch& b : skeleton.branches)
        loops +=
            sets.join(static_cast<std::uint32_t>(b.from), static_cast<std::uint32_t>(b.to)) ? 0 : 1;
    return loops;
}

RoughGraph rough_graph(const LumenGrid& grid, const Skeleton& skeleton, const Anchors& anchors) {
    RoughGraph rough;
    rough.voxel = grid.spacing;
    const auto degree = skeleton.degrees();
    for (std::size_t n = 0; n < skeleton.nodes.size(); ++n) {
        CenterlineNode node{grid.centre(skeleton.nodes[n]), grid.depth[skeleton.nodes[n]], {}};
        NodeKind kind = degree[n] == 1 ? NodeKind::Blind : NodeKind::Furcation;
        for (std::size_t a = 0; a < anchors.openings.size() && degree[n] == 1; ++a) {
            if (anchors.fixed[a] != skeleton.nodes[n]) continue;
            kind = NodeKind::Opening;
            node.position = anchors.openings[a].centre;
        }
        rough.graph.nodes.push_back(node);
        rough.kinds.push_back(kind);
    }
    for (const SkeletonBranch& b : skeleton.branches) {
        CenterlineBranch branch{b.from, b.to, {}, {}};
        for (const VoxelId v : b.path) {
            branch.points.push_back(grid.centre(v));
            branch.radii.push_back(grid.depth[v]);
        }
        branch.points.front() = rough.graph.nodes[b.from].position;
        branch.points.back() = rough.graph.nodes[b.to].position;
        rough.graph.nodes[b.from].branches.push_back(rough.graph.branches.size());
        rough.graph.nodes[b.to].branches.push_back(rough.graph.branches.size());
        rough.graph.branches.push_back(std::move(branch));
    }
    return rough;
}

/// The result of one grid.
struct Attempt {
    RoughGraph rough;
    std::vector<Stub> stubs;
    std::size_t components = 0;
    int loops = 0;

    [[nodiscard]] bool is_lost() const { return rough.graph.branches.empty(); }
};

std::vector<Stub> stubs_among(const LumenGrid& grid, const std::vector<BlindReach>& dropped) {
    std::vector<Stub> stubs;
    for (const BlindReach& reach : dropped) {
        const Vec3 root = grid.centre(reach.root), tip = grid.centre(reach.tip);
        if (!((tip - root).norm() > 0.0)) continue;
        stubs.push_back({.root = root,
                         .exit = grid.centre(reach.exit),
                         .tip = tip + grid.depth[reach.tip] * (tip - root).normalized(),
                         .length = reach.length,
                         .widest = reach.widest,
                         .parent = grid.depth[reach.root]});
    }
    std::ranges::stable_sort(stubs, std::greater{}, &Stub::length);
    return stubs;
}

Attempt skeletonise(const VesselWall& wall, const CenterlineParameters& parameters, double spacing,
                    const Progress& progress) {
    LumenGrid grid = voxelise(wall.points, wall.closed, spacing, wall.rule, progress.part(0, 0.3));
    Attempt attempt;
    bridge_parts(grid, *wall.distance, progress);
    add_thin_vessels(grid, wall, progress);
    attempt.components = keep_large_components(grid, kSmallestComponent);
    if (grid.voxels.empty()) return attempt;
    measure_depth(grid, progress);
    progress.report(0.4, "finding ends");
    Anchors anchors;
    anchor_openings(wall, grid, anchors);
    anchor_points(parameters.ends, grid, anchors);
    const bool needs_ends = anchors.fixed.size() < 2;
    if (parameters.find_blind_ends || needs_ends) anchor_blind_ends(grid, anchors, progress);
    std::vector<VoxelId> all = anchors.fixed;
    all.insert(all.end(), anchors.blind.begin(), anchors.blind.end());
    progress.report(0.5, "thinning the lumen");
    auto curve = thin(grid, grid.voxels, all, progress);
    progress.report(0.8, "thinning the lumen");
    const PrunedCurve pruned =
        prune(grid, std::move(curve), {anchors.fixed, anchors.blind, anchors.low},
              {parameters.blind_beyond_parent, parameters.blind_slenderness}, progress);
    attempt.stubs = stubs_among(grid, pruned.dropped);
    const Skeleton skeleton = skeleton_of(grid, pruned.voxels);
    attempt.loops = loop_count(skeleton);
    attempt.rough = rough_graph(grid, skeleton, anchors);
    return attempt;
}

/// Lines, and the stubs that got none.
struct Lines {
    CenterlineGraph graph;
    std::vector<Stub> stubs;
};

/// Centring the lines of a torn wall would take long, and they would mean nothing.
void require_whole(const VesselWall& wall, const CenterlineGraph& graph) {
    if (graph.branches.size() * kLeastTriangles <= wall.closed.size()) return;
    throw DiagnosedFailure({.code = "wall-torn",
                            .figures = {{"triangles", static_cast<double>(wall.closed.size())},
                                        {"lines", static_cast<double>(graph.branches.size())}}});
}

Lines find_lines(const Surface& surface, const CenterlineParameters& parameters,
                 const Progress& progress) {
    check(parameters);
    const VesselWall wall = vessel_wall_of(surface, progress);
    if (!(wall.volume > 0.0)) {
        throw DiagnosedInput({.code = "no-lumen", .remedies = {{.operation = "repair"}}});
    }
    const double thin = thin_radius(wall, kThinFraction);
    const Eigen::AlignedBox3d box = box_of(wall);
    double spacing = first_spacing(wall, box, thin);
    Attempt attempt;
    for (int k = 0; k < kAttempts; ++k, spacing /= 1.5) {
        if (k > 0 && (wall.volume > kMostRefined * spacing * spacing * spacing ||
                      voxel_count(box, spacing) > kMostFiner * kMostBorder * kMostGrid))
            break;
        const Progress part = progress.part(0.2 * k, 0.2 * (k + 1));
        Attempt next = skeletonise(wall, parameters, spacing, part);
        require_whole(wall, next.rough.graph);
        if (attempt.is_lost() || next.loops <= attempt.loops) attempt = std::move(next);
        const bool false_loops = wall.handles >= 0 && attempt.loops > wall.handles;
        if (!attempt.is_lost() && !false_loops) break;
    }
    if (attempt.is_lost())
        throw DiagnosedFailure({.code = "no-centerline",
                                .remedies = {{.operation = "repair"}, {.operation = "crop"}}});
    const WallSections sections(wall, 0.5 * thin);
    return {refine(attempt.rough, sections, parameters.spacing, progress.part(0.6, 1.0)),
            std::move(attempt.stubs)};
}

ContentKey key_of(const CenterlineParameters& p) {
    const double numbers[] = {p.find_blind_ends ? 1.0 : 0.0, p.blind_beyond_parent,
                              p.blind_slenderness, p.spacing};
    return content_key({content_key(std::as_bytes(std::span<const Vec3>(p.ends))),
                        content_key(std::span<const double>(numbers))});
}

std::size_t bytes_of(const Lines& lines) {
    const CenterlineGraph& graph = lines.graph;
    std::size_t bytes = sizeof lines + lines.stubs.size() * sizeof(Stub) +
                        graph.nodes.size() * sizeof(CenterlineNode) +
                        graph.branches.size() * sizeof(CenterlineBranch);
    for (const CenterlineNode& node : graph.nodes)
        bytes += node.branches.size() * sizeof(std::size_t);
    for (const CenterlineBranch& branch : graph.branches)
        bytes += branch.points.size() * (sizeof(Vec3) + sizeof(double));
    return bytes;
}

std::shared_ptr<const Lines> lines_of(const Surface& surface,
                                      const CenterlineParameters& parameters,
                                      const Progress& progress, DerivedCache& cache) {
    if (surface.empty()) throw InvalidInput("the surface is empty");
    return cache.find_or_make<Lines>(
        "centerlines", content_key({surface_key(surface, cache), key_of(parameters)}),
        [&] { return find_lines(surface, parameters, progress); }, &bytes_of, progress);
}

}  // namespace

CenterlineGraph compute_centerlines(const Surface& surface, const CenterlineParameters& parameters,
                                    const Progress& progress) {
    return find_lines(surface, parameters, progress).graph;
}

std::shared_ptr<const CenterlineGraph> centerlines_of(const Surface& surface,
                                                      const CenterlineParameters& parameters,
                                                      const Progress& progress,
                                                      DerivedCache& cache) {
    const auto lines = lines_of(surface, parameters, progress, cache);
    return {lines, &lines->graph};
}

std::shared_ptr<const std::vector<Stub>> stubs_of(const Surface& surface,
                                                  const CenterlineParameters& parameters,
                                                  const Progress& progress, DerivedCache& cache) {
    const auto lines = lines_of(surface, parameters, progress, cache);
    return {lines, &lines->stubs};
}

}  // namespace vesselbench
