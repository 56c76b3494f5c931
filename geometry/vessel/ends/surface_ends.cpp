#include "geometry/vessel/ends/surface_ends.h"

#include <algorithm>
#include <limits>
#include <numbers>
#include <set>
#include <span>

#include "geometry/editing/editable_surface.h"
#include "geometry/editing/hole_filling.h"
#include "geometry/kernel/whole_section.h"
#include "geometry/vessel/centerlines/branch_queries.h"
#include "geometry/vessel/ends/patch_shape.h"

namespace vesselbench {

namespace {

/// A point this far from an end does not mean it [radii].
constexpr double kFarthestEnd = 4.0;
/// A sac: wider than its neck or its neighbours by this factor, and at most this many radii long.
constexpr double kSacToNeck = 1.4;
constexpr double kSacLength = 2.5;
/// What is longer beyond the vessels around is a vessel, however it widens behind its furcation
/// [radii].
constexpr double kLongestSac = 4.0;
/// A ball on a narrower neck that the image has widened: it rises behind its neck by this factor,
/// in at most this many radii beyond the vessels around it.
constexpr double kBallToNeck = 1.15;
constexpr double kBallLength = 1.5;
/// A trunk is about as wide as the widest end: within this factor [-].
constexpr double kAsWide = 1.1;
constexpr int kSections = 20;
/// A stub is shorter than this many of its parent's diameters.
constexpr double kStubShare = 1.0;
/// Closer to another end it is a part of it [diameters of the end, and of the tip's branch].
constexpr double kSameEnd = 1.0;
constexpr double kCorner = 3.0;

std::vector<SurfaceEnd> visible_ends(const Surface& surface) {
    std::vector<SurfaceEnd> ends;
    for (auto& loop : surface.topology->boundary_loops()) {
        const double length = mean_edge(surface.points(), loop) * static_cast<double>(loop.size());
        const VertexId vertex = loop.front();
        const Vec3 centre = loop_centre(surface, loop);
        ends.push_back({.centre = centre,
                        .diameter = length / std::numbers::pi,
                        .closure = length / std::numbers::pi,
                        .patch = std::nullopt,
                        .rim = std::move(loop),
                        .tip = std::nullopt,
                        .vertex = vertex});
    }
    for (std::size_t p = 0; p < surface.patches.size(); ++p) {
        if (surface.patches[p].kind == PatchKind::Wall) continue;
        const auto& labels = *surface.patch_labels;
        const auto first = std::ranges::find(labels, static_cast<std::uint16_t>(p));
        if (first == labels.end()) continue;
        const auto triangle = static_cast<TriangleId>(first - labels.begin());
        const PatchShape shape = patch_shape(surface, p);
        ends.push_back({.centre = shape.plane.point,
                        .diameter = shape.diameter(),
                        .closure = shape.diameter(),
                        .patch = p,
                        .rim = {},
                        .tip = std::nullopt,
                        .vertex = surface.triangles()[triangle][0]});
    }
    return ends;
}

/// Assigns a tip to each end, the closest pairs first.
void match_tips(std::vector<SurfaceEnd>& ends, const CenterlineGraph& graph) {
    struct Pair {
        double distance;
        std::size_t end, tip;
    };

    std::vector<Pair> pairs;
    for (std::size_t e = 0; e < ends.size(); ++e)
        for (std::size_t n = 0; n < graph.nodes.size(); ++n) {
            if (!graph.nodes[n].is_tip()) continue;
            const double distance = (graph.nodes[n].position - ends[e].centre).norm();
            if (distance < kEndReach * std::max(ends[e].diameter, 2.0 * tip_radius(graph, n)))
                pairs.push_back({distance, e, n});
        }
    std::stable_sort(pairs.begin(), pairs.end(),
                     [](const Pair& a, const Pair& b) { return a.distance < b.distance; });
    std::set<std::size_t> taken;
    for (const Pair& pair : pairs)
        if (!ends[pair.end].tip && taken.insert(pair.tip).second) ends[pair.end].tip = pair.tip;
}

VertexId nearest_vertex(const Surface& surface, const Vec3& point) {
    VertexId best = 0;
    double least = std::numeric_limits<double>::infinity();
    const Positions& points = surface.points();
    for (VertexId v = 0; v < points.size(); ++v)
        if (const double d = (points[v] - point).squaredNorm(); d < least) {
            least = d;
            best = v;
        }
    return best;
}

/// A short branch into a corner of an end that is visible, and has a line of its own.
bool is_corner(std::span<const SurfaceEnd> ends, const CenterlineGraph& graph, std::size_t tip) {
    const auto blind = blind_branch(graph, tip);
    return blind && blind->is_stub() && std::ranges::any_of(ends, [&](const SurfaceEnd& end) {
               return end.is_visible() && end.tip &&
                      is_corner_of(end, graph, graph.nodes[tip].position, blind->widest);
           });
}

/// Radius of a branch beyond the furcation at `node` [mm].
double radius_beyond(const CenterlineGraph& graph, std::size_t branch, std::size_t node) {
    const double zone = furcation_zone_end(graph, branch, node);
    return radius_at(graph.branches[branch], place_from_node(graph, branch, node, zone).abscissa);
}

/// How much wider a branch becomes behind its neck, the narrowest place outside the vessel that it
/// leaves.
double rise_behind_neck(const CenterlineGraph& graph, std::size_t branch, std::size_t root) {
    const auto& own = graph.branches[branch];
    const double whole = branch_length(own), step = 0.02 * whole + 1e-9;
    double neck = std::numeric_limits<double>::infinity(), rise = 1.0;
    for (double s = graph.nodes[root].radius; s <= whole; s += step) {
        const double r = radius_at(own, place_from_node(graph, branch, root, s).abscissa);
        neck = std::min(neck, r);
        rise = std::max(rise, r / neck);
    }
    return rise;
}

/// True if the line of another branch at the node passes the section: it is that vessel's, too.
bool is_shared(const CenterlineGraph& graph, std::size_t branch, std::size_t node,
               const SectionCurve& section, const Plane& plane) {
    for (const std::size_t other : graph.nodes[node].branches) {
        if (other == branch) continue;
        const Positions& line = graph.branches[other].points;
        for (std::size_t i = 0; i + 1 < line.size(); ++i) {
            const double from = plane.distance(line[i]), to = plane.distance(line[i + 1]);
            if ((from < 0.0) == (to < 0.0)) continue;
            const Vec3 at = line[i] + from / (from - to) * (line[i + 1] - line[i]);
            if (encloses(section, plane, at)) return true;
        }
    }
    return false;
}

}  // namespace

std::vector<SurfaceEnd> find_surface_ends(const Surface& surface, const CenterlineGraph& graph) {
    std::vector<SurfaceEnd> ends = visible_ends(surface);
    match_tips(ends, graph);
    std::set<std::size_t> taken;
    for (SurfaceEnd& end : ends)
        if (end.tip) {
            taken.insert(*end.tip);
            end.diameter = 2.0 * tip_radius(graph, *end.tip);
        }
    const std::size_t visible = ends.size();
    for (std::size_t n = 0; n < graph.nodes.size(); ++n) {
        if (!graph.nodes[n].is_tip() || taken.contains(n) ||
            is_corner(std::span(ends).first(visible), graph, n))
            continue;
        ends.push_back({.centre = graph.nodes[n].position,
                        .diameter = 2.0 * tip_radius(graph, n),
                        .patch = std::nullopt,
                        .rim = {},
                        .tip = n,
                        .vertex = nearest_vertex(surface, graph.nodes[n].position)});
    }
    return ends;
}

bool is_corner_of(const SurfaceEnd& end, const CenterlineGraph& graph, const Vec3& tip,
                  double widest) {
    const Vec3& at = end.tip ? graph.nodes[*end.tip].position : end.centre;
    return std::min((at - tip).norm(), (end.centre - tip).norm()) <
           std::min(kSameEnd * std::max(end.diameter, end.closure), kCorner * 2.0 * widest);
}

std::optional<std::size_t> end_near(const std::vector<SurfaceEnd>& ends, const Vec3& point) {
    std::optional<std::size_t> best;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t e = 0; e < ends.size(); ++e) {
        const double distance = (ends[e].centre - point).norm();
        if (distance >= least || distance > 0.5 * kFarthestEnd * ends[e].diameter) continue;
        least = distance;
        best = e;
    }
    return best;
}

