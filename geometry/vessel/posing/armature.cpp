#include "geometry/vessel/posing/armature.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <numbers>
#include <unordered_set>
#include <utility>

#include "geometry/kernel/disjoint_sets.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/whole_section.h"
#include "geometry/vessel/centerlines/branch_queries.h"
#include "geometry/vessel/centerlines/line_smoothing.h"

namespace vesselbench {

namespace {

constexpr double kSpacing = 0.2;      ///< of an axis's points [radii]
constexpr double kEndMargin = 1.0;    ///< of an end that stays rigid [radii]
constexpr double kLeastLength = 1.5;  ///< that bends [radii]
/// A section that is larger contains another vessel, too [areas of the inscribed circle].
constexpr double kLargestSection = 3.5;
constexpr double kLeastFlexibility = 0.02;
constexpr int kRetreats = 12;  ///< of an end, until its cap is outside of what bends

// --- rods

Rod rest_rod(const CenterlineGraph& graph, std::size_t branch, std::size_t root_node) {
    const CenterlineBranch& course = graph.branches[branch];
    Line line{.points = course.points, .radii = course.radii, .weights = {}};
    if (course.start_node != root_node) {
        std::ranges::reverse(line.points);
        std::ranges::reverse(line.radii);
    }
    line.weights.assign(line.points.size(), 1.0);
    line = resampled(line, kSpacing, 8);
    Positions points;
    for (const LineFit& fit : fit_line(line, 1.0, 0.0)) points.push_back(fit.point);
    Rod rod{{std::move(points), line.radii}};
    rod.branch = branch;
    rod.root_node = root_node;
    rod.far_node = other_node(graph, branch, root_node);
    rod.free_end = graph.nodes[rod.far_node].is_tip();
    return rod;
}

/// The branches of the root's tree in breadth-first order, with the node they begin at.
struct Step {
    std::size_t branch, from;
};

std::vector<Step> outward_from(const CenterlineGraph& graph, std::size_t root) {
    std::vector<Step> steps;
    std::vector<std::uint8_t> seen(graph.branches.size(), 0), reached(graph.nodes.size(), 0);
    std::deque<std::size_t> open = {root};
    reached[root] = 1;
    while (!open.empty()) {
        const std::size_t node = open.front();
        open.pop_front();
        for (const std::size_t b : graph.nodes[node].branches) {
            if (seen[b] != 0) continue;
            seen[b] = 1;
            steps.push_back({b, node});
            const std::size_t far = other_node(graph, b, node);
            if (reached[far] != 0) continue;
            reached[far] = 1;
            open.push_back(far);
        }
    }
    return steps;
}

/// Where the furcation or the end at a node leaves the branch alone [mm from the node].
double rigid_length(const CenterlineGraph& graph, std::size_t branch, std::size_t node) {
    const CenterlineBranch& course = graph.branches[branch];
    const double radius = radius_at(course, node == course.start_node ? 0.0 : 1e300);
    if (graph.nodes[node].is_tip()) return kEndMargin * radius;
    return std::min(furcation_zone_end(graph, branch, node),
                    parents_exit(graph, branch, node) + kEndMargin * radius);
}

// --- sections

struct Loop {
    SectionCurve curve;
    std::size_t point = 0;
};

/// The closed section around the axis at a point; none: another vessel is part of it.
std::optional<Loop> loop_at(const Surface& surface, const Rod& rod, std::size_t point) {
    auto curve = whole_section_at(surface, {rod.points()[point], rod.tangent(point)});
    const double disc = std::numbers::pi * rod.radii()[point] * rod.radii()[point];
    if (!curve || std::abs(curve->area) > kLargestSection * disc) return std::nullopt;
    return Loop{std::move(*curve), point};
}

struct Loops {
    Loop first, last;
};

/// Moves the ends of what bends inward to the first closed sections.
std::optional<Loops> loops_of(const Surface& surface, Rod& rod) {
    const auto stretch = [&] { return rod.along()[rod.end] - rod.along()[rod.begin]; };
    const auto enough = [&] {
        return rod.begin < rod.end && stretch() >= kLeastLength * rod.radii()[rod.begin];
    };
    std::optional<Loop> first, last;
    for (; enough() && !first; rod.begin += first ? 0 : 1) first = loop_at(surface, rod, rod.begin);
    for (; enough() && !last; rod.end -= last ? 0 : 1) last = loop_at(surface, rod, rod.end);
    if (!first || !last || !enough()) return std::nullopt;
    return Loops{std::move(*first), std::move(*last)};
}

// --- binding

class Binder {
public:
    Binder(const Surface& surface, const std::vector<Rod>& rods, const std::vector<Loops>& loops)
        : surface_(surface), rods_(rods), loops_(loops), sets_(surface.vertex_count()) {
        for (const Loops& pair : loops) {
            block(pair.first);
            block(pair.last);
        }
        for (const Triangle& t : surface.triangles())
            for (int k = 0; k < 3; ++k)
                if (!blocked_.contains(edge(t[k], t[(k + 1) % 3])))
                    sets_.join(t[k], t[(k + 1) % 3]);
    }

