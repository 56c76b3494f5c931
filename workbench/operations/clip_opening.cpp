#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include <nlohmann/json.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/unsmoothed.h"
#include "geometry/kernel/wording.h"
#include "geometry/vessel/openings/clip_openings.h"
#include "geometry/vessel/openings/flow_check.h"
#include "geometry/vessel/openings/frayed_trunks.h"
#include "geometry/vessel/openings/lost_vessels.h"
#include "geometry/vessel/openings/opening_axis.h"
#include "geometry/vessel/openings/opening_names.h"
#include "geometry/vessel/openings/openings.h"
#include "geometry/vessel/openings/planned_cut.h"
#include "geometry/vessel/openings/unlined_ends.h"
#include "geometry/vessel/openings/vessel_check.h"
#include "workbench/case/argument_texts.h"
#include "workbench/operations/shared/opening_arguments.h"
#include "workbench/operations/shared/opening_json.h"
#include "workbench/operations/shared/replacing_stepper.h"
#include "workbench/operations/table.h"

namespace vesselbench {

namespace {

using nlohmann::ordered_json;

/// After so many ends could not be cut as planned, the rest of them is given up.
constexpr int kMostPlans = 12;

void check_arguments(const Arguments& arguments) {
    if ((arguments.has("name") || arguments.has("kind")) && !arguments.has("tip") &&
        !arguments.has("planes"))
        throw UsageError("clip-opening: name and kind belong to one opening: give its tip, too");
    if (arguments.has("distance") && arguments.has("radii"))
        throw UsageError("clip-opening: give distance or radii, not both");
    if (arguments.has("planes") != arguments.has("names"))
        throw UsageError("clip-opening: give planes and names together");
    for (const char* name : {"open", "closed", "inlet"})
        if (arguments.has(name) && arguments.list(name).size() % 3 != 0)
            throw UsageError("clip-opening: " + std::string(name) +
                             " needs three numbers for each end");
}

/// What was decided, and the surface made by it.
struct Clipping {
    OpeningPlan plan;
    Surface surface;
};

/// The points of a list, three numbers each; empty if it is not given.
Positions points_of(const Arguments& arguments, const char* name) {
    if (!arguments.has(name)) return {};
    const std::vector<double>& numbers = arguments.list(name);
    Positions points;
    for (std::size_t i = 0; i + 2 < numbers.size(); i += 3)
        points.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
    return points;
}

VoxelEdges voxel_edges(const Image& image) {
    return image.index_to_patient.topLeftCorner<3, 3>();
}

OpeningPlanOptions plan_options(const Arguments& arguments, const std::optional<Image>& image) {
    OpeningPlanOptions options{.tip = arguments.optional_point("tip"),
                               .distance = arguments.optional_real("distance"),
                               .radii = arguments.optional_real("radii"),
                               .strict = arguments.flag("strict"),
                               .border_cuts = image.has_value()};
    options.leave_closed = arguments.text("closed_ends") == "leave";
    if (options.leave_closed) options.border_cuts = false;
    if (image) options.voxels = voxel_edges(*image);
    if (!options.tip) options.inlets = points_of(arguments, "inlet");
    options.open = points_of(arguments, "open");
    options.closed = points_of(arguments, "closed");
    return options;
}

void name_opening(OpeningPlan& plan, const Arguments& arguments) {
    const auto kind = arguments.optional_text("kind");
    const auto name = arguments.optional_text("name");
    if (kind || name)
        for (auto& opening : plan.openings) opening.patch = chosen_patch(opening.patch, kind, name);
}

/// With all ends, the inlets are those that were named. With one alone, they are chosen when it is
/// open (with_inlets).
InletChoice inlet_choice(const OpeningPlan& plan, const Arguments& arguments) {
    if (arguments.has("tip")) return {};
    InletChoice choice{.promote = true};
    for (const std::size_t inlet : plan.inlets)
        choice.points.push_back(plan.openings[inlet].place.plane.point);
    return choice;
}

/// An opening so far away is not meant by a point [diameters].
constexpr double kFarthestInlet = 2.0;

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
    throw AlgorithmFailure(
        "no opening is near inlet=" + coordinates_argument(point) + "; the nearest one, " +
        surface.patches[*nearest].name + ", is at " + place_text(shape.plane.point) +
        ": open the inlet's own end first (clip-opening tip=" + coordinates_argument(point) + ")");
}

/// The surface with the openings near some points as its inlets.
Surface with_inlets(const Surface& surface, const OpeningPlan& plan, Positions points) {
    if (points.empty()) return surface;
    for (Vec3& point : points) point = inlet_meant(surface, plan, point);
    return name_openings(surface, {}, points);
}

/// Ends are small parts of vessels. Centerlines of an organ lead through its lobes, and a cut
/// across one would leave the rest. \throw AlgorithmFailure if half of a closed surface would go
void require_most_kept(const Surface& before, const Surface& after) {
    constexpr double kLeastKept = 0.5;
    if (!before.topology->boundary_loops().empty()) return;
    const double kept = std::abs(volume(after) / volume(before));
    if (kept < kLeastKept)
        throw AlgorithmFailure("the cuts would take " + formatted(100.0 * (1.0 - kept), "%.0f") +
                               " % of the model away: it is hardly a vessel; tip=x,y,z opens a "
                               "single end");
}

/// The place of a plan that has to go so that a vessel stays: its stub, or the cut next to it.
/// \throw AlgorithmFailure if there is neither
FailedCut cut_that_lost(const OpeningPlan& plan, const LostVessel& lost) {
    FailedCut failed{.why = "a cut there would lose " + formatted(lost.length, "%.1f") +
                            " mm of vessel at " + place_text(lost.place) + ", " +
                            formatted(lost.diameter) + " mm wide",
                     .lost = true};
    for (const PlannedClosing& closing : plan.closings)
        if (closing.way == ClosingWay::RemoveStub &&
            (closing.place - lost.tip).norm() < 0.5 * lost.diameter) {
            failed.tip = failed.place = closing.place;
            return failed;
        }
    double least = std::numeric_limits<double>::infinity();
    for (const PlannedOpening& opening : plan.openings) {
        const double distance = (opening.place.plane.point - lost.root).norm();
        if (opening.way != OpeningWay::Cut || distance >= least) continue;
        least = distance;
        failed.tip = opening.place.tip;
        failed.place = opening.place.plane.point;
    }
    if (std::isinf(least)) throw AlgorithmFailure(failed.why);
    return failed;
}

/// Cuts that were made, but have opened a vessel's side or lost a vessel: places to be avoided.
std::vector<FailedCut> wrong_cuts(const Surface& before, const CenterlineGraph& graph,
                                  const Clipping& made) {
    std::vector<FailedCut> wrong;
    if (made.plan.openings.empty()) return wrong;
    for (const std::size_t patch : openings_in_walls(before, made.surface)) {
        const Vec3 at = patch_shape(made.surface, patch).plane.point;
        const auto opening = std::ranges::min_element(
            made.plan.openings, {},
            [&](const PlannedOpening& o) { return (o.place.plane.point - at).norm(); });
        wrong.push_back({opening->place.tip, opening->place.plane.point,
                         "the opening at " + place_text(at) + " would lie in a vessel's side"});
    }
    const CenterlineGraph vessels = without_frays(before, graph).graph;
    const std::vector<LostVessel> lost = lost_vessels(vessels, made.surface);
    if (lost.empty() || !lost_vessels(vessels, before).empty()) return wrong;  // lines lie outside
    for (const LostVessel& vessel : lost) wrong.push_back(cut_that_lost(made.plan, vessel));
    return wrong;
}

/// \throw AlgorithmFailure for a closed surface without a tube
void require_tube(const Surface& surface, const CenterlineGraph& graph) {
    if (surface.patches.size() == 1 && surface.topology->boundary_loops().empty() &&
        !has_tube(graph))
        throw AlgorithmFailure(
            "there is no vessel in it: nothing of the closed surface is 1.5 times as long "
            "as it is wide; tip=x,y,z opens it nevertheless");
}

[[noreturn]] void give_up(const FailedCut& failed, const OpeningPlanOptions& options) {
    if (options.tip) throw AlgorithmFailure(failed.why);
    Positions closed = options.closed;
    closed.push_back(failed.tip);
    throw AlgorithmFailure(failed.why + closing_advice(closed));
}

/// The lines that a plan needs; the ends without one go into its options.
std::shared_ptr<const CenterlineGraph> planning_lines(const Surface& surface,
                                                      OpeningPlanOptions& options,
                                                      const Progress& progress) {
    if (options.tip) return lines_for_openings(surface, options.tip, progress);
    Positions wanted = options.open;
    wanted.insert(wanted.end(), options.inlets.begin(), options.inlets.end());
    LinesAndStubs lines = lines_to_ends(surface, wanted, progress);
    options.stubs = std::move(lines.stubs);
    return lines.graph;
}

/// Plans and cuts; where a cut fails, plans again without it.
Clipping decide(const Scene& scene, const Arguments& arguments, const Progress& progress) {
    const Surface& surface = surface_of(scene);
    OpeningPlanOptions options = plan_options(arguments, scene.image);
    const auto graph = planning_lines(surface, options, progress.part(0.0, 0.5));
    if (!options.tip) require_tube(surface, *graph);
    const bool for_flow = !options.tip && arguments.text("check") == "flow";
    const bool chosen = !options.distance && !options.radii && !options.strict;
    for (int plans = 1;; ++plans) {
        Clipping made{.plan = plan_openings(surface, *graph, options, progress.part(0.5, 0.8)),
                      .surface = {}};
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
            if (chosen) clipped.failed = wrong_cuts(surface, *graph, made);
            if (clipped.failed.empty()) return made;
        }
        if (options.strict || options.tip || plans == kMostPlans)
            give_up(clipped.failed.front(), options);
        options.failed.insert(options.failed.end(), clipped.failed.begin(), clipped.failed.end());
    }
}

