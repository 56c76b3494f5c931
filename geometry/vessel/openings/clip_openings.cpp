#include "geometry/vessel/openings/clip_openings.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "geometry/editing/editable_surface.h"
#include "geometry/editing/hole_filling.h"
#include "geometry/editing/plane_cut.h"
#include "geometry/editing/rims.h"
#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/wording.h"
#include "geometry/vessel/centerlines/branch_queries.h"
#include "geometry/vessel/openings/opening_axis.h"
#include "geometry/vessel/openings/opening_names.h"
#include "geometry/vessel/openings/remove_branch.h"
#include "geometry/vessel/openings/rim_shape.h"

namespace vesselbench {

namespace {

/// A kept cap that is less flat is flattened [diameters].
constexpr double kKeptFlatness = 1e-5;
/// A rim that was not edited is within this distance of where it was planned [mm], a cap within
/// this fraction of its diameter.
constexpr double kSamePlace = 1e-6;
constexpr double kSameCap = 0.2;  // diameters
/// A cut that takes a larger share of the wall away is turned the wrong way.
constexpr double kMostCutOff = 0.75;

/// Patches of planned openings are found again by these names while the surface is edited.
std::string mark_of(std::size_t opening) {
    return "\x01" + std::to_string(opening);
}

Surface renamed(const Surface& surface, std::size_t patch, Patch to) {
    std::vector<Patch> patches = surface.patches;
    patches[patch] = std::move(to);
    return surface.with_patches(*surface.patch_labels, std::move(patches));
}

/// The open border whose centre is nearest to a point.
std::vector<VertexId> rim_at(const Surface& surface, const Vec3& point) {
    std::vector<VertexId> best;
    double least = std::numeric_limits<double>::infinity();
    for (auto& loop : surface.topology->boundary_loops())
        if (const double d = (loop_centre(surface, loop) - point).norm(); d < least) {
            least = d;
            best = std::move(loop);
        }
    if (best.empty()) throw AlgorithmFailure("there is no open rim at " + place_text(point));
    return best;
}

/// \param code of one that needs no figures
Diagnostic cut_problem(const char* code, const Plane& plane) {
    Diagnostic problem{.code = code, .place = plane.point};
    if (problem.code == "cut-without-rim") problem.remedies = {{.operation = "repair"}};
    return problem;
}

/// Makes the cuts of a plan one after the other on one editable surface. A cut is made as if the
/// surface were read back in between, but it is only where an earlier cut touched the same
/// triangles.
class Cuts {
public:
    Cuts(const Surface& surface, const std::vector<PlannedOpening>& openings,
         const Progress& progress)
        : surface_(surface), openings_(openings), progress_(progress) {}

    /// \param failed receives what could not be cut
    Surface run(std::vector<FailedCut>& failed) {
        tries_.assign(openings_.size(), 0);
        while (!pass()) progress_.check_cancelled();
        for (std::size_t i = 0; i < openings_.size(); ++i)
            if (problems_[i])
                failed.push_back(
                    {openings_[i].place.tip, openings_[i].place.plane.point, *problems_[i]});
        return base_.empty() ? surface_ : base_;
    }

private:
    /// Makes all cuts from the start. A cut that fails has damaged the surface: false, and the next
    /// pass makes it in another way, or not at all. The other cuts are still tried: on a bad mesh
    /// most of them fail in the first way, and a pass for each would take minutes.
    bool pass() {
        base_ = surface_;
        EditableSurface edited(base_);
        problems_.resize(openings_.size());
        damaged_ = false;
        for (std::size_t i = 0; i < openings_.size(); ++i) {
            if (openings_[i].way != OpeningWay::Cut || tries_[i] == kTries) continue;
            progress_.report(static_cast<double>(i) / static_cast<double>(openings_.size()),
                             "cutting");
            cut(edited, i);
        }
        if (!damaged_) base_ = edited.to_surface();
        return !damaged_;
    }

    /// Moving vertices may pinch the rim on a bad mesh; cutting without moving never does.
    void cut(EditableSurface& edited, std::size_t i) {
        const Plane& plane = openings_[i].place.plane;
        auto curve = cross_section_at(base_, plane);
        if (!curve || !is_untouched(edited, *curve)) {
            if (damaged_) return;  // perhaps there: the next pass judges it
            base_ = edited.to_surface();
            edited = EditableSurface(base_);
            curve = cross_section_at(base_, plane);
        }
        if (!curve || !curve->closed)
            return fail(i, kTries,
                        cut_problem(curve ? "plane-meets-border" : "plane-misses-surface", plane));
        const auto near = tries_[i] == 0 ? NearVertices::MoveOntoPlane : NearVertices::Stay;
        PlaneCut made = cut_along(edited, plane, *curve, near);
        if (made.rim.empty()) return fail(i, tries_[i] + 1, cut_problem("cut-without-rim", plane));
        const auto branch = part_above(edited, made);
        if (!branch) return fail(i, tries_[i] + 1, cut_problem("cut-in-loop", plane));
        if (const double share = share_of(edited, *branch); share > kMostCutOff)
            return fail(i, kTries,
                        {.code = "cut-takes-wall",
                         .place = plane.point,
                         .figures = {{"wall_percent", 100.0 * share}}});
        edited.remove(*branch);
        clean_rim(edited, made.rim);
        cap(edited, i, made.rim);
    }

