#include "geometry/vessel/openings/openings.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <utility>

#include "geometry/editing/hole_filling.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/wording.h"
#include "geometry/vessel/centerlines/branch_queries.h"
#include "geometry/vessel/openings/clip.h"
#include "geometry/vessel/openings/opening_axis.h"
#include "geometry/vessel/openings/opening_names.h"

namespace vesselbench {

namespace {

/// A cap of a file is kept if it is flat to this fraction of its diameter and perpendicular to
/// within this angle.
constexpr double kKeptFlatness = 1e-5;
constexpr double kKeptTiltDeg = 2.0;
/// If a larger fraction of a branch is given up, a warning says so.
constexpr double kNoticedShare = 0.4;
/// A point this far from a tip does not mean it [radii of the tip].
constexpr double kFarthestTip = 4.0;
/// A sac: wider than its neck or its neighbours by this factor, and at most this many radii long.
constexpr double kSacToNeck = 1.4;
constexpr double kSacLength = 2.5;

/// A vessel end visible in the surface itself.
struct End {
    Vec3 centre = Vec3::Zero();
    double diameter = 0.0;
    std::optional<std::size_t> patch;  ///< its cap; none: an open border
    std::optional<std::size_t> tip;    ///< node of the graph
};

std::string degrees_text(double angle) {
    return formatted(angle, "%.0f degrees");
}

std::vector<End> visible_ends(const Surface& surface) {
    std::vector<End> ends;
    for (const auto& loop : surface.topology->boundary_loops()) {
        const double length = mean_edge(surface.points(), loop) * static_cast<double>(loop.size());
        ends.push_back(
            {loop_centre(surface, loop), length / std::numbers::pi, std::nullopt, std::nullopt});
    }
    for (std::size_t p = 0; p < surface.patches.size(); ++p) {
        if (surface.patches[p].kind == PatchKind::Wall) continue;
        const PatchShape shape = patch_shape(surface, p);
        ends.push_back({shape.plane.point, shape.diameter(), p, std::nullopt});
    }
    return ends;
}

/// Assigns a tip to each end, the closest pairs first.
void match_tips(std::vector<End>& ends, const CenterlineGraph& graph) {
    struct Pair {
        double distance;
        std::size_t end, tip;
    };

    std::vector<Pair> pairs;
    for (std::size_t e = 0; e < ends.size(); ++e)
        for (std::size_t n = 0; n < graph.nodes.size(); ++n) {
            if (!graph.nodes[n].is_tip()) continue;
            const double distance = (graph.nodes[n].position - ends[e].centre).norm();
            if (distance < kEndReach * ends[e].diameter) pairs.push_back({distance, e, n});
        }
    std::stable_sort(pairs.begin(), pairs.end(),
                     [](const Pair& a, const Pair& b) { return a.distance < b.distance; });
    std::set<std::size_t> taken;
    for (const Pair& pair : pairs)
        if (!ends[pair.end].tip && taken.insert(pair.tip).second) ends[pair.end].tip = pair.tip;
}

/// The part of a branch beyond the wall of the vessel it leaves.
struct BlindBranch {
    double length = 0.0;  ///< [mm]
    double widest = 0.0;  ///< largest radius [mm]
    bool bulges = false;  ///< wider than its neck, or than every vessel it joins: a sac

    [[nodiscard]] bool is_short() const { return length < kSacLength * widest; }
};

/// Radius of a branch beyond the furcation at `node` [mm].
double radius_beyond(const CenterlineGraph& graph, std::size_t branch, std::size_t node) {
    const double zone = furcation_zone_end(graph, branch, node);
    return radius_at(graph.branches[branch], place_from_node(graph, branch, node, zone).abscissa);
}

BlindBranch blind_branch(const CenterlineGraph& graph, std::size_t tip, std::size_t root) {
    const std::size_t index = branch_of_tip(graph, tip);
    const auto& branch = graph.branches[index];
    const double whole = branch_length(branch);
    const double zone = furcation_zone_end(graph, index, root);
    BlindBranch found{.length = whole - zone};
    double neck = std::numeric_limits<double>::infinity();
    for (double s = zone; s <= whole; s += 0.02 * whole + 1e-9) {
        const double r = radius_at(branch, place_from_node(graph, index, root, s).abscissa);
        neck = std::min(neck, r);
        found.widest = std::max(found.widest, r);
        found.bulges = found.bulges || r > kSacToNeck * neck;
    }
    double others = 0.0;
    for (const std::size_t other : graph.nodes[root].branches)
        if (other != index) others = std::max(others, radius_beyond(graph, other, root));
    found.bulges = found.bulges || found.widest > kSacToNeck * others;
    return found;
}

bool is_good_cap(const Surface& surface, std::size_t patch) {
    const PatchShape shape = patch_shape(surface, patch);
    return shape.flatness <= kKeptFlatness * shape.diameter() &&
           opening_tilt_deg(surface, patch) <= kKeptTiltDeg;
}

PlannedOpening kept_cap(const Surface& surface, std::size_t patch, const Vec3& tip) {
    const PatchShape shape = patch_shape(surface, patch);
    const auto axis = axis_at_patch(surface, patch);
    return {.place = {.tip = tip,
                      .plane = shape.plane,
                      .distance = 0.0,
                      .diameter = shape.diameter(),
                      .tilt_deg = axis ? axis->tilt_deg : 0.0,
                      .bend_deg = axis ? axis->bend_deg : 0.0,
                      .measured = axis.has_value()},
            .keep = true,
            .patch = std::nullopt};
}

class Planner {
public:
    Planner(const Surface& surface, const CenterlineGraph& graph, const OpeningPlanOptions& options)
        : surface_(surface), graph_(graph), options_(options), ends_(visible_ends(surface)) {
        match_tips(ends_, graph);
    }

