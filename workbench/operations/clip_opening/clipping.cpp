#include "workbench/operations/clip_opening/clipping.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "geometry/kernel/cross_section.h"
#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/diagnostic_text.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/wording.h"
#include "geometry/vessel/ends/stub_lines.h"
#include "geometry/vessel/openings/clip_openings.h"
#include "geometry/vessel/openings/flow_check.h"
#include "geometry/vessel/openings/opening_axis.h"
#include "geometry/vessel/openings/opening_names.h"
#include "geometry/vessel/openings/planned_cut.h"
#include "geometry/vessel/openings/vessel_check.h"
#include "workbench/operations/clip_opening/parameters.h"
#include "workbench/operations/clip_opening/wrong_cuts.h"
#include "workbench/operations/shared/opening_arguments.h"

namespace vesselbench {

namespace {

/// After so many ends could not be cut as planned, the rest of them is given up.
constexpr int kMostPlans = 12;

/// An opening so far away is not meant by a point [diameters].
constexpr double kFarthestInlet = 2.0;

/// A section farther away from where an opening was planned is another vessel's [its diameters].
constexpr double kSameVessel = 1.0;

void name_opening(OpeningPlan& plan, const Arguments& arguments) {
    auto kind = arguments.optional_text("kind");
    if (!kind && arguments.has("tip") && gathers(arguments)) kind = to_string(PatchKind::Inlet);
    const auto name = arguments.optional_text("name");
    if (kind || name)
        for (auto& opening : plan.openings) opening.patch = chosen_patch(opening.patch, kind, name);
}

/// With all ends, the inlets are those that were named. With one alone, they are chosen when it is
/// open (with_inlets).
InletChoice inlet_choice(const OpeningPlan& plan, const Arguments& arguments) {
    if (arguments.has("tip")) return {};
    InletChoice choice{.promote = true, .gathers = plan.gathers};
    for (const std::size_t inlet : plan.inlets)
        choice.points.push_back(plan.openings[inlet].place.plane.point);
    return choice;
}

/// The opening that a point means: near the opening, or near the tip that was cut there.
/// \throw AlgorithmFailure if there is none; the text names the nearest one
Vec3 inlet_meant(const Surface& surface, const OpeningPlan& plan, const Vec3& point) {
    const auto nearest = nearest_opening(surface, point);
    if (!nearest) throw AlgorithmFailure("there is no opening that could be the inlet");
    const PatchShape shape = patch_shape(surface, *nearest);
    if ((shape.plane.point - point).norm() <= kFarthestInlet * shape.diameter()) return point;
    for (const PlannedOpening& opening : plan.openings) {
        const Vec3& at = opening.place.plane.point;
        const auto patch = nearest_opening(surface, at);
        const double reach = kFarthestInlet * patch_shape(surface, *patch).diameter();
        if ((opening.place.tip - point).norm() <= reach) return at;
    }
    throw DiagnosedFailure(
        {.code = "no-opening-at-inlet",
         .operation = "clip-opening",
         .place = shape.plane.point,
         .words = {{"given", coordinates_text(point)}, {"nearest", surface.patches[*nearest].name}},
         .remedies = {{.operation = "clip-opening",
                       .arguments = {{"tip", coordinates_argument(point)}},
                       .before = true}}});
}

/// The surface with the openings near some points as its inlets.
Surface with_inlets(const Surface& surface, const OpeningPlan& plan, Positions points) {
    if (points.empty()) return surface;
    for (Vec3& point : points) point = inlet_meant(surface, plan, point);
    return name_openings(surface, {}, {.points = std::move(points)});
}

/// \throw AlgorithmFailure for a closed surface without a tube
void require_tube(const Surface& surface, const CenterlineGraph& graph) {
    if (surface.patches.size() == 1 && surface.topology->boundary_loops().empty() &&
        !has_tube(graph))
        throw DiagnosedFailure({.code = "no-tube",
                                .operation = "clip-opening",
                                .remedies = {{.arguments = {{"tip", ""}}}}});
}

[[noreturn]] void give_up(const FailedCut& failed, const OpeningPlanOptions& options) {
    if (options.tip) throw DiagnosedFailure(failed.why);
    OpeningPlanOptions without = options;
    without.closed.push_back(failed.tip);
    throw DiagnosedFailure({.code = "end-not-cut",
                            .operation = "clip-opening",
                            .place = failed.tip,
                            .words = {{"why", text_of(failed.why)}},
                            .remedies = {closing_remedy(without)}});
}

/// A branch that gets a line may show further ones without.
constexpr int kMostRounds = 3;

/// The lines that a plan needs; the ends without one go into its options.
std::shared_ptr<const CenterlineGraph> lines_and_stubs(const Surface& surface,
                                                       OpeningPlanOptions& options,
                                                       const Progress& progress) {
    if (options.tip) return lines_for_openings(surface, options.tip, progress);
    Positions wanted = options.open;
    wanted.insert(wanted.end(), options.inlets.begin(), options.inlets.end());
    for (int round = 0;; ++round) {
        LinesAndStubs lines = lines_to_ends(surface, wanted, progress);
        options.stubs = std::move(lines.stubs);
        if (round == kMostRounds) return lines.graph;
        const Positions more = stubs_to_open(surface, *lines.graph, options, progress);
        if (more.empty()) return lines.graph;
        wanted.insert(wanted.end(), more.begin(), more.end());
    }
}

/// Adds the places of ends that are named by their numbers, which are those of the plan that is
/// made without these names. \throw UsageError if there is no such end
void name_by_numbers(const Surface& surface, const Arguments& arguments,
                     OpeningPlanOptions& options, const Progress& progress) {
    if (!names_numbers(arguments)) return;
    OpeningPlanOptions plain = options;
    const auto graph = lines_and_stubs(surface, plain, progress);
    const OpeningPlan plan =
        plan_openings(surface, planning_lines(surface, *graph, plain), plain, progress);
    for (const NumberParameter& parameter : kNumberParameters) {
        if (!arguments.has(parameter.numbers)) continue;
        for (const double number : arguments.list(parameter.numbers)) {
            const auto end = std::ranges::find_if(
                plan.ends, [&](const EndRecord& e) { return e.number > 0 && e.number == number; });
            if (end == plan.ends.end())
                throw UsageError("clip-opening: " + std::string(parameter.numbers) +
                                 ": there is no end " + formatted(number) +
                                 ": the list of ends has their numbers");
            (options.*parameter.into).push_back(end->place);
        }
    }
}

/// True if the vessel that an opening was planned for is not there any longer.
bool is_gone(const Surface& surface, const PlannedOpening& opening) {
    if (opening.way != OpeningWay::Cut) return false;
    const Plane& plane = opening.place.plane;
    const auto curve = cross_section_at(surface, plane);
    if (!curve) return true;
    const bool far = (curve->centroid - plane.point).norm() > kSameVessel * curve->diameter();
    return far && curve->closed && !encloses(*curve, plane, plane.point);
}

/// Leaves out the openings of branches that were removed after they had been planned: their planes
/// would cut other vessels. \throw AlgorithmFailure if one of them is an inlet
void leave_out_gone(const Surface& surface, OpeningPlan& plan) {
    const auto gone = std::ranges::stable_partition(
        plan.openings, [&](const PlannedOpening& opening) { return !is_gone(surface, opening); });
    if (gone.begin() == plan.openings.begin()) return;  // the cut says what is wrong
    for (const PlannedOpening& opening : gone) {
        const Vec3& place = opening.place.plane.point;
        if (opening.patch->kind == PatchKind::Inlet)
            throw DiagnosedFailure({.code = "inlet-gone",
                                    .operation = "clip-opening",
                                    .place = place,
                                    .words = {{"opening", opening.patch->name}},
                                    .remedies = {{.arguments = {{"inlet", ""}}}}});
        plan.warnings.push_back({.code = "opening-gone",
                                 .operation = "clip-opening",
                                 .place = place,
                                 .words = {{"opening", opening.patch->name}}});
    }
    plan.openings.erase(gone.begin(), gone.end());
}

/// The plan resolved by an earlier run.
OpeningPlan stored_plan(const Surface& surface, const Arguments& arguments) {
    const Records& planes = arguments.records("planes");
    OpeningPlan plan{.openings = openings_in(planes)};
    if (plan.openings.size() < planes.list().size())
        throw UsageError("clip-opening: each normal in planes must be of unit length");
    const std::vector<Patch> patches = patches_in(arguments.records("names"));
    if (arguments.has("closings")) plan.closings = closings_in(arguments.records("closings"));
    if (patches.size() < plan.openings.size())  // both empty: there was nothing to open
        throw UsageError(
            "clip-opening: planes needs a record for each opening, and names as many records");
    for (std::size_t i = 0; i < plan.openings.size(); ++i) plan.openings[i].patch = patches[i];
    leave_out_gone(surface, plan);
    plan.ends = ends_of(plan);
    return plan;
}

/// A plan of all openings names all of them. One of a single end, or typed by hand, leaves the
/// others to the inlets that are asked for.
Positions stored_inlets(const OpeningPlan& plan, const Surface& clipped,
                        const Arguments& arguments) {
    const auto others = std::ranges::count_if(
        clipped.patches, [](const Patch& patch) { return patch.kind != PatchKind::Wall; });
    if (static_cast<std::size_t>(others) <= plan.openings.size()) return {};
    return points_of(arguments, "inlet");
}

}  // namespace

Clipping decide_openings(const Scene& scene, const Arguments& arguments, const Progress& progress) {
    const Surface& surface = surface_of(scene);
    OpeningPlanOptions options = plan_options(arguments, scene.image);
    name_by_numbers(surface, arguments, options, progress.silent());
    const auto graph = lines_and_stubs(surface, options, progress.part(0.0, 0.5));
    if (!options.tip) require_tube(surface, *graph);
    const LinesWithoutFrays lines = planning_lines(surface, *graph, options);
    const bool for_flow = !options.tip && arguments.text("check") == "flow";
    const bool chosen = !options.distance && !options.radii && !options.strict;
    for (int plans = 1;; ++plans) {
        Clipping made{.plan = plan_openings(surface, lines, options, progress.part(0.5, 0.8)),
                      .surface = {},
                      .options = options};
        if (for_flow) check_flow(made.plan, surface, *graph, options, progress.part(0.8, 0.81));
        name_opening(made.plan, arguments);
        ClippedSurface clipped =
            clip_openings(surface, made.plan, inlet_choice(made.plan, arguments), graph.get(),
                          progress.part(0.8, 1.0));
        made.surface = std::move(clipped.surface);
        if (clipped.failed.empty() && options.tip) {
            made.surface = with_inlets(made.surface, made.plan, points_of(arguments, "inlet"));
            return made;
        }
        if (clipped.failed.empty()) {
            require_most_kept(surface, made.surface);
            if (chosen) clipped.failed = wrong_cuts(surface, lines.graph, made.plan, made.surface);
            if (clipped.failed.empty()) return made;
        }
        if (options.strict || options.tip || plans == kMostPlans)
            give_up(clipped.failed.front(), options);
        options.failed.insert(options.failed.end(), clipped.failed.begin(), clipped.failed.end());
    }
}

OpeningPlan planned_openings(const Scene& scene, const Arguments& arguments,
                             const Progress& progress) {
    const Surface& surface = surface_of(scene);
    OpeningPlanOptions options = plan_options(arguments, scene.image);
    name_by_numbers(surface, arguments, options, progress.silent());
    const auto graph = lines_and_stubs(surface, options, progress.part(0.0, 0.6));
    return plan_openings(surface, planning_lines(surface, *graph, options), options,
                         progress.part(0.6, 1.0));
}

Clipping repeat_openings(const Surface& surface, const Arguments& arguments,
                         const Progress& progress) {
    Clipping made{.plan = stored_plan(surface, arguments), .surface = {}, .options = {}};
    const bool stubs =
        std::ranges::count(made.plan.closings, ClosingWay::RemoveStub, &PlannedClosing::way) > 0;
    const auto graph = stubs ? lines_for_openings(surface, std::nullopt, progress.part(0.0, 0.7))
                             : std::shared_ptr<const CenterlineGraph>();
    ClippedSurface clipped =
        clip_openings(surface, made.plan, {}, graph.get(), progress.part(0.7, 1.0));
    if (!clipped.failed.empty()) throw DiagnosedFailure(clipped.failed.front().why);
    made.surface = with_inlets(clipped.surface, made.plan,
                               stored_inlets(made.plan, clipped.surface, arguments));
    return made;
}

}  // namespace vesselbench