/// The plan resolved by an earlier run.
OpeningPlan stored_plan(const Arguments& arguments) {
    OpeningPlan plan{.openings = openings_in(arguments.list("planes"))};
    const std::vector<Patch> patches = patches_in(arguments.text("names"));
    if (arguments.has("closings")) plan.closings = closings_in(arguments.list("closings"));
    const bool nothing = plan.openings.empty() && plan.closings.empty();
    if (nothing || patches.size() < plan.openings.size())
        throw UsageError(
            "clip-opening: planes needs 10 numbers per opening (tip, point, unit normal, 1 for a "
            "kept cap, 2 for a rim capped as it is, 3 for another name only), and names as many "
            "entries kind:name");
    for (std::size_t i = 0; i < plan.openings.size(); ++i) plan.openings[i].patch = patches[i];
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

Clipping repeat(const Surface& surface, const Arguments& arguments, const Progress& progress) {
    Clipping made{.plan = stored_plan(arguments), .surface = {}};
    const bool stubs =
        std::ranges::count(made.plan.closings, ClosingWay::RemoveStub, &PlannedClosing::way) > 0;
    const auto graph = stubs ? lines_for_openings(surface, std::nullopt, progress.part(0.0, 0.7))
                             : std::shared_ptr<const CenterlineGraph>();
    ClippedSurface clipped =
        clip_openings(surface, made.plan, {}, graph.get(), progress.part(0.7, 1.0));
    if (!clipped.failed.empty()) throw AlgorithmFailure(clipped.failed.front().why);
    made.surface = with_inlets(clipped.surface, made.plan,
                               stored_inlets(made.plan, clipped.surface, arguments));
    return made;
}

/// Adds the openings beside the plan that got another name or kind, so that the record has all that
/// was decided.
void add_renamed(OpeningPlan& plan, const Surface& before, const Surface& surface,
                 const std::vector<PatchMeasures>& patches) {
    std::vector<bool> planned(surface.patches.size(), false);
    for (const PlannedOpening& opening : plan.openings)
        if (const auto p = nearest_opening(surface, opening.place.plane.point)) planned[*p] = true;
    for (const PatchMeasures& patch : patches)
        if (patch.kind != PatchKind::Wall && !planned[patch.row] &&
            std::ranges::count(before.patches, surface.patches[patch.row]) == 0)
            plan.openings.push_back(
                {.place = {.tip = patch.centroid, .plane = {patch.centroid, patch.normal}},
                 .way = OpeningWay::Rename,
                 .patch = surface.patches[patch.row]});
}

struct Resolved {
    std::vector<double> planes;
    std::string names;
    ordered_json openings = ordered_json::array();
    std::vector<std::string> patches;  ///< of the plan's openings
};

/// Figures of an opening in the report.
ordered_json figures_of(const Surface& surface, const std::vector<PatchMeasures>& patches,
                        std::size_t row) {
    const auto patch = std::ranges::find(patches, row, &PatchMeasures::row);
    return opening_json(surface, patch == patches.end() ? PatchMeasures{} : *patch,
                        Keys::WithUnits);
}

Resolved describe(const Surface& before, const Surface& surface, OpeningPlan plan) {
    const std::vector<PatchMeasures> patches = measure_patches(surface);
    const std::size_t planned = plan.openings.size();
    add_renamed(plan, before, surface, patches);
    std::vector<Patch> made;
    Resolved resolved{.planes = planes_argument(plan.openings)};
    for (std::size_t i = 0; i < plan.openings.size(); ++i) {
        const auto& opening = plan.openings[i];
        const std::size_t p = nearest_opening(surface, opening.place.plane.point).value_or(0);
        made.push_back(surface.patches[p]);
        resolved.patches.push_back(surface.patches[p].name);
        if (i >= planned) continue;
        ordered_json figures = figures_of(surface, patches, p);
        figures["distance_from_tip_mm"] = opening.place.distance;
        figures["kept"] = opening.way != OpeningWay::Cut;
        resolved.openings.push_back(std::move(figures));
    }
    resolved.names = names_argument(made);
    return resolved;
}

std::string end_text(const EndRecord& end) {
    return (end.rim ? "the open rim at " : "the end at ") + place_text(end.place) + ", diameter " +
           formatted(end.diameter) + " mm";
}

/// How many small ends stayed closed, and how to open those that are no sacs, if they are few.
std::string small_ends_text(const std::vector<EndRecord>& small) {
    constexpr std::size_t kMostNamed = 8;
    std::vector<std::string> places;
    for (const EndRecord& end : small)
        if (end.offered && !end.sac) places.push_back(coordinates_argument(end.place));
    std::string text = counted(small.size(), "smaller end") + " stayed closed: see the report";
    if (places.empty() || places.size() > kMostNamed) return text;
    const char* before = "; open=";
    for (const std::string& place : places) {
        text += before + place;
        before = ",";
    }
    return text + " opens " + (places.size() == 1 ? "one" : std::to_string(places.size())) +
           " of them";
}

/// A cap at an image's border that is as wide as other openings: the vessel goes on behind it.
bool is_lost_at_border(const OpeningPlan& plan, const EndRecord& end) {
    return end.border && std::ranges::any_of(plan.ends, [&](const EndRecord& other) {
               return other.opening && end.diameter >= kLargeEnd * other.diameter;
           });
}

/// What a user should know about the ends, worst first. Small closed ends share a warning, except
/// the open rims among them, and vessels that an image's border cuts.
std::vector<std::string> end_warnings(const OpeningPlan& plan) {
    const double widest = widest_opening(plan);
    std::vector<std::string> warnings;
    std::vector<EndRecord> small;
    for (const EndRecord& end : plan.ends) {
        if (end.plain || end.why.empty() || end.asked) continue;
        if (end.fate == EndFate::Closed && !end.rim && !is_lost_at_border(plan, end) &&
            end.diameter < kLargeEnd * widest)
            small.push_back(end);
        else
            warnings.push_back(end_text(end) + ", was " + to_string(end.fate) + ": " + end.why);
    }
    if (!small.empty()) warnings.push_back(small_ends_text(small));
    return warnings;
}

/// Of flat ends that were kept although the vessels behind them run another way; empty if there
/// are none.
std::string tilt_warning(const Resolved& resolved) {
    constexpr double kNoticedTiltDeg = 10.0;
    std::vector<std::string> tilted;
    for (const ordered_json& opening : resolved.openings)
        if (opening["kept"] == true && opening["tilt_deg"].is_number() &&
            opening["tilt_deg"] > kNoticedTiltDeg)
            tilted.push_back(opening["name"].get<std::string>() + " by " +
                             formatted(opening["tilt_deg"], "%.0f degrees"));
    if (tilted.empty()) return "";
    const bool one = tilted.size() == 1;
    return std::string(one ? "a flat end was" : "flat ends were") +
           " kept although tilted against the vessel's axis: " + joined(tilted) +
           "; strict=true cuts " + (one ? "it" : "them") + " across";
}

/// What to say of outlets that look like inlets; empty if there are none.
std::string further_inlets(const Surface& surface) {
    const std::vector<std::size_t> likely = likely_inlets(surface);
    if (likely.empty()) return "";
    std::vector<std::string> names;
    std::string command = "inlet=";
    const auto add = [&](std::size_t patch) {
        command += command.back() == '=' ? "" : ",";
        command += to_text(Value(rounded_place(patch_shape(surface, patch).plane.point)));
    };
    for (std::size_t p = 0; p < surface.patches.size(); ++p)
        if (surface.patches[p].kind == PatchKind::Inlet) add(p);
    for (const std::size_t p : likely) {
        names.push_back(surface.patches[p].name);
        add(p);
    }
    return enumerated(names) + (names.size() == 1 ? " faces" : " face") +
           " the same way as the inlet: if blood flows in there as well, give " + command;
}

/// Standard deviation of the direction of a cut [deg]; null where none was made or measured.
ordered_json doubt_json(const OpeningPlan& plan, const EndRecord& end) {
    if (!end.opening) return nullptr;
    const PlannedOpening& opening = plan.openings[*end.opening];
    if (opening.way != OpeningWay::Cut || !opening.place.measured) return nullptr;
    return opening.place.doubt_deg;
}

ordered_json ends_json(const OpeningPlan& plan, const Resolved& resolved) {
    ordered_json list = ordered_json::array();
    for (const EndRecord& end : plan.ends)
        list.push_back(
            {{"place_mm", {end.place.x(), end.place.y(), end.place.z()}},
             {"diameter_mm", end.diameter},
             {"direction_sd_deg", doubt_json(plan, end)},
             {"fate", to_string(end.fate)},
             {"opening", end.opening ? ordered_json(resolved.patches[*end.opening]) : nullptr},
             {"why", end.why}});
    return list;
}

/// What matters if blood flows through the openings.
void add_flow_warnings(const Arguments& arguments, const Clipping& made, const Resolved& resolved,
                       Outcome& outcome) {
    const bool own_choice = !arguments.has("tip") && !arguments.has("inlet");
    for (const std::string& text :
         {tilt_warning(resolved), own_choice ? further_inlets(made.surface) : std::string()})
        if (!text.empty()) outcome.warnings.push_back(text);
}

Outcome clipped_by(const Arguments& arguments, const Scene& scene, const Progress& progress) {
    check_arguments(arguments);
    const Surface& surface = surface_of(scene);
    Clipping made = arguments.has("planes") ? repeat(surface, arguments, progress)
                                            : decide(scene, arguments, progress);
    const Resolved resolved = describe(surface, made.surface, made.plan);
    Outcome outcome;
    outcome.resolved = arguments;
    outcome.resolved.set("planes", resolved.planes);
    outcome.resolved.set("names", resolved.names);
    if (!made.plan.closings.empty())
        outcome.resolved.set("closings", closings_argument(made.plan.closings));
    ordered_json report = {{"openings", resolved.openings}};
    // Planes that are given say nothing of the other ends; the run that chose them does.
    if (!arguments.has("planes")) report["ends"] = ends_json(made.plan, resolved);
    outcome.report = std::make_shared<ordered_json>(std::move(report));
    outcome.warnings = end_warnings(made.plan);
    outcome.warnings.insert(outcome.warnings.end(), made.plan.warnings.begin(),
                            made.plan.warnings.end());
    if (arguments.text("check") == "flow") add_flow_warnings(arguments, made, resolved, outcome);
    // Ends that are cut one by one need it until the last one.
    if (!arguments.has("tip")) made.surface = without_unsmoothed(std::move(made.surface));
    outcome.scene = with_surface(scene, std::move(made.surface));
    return outcome;
}

class LiveClipping final : public ReplacingStepper {
public:
    LiveClipping(const Scene& scene, const Arguments& arguments, Progress& progress)
        : ReplacingStepper(arguments),
          before_(scene),
          made_(clipped_by(arguments, before_, progress)) {}

    [[nodiscard]] const Scene& scene() const override { return made_.scene; }

    [[nodiscard]] const Arguments& resolved() const override { return made_.resolved; }

    [[nodiscard]] Outcome outcome(Progress&) override { return made_; }

private:
    void use(const Arguments& arguments, Progress& progress) override {
        made_ = clipped_by(arguments, before_, progress);
    }

    Scene before_;
    Outcome made_;
};

/// Which end, and where it is cut.
std::vector<Parameter> place_parameters() {
    using enum ParameterType;
    return {{.name = "tip",
             .type = Point,
             .unit = "mm",
             .help = "a point near the tip of the branch to open; default: every vessel end",
             .meaning = Meaning::Tip},
            {.name = "distance",
             .unit = "mm",
             .help = "distance of the cut from the tip along the centerline; default: the nearest "
                     "straight place",
             .minimum = 0.0,
             .above_minimum = true},
            {.name = "radii",
             .unit = "-",
             .help = "the same distance in radii of the vessel at its tip",
             .minimum = 0.0,
             .above_minimum = true},
            {.name = "inlet",
             .type = List,
             .unit = "mm",
             .help = "a point near the opening where the blood flows in, or x,y,z of each of "
                     "several; default: that of the widest vessel",
             .meaning = Meaning::Inlet},
            {.name = "name",
             .type = Text,
             .help = "name of the opening at tip; default: inlet, outlet_1, outlet_2 ... by size",
             .meaning = Meaning::Name},
            {.name = "kind",
             .type = Choice,
             .help = "role of the opening at tip for the solver; default: by size",
             .choices = {"inlet", "outlet"}}};
}

/// Which ends are opened, if all of them are looked at.
std::vector<Parameter> choice_parameters() {
    using enum ParameterType;
    return {{.name = "open",
             .type = List,
             .unit = "mm",
             .help = "ends that are opened although they look closed, such as short ones: x,y,z of "
                     "each",
             .meaning = Meaning::Tip},
            {.name = "closed",
             .type = List,
             .unit = "mm",
             .help = "ends that stay closed on purpose: x,y,z of each",
             .meaning = Meaning::Tip},
            {.name = "strict",
             .type = Flag,
             .default_value = false,
             .help = "cut every end perpendicular to its vessel, also one with a flat rim; the "
                     "first end that cannot be cut is a failure"},
            {.name = "check",
             .type = Choice,
             .default_value = "flow",
             .help = "flow: fail unless there are two openings and the largest end is one of "
                     "them; none: no such check",
             .choices = {"flow", "none"}},
            {.name = "closed_ends",
             .type = Choice,
             .default_value = "open",
             .help = "open: closed ends are opened where the surface's rims are not all its ends; "
                     "leave: closed ends and the caps at an image's border stay as they are, as a "
                     "print needs no openings",
             .choices = {"open", "leave"}}};
}

/// What an earlier run decided.
std::vector<Parameter> resolved_parameters() {
    using enum ParameterType;
    return {
        {.name = "planes",
         .type = List,
         .unit = "mm",
         .help = "decisions of an earlier run, 10 numbers per opening: tip, point of the "
                 "plane, unit normal out of the vessel, 1 if a good cap was kept, 2 if a flat "
                 "rim was capped as it is, 3 if only its name changed; they are used as they are",
         .meaning = Meaning::Planes},
        {.name = "names",
         .type = Text,
         .help = "with planes: kind:name of each opening, separated by commas",
         .meaning = Meaning::Patches},
        {.name = "closings",
         .type = List,
         .unit = "mm",
         .help = "with planes: decisions of an earlier run, 4 numbers per end without an "
                 "opening: place, 0 if its rim was closed, 1 if its cap became wall, 2 if its "
                 "stub was removed",
         .meaning = Meaning::Planes}};
}

std::vector<Parameter> parameters() {
    std::vector<Parameter> all = place_parameters();
    for (Parameter& parameter : choice_parameters()) all.push_back(std::move(parameter));
    for (Parameter& parameter : resolved_parameters()) all.push_back(std::move(parameter));
    return all;
}

}  // namespace

Operation clip_opening_operation() {
    return {
        .name = "clip-opening",
        .usual_step = Step::Openings,
        .allowed = {Step::Branches, Step::LocalRepair, Step::Openings},
        .summary = "open vessel ends: cap flat rims, cut the others perpendicular to the vessel",
        .parameters = parameters(),
        .start = &started<LiveClipping>,
        .thesis = "4.2.7",
        .recipe = {.cuts_ends = true}};
}

}  // namespace vesselbench