    /// The first rod whose sections do not separate the surface; none: all do.
    [[nodiscard]] std::optional<std::size_t> inseparable() {
        for (std::size_t i = 0; i < loops_.size(); ++i) {
            const auto root = below(loops_[i].first), sleeve = above(loops_[i].first),
                       last = below(loops_[i].last), far = above(loops_[i].last);
            if (!root || !sleeve || last != sleeve || !far || root == sleeve || far == sleeve ||
                root == far)
                return i;
        }
        return std::nullopt;
    }

    [[nodiscard]] std::vector<Binding> bindings() {
        std::vector<Binding> bindings(surface_.vertex_count());
        std::vector<std::optional<std::size_t>> carrier(bindings.size()), sleeve(bindings.size());
        for (std::size_t i = 0; i < loops_.size(); ++i) {
            sleeve[*above(loops_[i].first)] = i;
            carrier[*above(loops_[i].last)] = i;
        }
        for (VertexId v = 0; v < bindings.size(); ++v) {
            const auto set = sets_.root(v);
            if (carrier[set])
                bindings[v] = {.rod = static_cast<std::uint32_t>(*carrier[set]),
                               .segment = last_segment(*carrier[set]),
                               .t = 1.0};
            if (sleeve[set])
                bindings[v] = {.rod = static_cast<std::uint32_t>(*sleeve[set]), .rigid = false};
        }
        for (std::size_t i = 0; i < rods_.size(); ++i) follow(i, bindings);
        return bindings;
    }

private:
    static std::uint64_t edge(VertexId a, VertexId b) {
        return (static_cast<std::uint64_t>(std::min(a, b)) << 32U) | std::max(a, b);
    }

    void block(const Loop& loop) {
        for (const SectionCrossing& c : loop.curve.crossings)
            blocked_.insert(edge(c.below, c.above));
    }

    /// The set of all vertices on one side; none: they are not connected.
    std::optional<std::uint32_t> side(const Loop& loop, VertexId SectionCrossing::*which) {
        const auto set = sets_.root(loop.curve.crossings.front().*which);
        for (const SectionCrossing& c : loop.curve.crossings)
            if (sets_.root(c.*which) != set) return std::nullopt;
        return set;
    }

    std::optional<std::uint32_t> below(const Loop& loop) {
        return side(loop, &SectionCrossing::below);
    }

    std::optional<std::uint32_t> above(const Loop& loop) {
        return side(loop, &SectionCrossing::above);
    }

    [[nodiscard]] std::uint32_t last_segment(std::size_t rod) const {
        return static_cast<std::uint32_t>(rods_[rod].points().size() - 2);
    }

    /// Nearest places on the axis, from neighbour to neighbour, so that no vertex is bound to
    /// another winding of its own vessel.
    void follow(std::size_t rod, std::vector<Binding>& bindings) const {
        std::deque<VertexId> open;
        std::vector<std::uint8_t> known(bindings.size(), 0);
        const auto reach = [&](VertexId v, double near) {
            if (known[v] != 0 || bindings[v].rod != rod || bindings[v].rigid) return;
            known[v] = 1;
            place(rods_[rod], surface_.points()[v], near, bindings[v]);
            open.push_back(v);
        };
        for (const SectionCrossing& c : loops_[rod].first.curve.crossings)
            reach(c.above, rods_[rod].along()[loops_[rod].first.point]);
        while (!open.empty()) {
            const VertexId v = open.front();
            open.pop_front();
            const Binding& at = bindings[v];
            const double here =
                std::lerp(rods_[rod].along()[at.segment], rods_[rod].along()[at.segment + 1], at.t);
            for (const VertexId u : surface_.topology->rings().row(v)) reach(u, here);
        }
    }