    /// Area of a part over that of all that is left [-]. \param part by triangle
    static double share_of(const EditableSurface& edited, const std::vector<std::uint8_t>& part) {
        double all = 0.0, inside = 0.0;
        for (TriangleId t = 0; t < edited.triangle_count(); ++t) {
            if (edited.is_removed(t)) continue;
            const auto& [a, b, c] = edited.triangle(t);
            const double size =
                (edited.point(b) - edited.point(a)).cross(edited.point(c) - edited.point(a)).norm();
            all += size;
            if (part[t] != 0) inside += size;
        }
        return all > 0.0 ? inside / all : 0.0;
    }

    void cap(EditableSurface& edited, std::size_t i, const std::vector<VertexId>& wall) {
        const Plane& plane = openings_[i].place.plane;
        const std::vector<VertexId> rim(wall.rbegin(), wall.rend());
        try {
            for (const VertexId v : rim) edited.move(v, plane.projected(edited.point(v)));
            const std::uint16_t label = edited.add_patch({mark_of(i), PatchKind::Cut});
            close_flat(edited, rim, plane, mean_edge(edited, rim), label);
        } catch (const AlgorithmFailure& failure) {
            fail(i, kTries, diagnostics_of(failure).front());
        }
    }

    /// On a damaged surface a cut is never given up: the damage may be the reason.
    void fail(std::size_t i, int tries, const Diagnostic& why) {
        if (damaged_ && tries == kTries) return;
        problems_[i] = tries == kTries ? std::optional(why) : std::nullopt;
        tries_[i] = tries;
        damaged_ = true;
    }

    bool is_untouched(const EditableSurface& edited, const SectionCurve& curve) const {
        return std::ranges::all_of(curve.triangles, [&](TriangleId t) {
            return !edited.is_removed(t) && edited.triangle(t) == base_.triangles()[t] &&
                   std::ranges::all_of(base_.triangles()[t], [&](VertexId v) {
                       return edited.point(v) == base_.points()[v];
                   });
        });
    }

    static constexpr int kTries = 2;

    const Surface& surface_;
    const std::vector<PlannedOpening>& openings_;
    const Progress& progress_;
    Surface base_;
    std::vector<int> tries_;                           ///< by opening
    std::vector<std::optional<Diagnostic>> problems_;  ///< by opening
    bool damaged_ = false;                             ///< the pass has a cut that failed
};

class Clipper {
public:
    Clipper(const Surface& surface, const OpeningPlan& plan, const CenterlineGraph* graph)
        : result_(surface), plan_(plan), graph_(graph), before_(plan.openings.size()) {}

    ClippedSurface run(const InletChoice& inlet, const Progress& progress) {
        for (std::size_t i = 0; i < plan_.openings.size(); ++i)
            if (plan_.openings[i].way == OpeningWay::KeepCap ||
                plan_.openings[i].way == OpeningWay::Rename)
                keep_cap(i);
        ClippedSurface clipped;
        cap_rims(clipped.failed);
        if (std::ranges::count(plan_.openings, OpeningWay::Cut, &PlannedOpening::way) > 0)
            result_ = Cuts(result_, plan_.openings, progress).run(clipped.failed);
        for (const PlannedClosing& closing : plan_.closings) close(closing, clipped.failed);
        check_flatness(clipped.failed);
        const std::vector<std::string> unnamed = name_made();
        clipped.surface = name_openings(result_, unnamed, inlet);
        return clipped;
    }

private:
    void keep_cap(std::size_t i) {
        const Plane& plane = plan_.openings[i].place.plane;
        const auto patch = nearest_opening(result_, plane.point);
        if (!patch)
            throw AlgorithmFailure("there is no cap at " + place_text(plane.point) + " any longer");
        const PatchShape shape = patch_shape(result_, *patch);
        before_[i] = result_.patches[*patch];
        if (plan_.openings[i].way == OpeningWay::KeepCap &&
            shape.flatness > kKeptFlatness * shape.diameter())
            flatten(*patch, plane);
        result_ = renamed(result_, *patch, {mark_of(i), before_[i]->kind});
    }

    void flatten(std::size_t patch, const Plane& plane) {
        Positions points = result_.points();
        for (TriangleId t = 0; t < result_.triangle_count(); ++t)
            if ((*result_.patch_labels)[t] == patch)
                for (const VertexId v : result_.triangles()[t])
                    points[v] = plane.projected(result_.points()[v]);
        result_ = result_.with_positions(std::move(points));
    }