bool BlindBranch::is_short() const {
    return length < kSacLength * widest;
}

bool BlindBranch::is_stub() const {
    return length < kStubShare * 2.0 * parent;
}

std::optional<BlindBranch> blind_branch(const CenterlineGraph& graph, std::size_t tip) {
    const std::size_t index = branch_of_tip(graph, tip);
    const std::size_t root = other_node(graph, index, tip);
    if (graph.nodes[root].is_tip()) return std::nullopt;
    const auto& branch = graph.branches[index];
    const double whole = branch_length(branch);
    const double zone = furcation_zone_end(graph, index, root);
    BlindBranch found{.length = whole - zone};
    double neck = std::numeric_limits<double>::infinity();
    for (double s = zone; s <= whole; s += 0.02 * whole + 1e-9) {
        const double r = radius_at(branch, place_from_node(graph, index, root, s).abscissa);
        neck = std::min(neck, r);
        found.widest = std::max(found.widest, r);
        found.necked = found.necked || r > kSacToNeck * neck;
    }
    found.narrowest = std::numeric_limits<double>::infinity();
    for (const std::size_t other : graph.nodes[root].branches) {
        if (other == index) continue;
        const double radius = radius_beyond(graph, other, root);
        found.parent = std::max(found.parent, radius);
        found.narrowest = std::min(found.narrowest, radius);
    }
    const bool wide = found.necked || found.widest > kSacToNeck * found.parent;
    found.bulges = found.length < kLongestSac * found.widest &&
                   (wide || (found.length < kBallLength * found.widest &&
                             rise_behind_neck(graph, index, root) > kBallToNeck));
    return found;
}