    static void place(const Rod& rod, const Vec3& x, double near, Binding& binding) {
        const double window = 2.0 * rod.radii()[rod.at(near).segment];
        const AxisPlace at = rod.nearest(x, std::max(rod.begin, rod.at(near - window).segment),
                                         std::min(rod.end - 1, rod.at(near + window).segment));
        binding.segment = static_cast<std::uint32_t>(at.segment);
        binding.t = at.t;
    }

    const Surface& surface_;
    const std::vector<Rod>& rods_;
    const std::vector<Loops>& loops_;
    DisjointSets sets_;
    std::unordered_set<std::uint64_t> blocked_;
};

/// The first rod of which a cap would bend; none: all are rigid.
std::optional<std::size_t> bent_cap(const Surface& surface, const std::vector<Binding>& bindings) {
    for (TriangleId t = 0; t < surface.triangle_count(); ++t) {
        if (surface.patch_of(t).kind == PatchKind::Wall) continue;
        for (const VertexId v : surface.triangles()[t])
            if (!bindings[v].rigid) return bindings[v].rod;
    }
    return std::nullopt;
}

class ArmatureMaker {
public:
    ArmatureMaker(const Surface& surface, const CenterlineGraph& graph)
        : surface_(surface), graph_(graph) {}

    void add(const Rod& candidate) {
        Rod rod = candidate;
        const double length = rod.length();
        const double before = rigid_length(graph_, rod.branch, rod.root_node),
                     after = rigid_length(graph_, rod.branch, rod.far_node);
        if (before + after >= length) return leave_out(rod, "branch-too-short-to-bend");
        rod.begin = rod.at(before).segment + 1;
        rod.end = rod.at(length - after).segment;
        if (auto loops = loops_of(surface_, rod)) {
            rods_.push_back(std::move(rod));
            loops_.push_back(std::move(*loops));
        } else {
            leave_out(rod, "branch-too-short-to-bend");
        }
    }

    Armature finish(const Progress& progress) {
        std::vector<int> retreats(graph_.branches.size(), 0);
        std::vector<Binding> bindings;
        while (true) {
            progress.check_cancelled();
            Binder binder(surface_, rods_, loops_);
            if (const auto bad = binder.inseparable()) {
                drop(*bad, "branch-in-loop");
                continue;
            }
            bindings = binder.bindings();
            const auto bent = bent_cap(surface_, bindings);
            if (!bent) break;
            if (++retreats[rods_[*bent].branch] > kRetreats || !retreat(*bent))
                drop(*bent, "branch-too-short-to-bend");
        }
        link_parents();
        return {std::move(rods_), std::move(bindings), std::move(stiff_)};
    }

private:
    void leave_out(const Rod& rod, const char* code) {
        stiff_.push_back({rod.branch, code, rod.points()[rod.points().size() / 2], rod.length()});
    }

    void drop(std::size_t rod, const char* code) {
        leave_out(rods_[rod], code);
        rods_.erase(rods_.begin() + static_cast<std::ptrdiff_t>(rod));
        loops_.erase(loops_.begin() + static_cast<std::ptrdiff_t>(rod));
    }

    /// Bends half a radius less at its tips. \return false if too little is left
    bool retreat(std::size_t index) {
        Rod& rod = rods_[index];
        const double step = 0.5 * rod.radii()[rod.end];
        if (graph_.nodes[rod.far_node].is_tip())
            rod.end = rod.at(std::max(0.0, rod.along()[rod.end] - step)).segment;
        if (graph_.nodes[rod.root_node].is_tip())
            rod.begin = rod.at(rod.along()[rod.begin] + step).segment + 1;
        auto loops = loops_of(surface_, rod);
        if (loops) loops_[index] = std::move(*loops);
        return loops.has_value();
    }