    OpeningPlan run() {
        if (options_.tip) {
            plan_tip(tip_to_open(graph_, *options_.tip));
        } else {
            plan_visible();
            if (all_ends_are_cuts() || plan_.openings.size() < 2) plan_blind();
        }
        if (plan_.openings.empty())
            throw AlgorithmFailure(
                "no vessel end that could be opened was found: give one with tip=x,y,z");
        return std::move(plan_);
    }

private:
    void plan_visible() {
        for (const End& end : ends_) {
            if (end.tip)
                plan_tip(*end.tip);
            else if (end.patch)
                plan_.warnings.push_back("the patch '" + surface_.patches[*end.patch].name +
                                         "' at " + place_text(end.centre) +
                                         " is not at a vessel's tip and was left unchanged");
            else
                plan_.warnings.push_back("the open border at " + place_text(end.centre) +
                                         " is not at a vessel's tip: close it with fill-hole");
        }
    }

    /// Open rims and named caps determine the vessel ends. Cuts at an image's border do not: other
    /// vessels may end inside the image. Nor does a single end: blood has to enter and leave.
    bool all_ends_are_cuts() const {
        return std::all_of(ends_.begin(), ends_.end(), [&](const End& end) {
            return end.patch && surface_.patches[*end.patch].kind == PatchKind::Cut;
        });
    }

    void plan_blind() {
        for (std::size_t n = 0; n < graph_.nodes.size(); ++n) {
            const bool visible = std::any_of(ends_.begin(), ends_.end(),
                                             [&](const End& end) { return end.tip == n; });
            if (!graph_.nodes[n].is_tip() || visible) continue;
            plan_blind_tip(n);
        }
    }

    /// An aneurysm stays closed, as does a branch too short to be opened. If cuts already provide
    /// inflow and outflow, a short blind stub is not an opening either.
    void plan_blind_tip(std::size_t tip) {
        const std::size_t index = branch_of_tip(graph_, tip);
        const auto& branch = graph_.branches[index];
        const std::size_t root = branch.start_node == tip ? branch.end_node : branch.start_node;
        if (!graph_.nodes[root].is_tip()) {
            const BlindBranch blind = blind_branch(graph_, tip, root);
            if (blind.is_short() && (blind.bulges || ends_.size() >= 2)) {
                plan_.warnings.push_back("the branch with its tip at " +
                                         place_text(graph_.nodes[tip].position) +
                                         (blind.bulges ? " looks like an aneurysm" : " is short") +
                                         " and was not opened; tip=x,y,z opens it");
                return;
            }
        }
        try {
            plan_tip(tip);
        } catch (const AlgorithmFailure& failure) {
            plan_.warnings.push_back(std::string("left closed: ") + failure.what());
        }
    }

    void plan_tip(std::size_t tip) {
        const auto end = std::find_if(ends_.begin(), ends_.end(),
                                      [&](const End& e) { return e.tip && *e.tip == tip; });
        const bool capped = end != ends_.end() && end->patch;
        PlannedOpening opening;
        if (capped && !options_.distance && !options_.radii && is_good_cap(surface_, *end->patch))
            opening = kept_cap(surface_, *end->patch, graph_.nodes[tip].position);
        else
            opening.place = choose_opening_place(surface_, graph_, tip, distance(tip));
        if (capped && surface_.patches[*end->patch].kind != PatchKind::Cut)
            opening.patch = surface_.patches[*end->patch];
        warn_of_place(opening);
        plan_.openings.push_back(std::move(opening));
    }

    std::optional<double> distance(std::size_t tip) const {
        if (options_.distance) return options_.distance;
        if (options_.radii) return *options_.radii * tip_radius(graph_, tip);
        return std::nullopt;
    }