    void cap_rims(std::vector<FailedCut>& failed) {
        std::optional<EditableSurface> edited;
        for (std::size_t i = 0; i < plan_.openings.size(); ++i) {
            const PlannedOpening& opening = plan_.openings[i];
            if (opening.way != OpeningWay::CapRim) continue;
            if (!edited) edited.emplace(result_);
            const Plane& plane = opening.place.plane;
            std::vector<VertexId> rim = rim_at(result_, plane.point);
            std::ranges::reverse(rim);
            try {
                for (const VertexId v : rim) edited->move(v, plane.projected(edited->point(v)));
                const std::uint16_t label = edited->add_patch({mark_of(i), PatchKind::Cut});
                close_flat(*edited, rim, plane, mean_edge(*edited, rim), label);
            } catch (const AlgorithmFailure& failure) {
                failed.push_back({opening.place.tip, plane.point, diagnostics_of(failure).front()});
            }
        }
        if (edited) result_ = edited->to_surface();
    }

    /// A cut may have taken the end away.
    void close(const PlannedClosing& closing, std::vector<FailedCut>& failed) {
        switch (closing.way) {
            case ClosingWay::FillRim:
                fill(closing.place);
                return;
            case ClosingWay::WallCap:
                if (const auto patch = opening_at(closing.place)) make_wall(*patch);
                return;
            case ClosingWay::RemoveStub:
                try {
                    remove_stub(closing.place);
                } catch (const AlgorithmFailure& failure) {
                    failed.push_back(
                        {closing.place, closing.place, diagnostics_of(failure).front()});
                }
                return;
        }
    }

    void fill(const Vec3& centre) {
        if (result_.topology->boundary_loops().empty()) return;
        const std::vector<VertexId> rim = rim_at(result_, centre);
        if ((loop_centre(result_, rim) - centre).norm() > kSamePlace) return;
        EditableSurface edited(result_);
        fill_rim(edited, rim, 0);
        result_ = edited.to_surface();
    }

    std::optional<std::size_t> opening_at(const Vec3& centre) const {
        const auto patch = nearest_opening(result_, centre);
        if (!patch) return std::nullopt;
        const PatchShape shape = patch_shape(result_, *patch);
        // A neighbour that was flattened may have moved some of its vertices.
        const bool same = (shape.plane.point - centre).norm() < kSameCap * shape.diameter();
        return same && !result_.patches[*patch].name.starts_with('\x01') ? patch : std::nullopt;
    }

    void make_wall(std::size_t patch) {
        PatchLabels labels = *result_.patch_labels;
        std::vector<Patch> patches = result_.patches;
        for (auto& label : labels) {
            if (label == patch) label = 0;
            if (label > patch) --label;
        }
        patches.erase(patches.begin() + static_cast<std::ptrdiff_t>(patch));
        result_ = result_.with_patches(std::move(labels), std::move(patches));
    }

    void remove_stub(const Vec3& tip) {
        if (graph_ == nullptr) throw AlgorithmFailure("a stub's removal needs centerlines");
        if (const auto node = tip_near(*graph_, tip))
            result_ = remove_branch(result_, *graph_, *node).surface;
    }

    /// A later cut may have bent a cap.
    void check_flatness(std::vector<FailedCut>& failed) const {
        for (std::size_t p = 0; p < result_.patches.size(); ++p)
            for (std::size_t i = 0; i < plan_.openings.size(); ++i) {
                const PlannedOpening& opening = plan_.openings[i];
                if (opening.way == OpeningWay::Rename || result_.patches[p].name != mark_of(i))
                    continue;
                const PatchShape shape = patch_shape(result_, p);
                if (shape.flatness > kKeptFlatness * shape.diameter())
                    failed.push_back({opening.place.tip, opening.place.plane.point,
                                      cut_problem("cap-not-flat-after-cuts", opening.place.plane)});
            }
    }

    /// Gives the marked patches their names. \return those of openings that are still to be named
    std::vector<std::string> name_made() {
        std::vector<std::string> unnamed;
        std::vector<Patch> patches = result_.patches;
        for (std::size_t i = 0; i < plan_.openings.size(); ++i) {
            const auto made = std::ranges::find(patches, mark_of(i), &Patch::name);
            if (made == patches.end()) continue;
            const PlannedOpening& opening = plan_.openings[i];
            if (opening.patch) {
                *made = *opening.patch;
                continue;
            }
            if (before_[i])
                *made = *before_[i];
            else
                *made = {free_patch_name("opening", 1, patches), PatchKind::Cut};
            unnamed.push_back(made->name);
        }
        result_ = result_.with_patches(*result_.patch_labels, std::move(patches));
        return unnamed;
    }

    Surface result_;
    const OpeningPlan& plan_;
    const CenterlineGraph* graph_;
    std::vector<std::optional<Patch>> before_;  ///< of kept caps
};

}  // namespace

ClippedSurface clip_openings(const Surface& surface, const OpeningPlan& plan,
                             const InletChoice& inlet, const CenterlineGraph* graph,
                             const Progress& progress) {
    return Clipper(surface, plan, graph).run(inlet, progress);
}

}  // namespace vesselbench