    /// A rod hangs on the last one on the way from the root.
    void link_parents() {
        std::vector<std::optional<std::size_t>> carrier(graph_.nodes.size());
        std::vector<std::optional<std::size_t>> rod_of(graph_.branches.size());
        for (std::size_t i = 0; i < rods_.size(); ++i) rod_of[rods_[i].branch] = i;
        std::vector<std::uint8_t> done(graph_.nodes.size(), 0);
        for (Rod& rod : rods_) {
            const std::size_t root = root_of(surface_, graph_, rod.branch);
            if (done[root] == 0)
                for (const Step& step : outward_from(graph_, root)) {
                    const std::size_t far = other_node(graph_, step.branch, step.from);
                    if (done[far] != 0) continue;
                    done[far] = 1;
                    carrier[far] = rod_of[step.branch] ? rod_of[step.branch] : carrier[step.from];
                }
            done[root] = 1;
            rod.parent = carrier[rod.root_node];
        }
    }

    const Surface& surface_;
    const CenterlineGraph& graph_;
    std::vector<Rod> rods_;
    std::vector<Loops> loops_;
    std::vector<StiffBranch> stiff_;
};

}  // namespace

std::size_t root_of(const Surface& surface, const CenterlineGraph& graph, std::size_t branch) {
    const std::size_t start = graph.branches[branch].start_node;
    std::vector<std::uint8_t> in_tree(graph.nodes.size(), 0);
    in_tree[start] = 1;
    for (const Step& step : outward_from(graph, start))
        in_tree[other_node(graph, step.branch, step.from)] = 1;
    std::optional<std::size_t> root;
    double least = std::numeric_limits<double>::infinity();
    for (const PatchMeasures& patch : measure_patches(surface)) {
        if (patch.kind != PatchKind::Inlet) continue;
        for (std::size_t n = 0; n < graph.nodes.size(); ++n) {
            const double d = (graph.nodes[n].position - patch.centroid).norm();
            // The line ends at the centroid of its opening.
            if (in_tree[n] == 0 || !graph.nodes[n].is_tip() || d > graph.nodes[n].radius) continue;
            if (d < least) {
                least = d;
                root = n;
            }
        }
    }
    if (root) return *root;
    for (const std::size_t tip : tips_by_radius(graph))
        if (in_tree[tip] != 0) return tip;
    return start;
}

Armature make_armature(const Surface& surface, const CenterlineGraph& graph,
                       const std::vector<std::size_t>& branches, const Progress& progress) {
    ArmatureMaker maker(surface, graph);
    std::vector<std::uint8_t> wanted(graph.branches.size(), 0);
    for (const std::size_t b : branches) wanted[b] = 1;
    for (const std::size_t b : branches) {
        if (wanted[b] == 0) continue;
        for (const Step& step : outward_from(graph, root_of(surface, graph, b))) {
            if (wanted[step.branch] == 0) continue;
            wanted[step.branch] = 0;
            maker.add(rest_rod(graph, step.branch, step.from));
        }
    }
    return maker.finish(progress);
}

void divide(Rod& rod, double from, double to, double fade, double spacing) {
    const double first = rod.along()[rod.begin], last = rod.along()[rod.end];
    const bool fades_out = to < last || !rod.free_end;
    from = std::max(from, first);
    to = std::min(to, last);
    rod.elements.clear();
    for (std::size_t i = rod.begin; i < rod.end;) {
        std::size_t j = i + 1;
        while (j < rod.end && rod.along()[j] - rod.along()[i] < spacing) ++j;
        const double middle = 0.5 * (rod.along()[i] + rod.along()[j]);
        if (rod.along()[i] >= from && rod.along()[j] <= to) {
            double share = std::min(1.0, (middle - from) / fade);
            if (fades_out) share = std::min(share, (to - middle) / fade);
            rod.elements.push_back(
                {.first = i,
                 .last = j,
                 .length = rod.along()[j] - rod.along()[i],
                 .radius = rod.radii()[(i + j) / 2],
                 .flexibility = std::max(kLeastFlexibility, share * share * (3.0 - 2.0 * share))});
        }
        i = j;
    }
}

}  // namespace vesselbench