    void warn_of_place(const PlannedOpening& opening) {
        if (opening.place.bend_deg > kBendDeg)
            plan_.warnings.push_back("the opening at " + place_text(opening.place.plane.point) +
                                     " lies in a bend: the vessel turns by " +
                                     degrees_text(opening.place.bend_deg) + " over one diameter");
        if (opening.place.share > kNoticedShare)
            plan_.warnings.push_back("the opening at " + place_text(opening.place.plane.point) +
                                     " gives up " +
                                     std::to_string(std::lround(100.0 * opening.place.share)) +
                                     " % of its branch: the end is oblique or ragged, or bent");
        if (!opening.place.measured)
            plan_.warnings.push_back("the vessel behind the opening at " +
                                     place_text(opening.place.plane.point) +
                                     " is too short to measure its axis: the opening follows the "
                                     "centerline's direction");
        if (opening.place.tilt_deg > kKeptTiltDeg)
            plan_.warnings.push_back("the opening at " + place_text(opening.place.plane.point) +
                                     " is tilted by " + degrees_text(opening.place.tilt_deg) +
                                     " against the vessel's axis");
    }

    const Surface& surface_;
    const CenterlineGraph& graph_;
    OpeningPlanOptions options_;
    std::vector<End> ends_;
    OpeningPlan plan_;
};

double distance_to_vertices(const Surface& surface, const Vec3& point) {
    double squared = std::numeric_limits<double>::infinity();
    for (const Vec3& p : surface.points()) squared = std::min(squared, (p - point).squaredNorm());
    return std::sqrt(squared);
}

/// True if the cut for opening i removed the surface at another opening's place that is not merely
/// another tip of the same ragged end.
bool takes_another_end(const Surface& before, const Surface& after, const OpeningPlan& plan,
                       std::size_t i) {
    constexpr double kSameEnd = 2.0;  // diameters of the cut
    const auto patch = nearest_opening(after, plan.openings[i].place.plane.point);
    const double diameter = patch ? patch_shape(after, *patch).diameter() : 0.0;
    for (std::size_t j = 0; j < plan.openings.size(); ++j) {
        const OpeningPlace &own = plan.openings[i].place, &other = plan.openings[j].place;
        if (j == i || (own.tip - other.tip).norm() < kSameEnd * diameter) continue;
        // an existing opening is searched at its cap, a future one at its tip
        const Vec3& at = j < i ? other.plane.point : other.tip;
        const double was = distance_to_vertices(before, at);
        if (distance_to_vertices(after, at) > 1.5 * was + 0.1 * diameter) return true;
    }
    return false;
}

}  // namespace

std::size_t tip_to_open(const CenterlineGraph& graph, const Vec3& point) {
    const auto tip = nearest_tip(graph, point);
    if (!tip) throw AlgorithmFailure("the vessels have no tip that could be opened");
    const Vec3& found = graph.nodes[*tip].position;
    if ((found - point).norm() > kFarthestTip * tip_radius(graph, *tip))
        throw AlgorithmFailure("no branch has its tip near " + place_text(point) +
                               "; the nearest one is at " + place_text(found));
    return *tip;
}

OpeningPlan plan_openings(const Surface& surface, const CenterlineGraph& graph,
                          const OpeningPlanOptions& options) {
    return Planner(surface, graph, options).run();
}

Surface clip_openings(const Surface& surface, const OpeningPlan& plan,
                      const std::optional<Vec3>& inlet, std::vector<std::size_t>* left_out,
                      const Progress& progress) {
    Surface result = surface;
    std::vector<std::string> unnamed;
    for (std::size_t i = 0; i < plan.openings.size(); ++i) {
        progress.report(static_cast<double>(i) / static_cast<double>(plan.openings.size()),
                        "cutting");
        const PlannedOpening& opening = plan.openings[i];
        if (opening.keep) {
            const auto patch = nearest_opening(result, opening.place.plane.point);
            if (!patch)
                throw AlgorithmFailure("there is no cap at " +
                                       place_text(opening.place.plane.point) + " any longer");
            if (opening.patch) {
                auto patches = result.patches;
                patches[*patch] = *opening.patch;
                result = result.with_patches(*result.patch_labels, patches);
            } else {
                unnamed.push_back(result.patches[*patch].name);
            }
            continue;
        }
        Patch patch{free_patch_name("opening", 1, result.patches), PatchKind::Cut};
        if (opening.patch) patch = *opening.patch;
        Surface cut = clip_branch(result, opening.place.plane, patch);
        if (takes_another_end(result, cut, plan, i)) {
            if (left_out != nullptr) left_out->push_back(i);
            continue;
        }
        if (!opening.patch) unnamed.push_back(patch.name);
        result = std::move(cut);
    }
    return name_openings(result, unnamed, inlet);
}

}  // namespace vesselbench