double section_rise(const Surface& surface, const CenterlineGraph& graph, std::size_t tip) {
    const std::size_t index = branch_of_tip(graph, tip);
    const std::size_t root = other_node(graph, index, tip);
    const double whole = branch_length(graph.branches[index]), from = graph.nodes[root].radius;
    const Surface near = part_near(surface, graph.nodes[tip].position, whole + 2.0 * from);
    double neck = std::numeric_limits<double>::infinity(), rise = 1.0;
    for (int k = 0; k <= kSections; ++k) {
        const double inward = std::max(0.0, whole - from) * (kSections - k) / kSections;
        const BranchPlace place = place_from_node(graph, index, tip, inward);
        const Plane plane{point_at(graph.branches[index], place.abscissa),
                          outward_direction(graph, tip, inward)};
        const auto curve = whole_section_at(near, plane);
        if (!curve || is_shared(graph, index, root, *curve, plane)) continue;
        neck = std::min(neck, curve->diameter());
        rise = std::max(rise, curve->diameter() / neck);
    }
    return rise;
}

bool is_trunk(const CenterlineGraph& graph, std::size_t tip) {
    const auto blind = blind_branch(graph, tip);
    if (!blind || blind->necked || (blind->bulges && blind->is_short())) return false;
    const double radius = tip_radius(graph, tip);
    const double widest = tip_radius(graph, tips_by_radius(graph).front());
    return kAsWide * radius >= widest && radius > kAsWide * blind->narrowest;
}

}  // namespace vesselbench
