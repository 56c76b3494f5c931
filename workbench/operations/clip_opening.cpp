#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include <nlohmann/json.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/wording.h"
#include "geometry/vessel/openings/opening_names.h"
#include "geometry/vessel/openings/openings.h"
#include "geometry/vessel/openings/planned_cut.h"
#include "workbench/operations/shared/opening_arguments.h"
#include "workbench/operations/shared/opening_json.h"
#include "workbench/operations/shared/replacing_stepper.h"
#include "workbench/operations/table.h"

namespace vesselbench {

namespace {

using nlohmann::ordered_json;

void check_arguments(const Arguments& arguments) {
    if ((arguments.has("name") || arguments.has("kind")) && !arguments.has("tip") &&
        !arguments.has("planes"))
        throw UsageError("clip-opening: name and kind belong to one opening: give its tip, too");
    if (arguments.has("distance") && arguments.has("radii"))
        throw UsageError("clip-opening: give distance or radii, not both");
    if (arguments.has("planes") != arguments.has("names"))
        throw UsageError("clip-opening: give planes and names together");
}

OpeningPlan decide(const Surface& surface, const Arguments& arguments, const Progress& progress) {
    const OpeningPlanOptions options{.tip = arguments.optional_point("tip"),
                                     .distance = arguments.optional_real("distance"),
                                     .radii = arguments.optional_real("radii")};
    OpeningPlan plan =
        plan_openings(surface, *lines_for_openings(surface, options.tip, progress), options);
    const auto kind = arguments.optional_text("kind");
    const auto name = arguments.optional_text("name");
    if (kind || name)
        for (auto& opening : plan.openings) opening.patch = chosen_patch(opening.patch, kind, name);
    return plan;
}

/// The plan resolved by an earlier run.
OpeningPlan stored(const Arguments& arguments) {
    OpeningPlan plan{.openings = openings_in(arguments.list("planes")), .warnings = {}};
    const std::vector<Patch> patches = patches_in(arguments.text("names"));
    if (plan.openings.empty() || patches.size() < plan.openings.size())
        throw UsageError(
            "clip-opening: planes needs 10 numbers per opening (tip, point, unit normal, 1 for a "
            "kept cap), and names as many entries kind:name");
    for (std::size_t i = 0; i < plan.openings.size(); ++i) plan.openings[i].patch = patches[i];
    return plan;
}

struct Resolved {
    std::vector<double> planes;
    std::string names;
    ordered_json openings = ordered_json::array();
};

/// Figures of an opening in the report.
ordered_json figures_of(const Surface& surface, const std::vector<PatchMeasures>& patches,
                        std::size_t row) {
    const auto patch = std::ranges::find(patches, row, &PatchMeasures::row);
    return opening_json(surface, patch == patches.end() ? PatchMeasures{} : *patch,
                        Keys::WithUnits);
}

Resolved describe(const Surface& surface, const OpeningPlan& plan) {
    const std::vector<PatchMeasures> patches = measure_patches(surface);
    std::vector<Patch> made;
    Resolved resolved{.planes = planes_argument(plan.openings)};
    for (const auto& opening : plan.openings) {
        const auto& place = opening.place;
        const std::size_t p = nearest_opening(surface, place.plane.point).value_or(0);
        made.push_back(surface.patches[p]);
        ordered_json figures = figures_of(surface, patches, p);
        figures["distance_from_tip_mm"] = place.distance;
        figures["kept"] = opening.keep;
        resolved.openings.push_back(std::move(figures));
    }
    resolved.names = names_argument(made);
    return resolved;
}

/// Removes openings that were not made from the plan, with a warning.
void leave_out(OpeningPlan& plan, const std::vector<std::size_t>& left_out) {
    for (auto i = left_out.rbegin(); i != left_out.rend(); ++i) {
        const auto opening = plan.openings.begin() + static_cast<std::ptrdiff_t>(*i);
        plan.warnings.push_back("the end at " + place_text(opening->place.tip) +
                                " was left closed: a cut there would remove the ends of other "
                                "vessels, too; choose the place with tip=x,y,z distance=...");
        plan.openings.erase(opening);
    }
}

Outcome clipped_by(const Arguments& arguments, const Scene& scene, const Progress& progress) {
    check_arguments(arguments);
    const Surface& surface = surface_of(scene);
    OpeningPlan plan = arguments.has("planes")
                           ? stored(arguments)
                           : decide(surface, arguments, progress.part(0.0, 0.9));
    std::vector<std::size_t> left_out;
    Surface clipped = clip_openings(surface, plan, arguments.optional_point("inlet"), &left_out,
                                    progress.part(0.9, 1.0));
    leave_out(plan, left_out);
    const Resolved resolved = describe(clipped, plan);
    Outcome outcome;
    outcome.resolved = arguments;
    outcome.resolved.set("planes", resolved.planes);
    outcome.resolved.set("names", resolved.names);
    outcome.report = std::make_shared<ordered_json>(ordered_json{{"openings", resolved.openings}});
    outcome.warnings = plan.warnings;
    outcome.scene = with_surface(scene, std::move(clipped));
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

}  // namespace

Operation clip_opening_operation() {
    using enum ParameterType;
    return {
        .name = "clip-opening",
        .usual_step = Step::Openings,
        .allowed = {Step::Branches, Step::LocalRepair, Step::Openings},
        .summary = "cut vessel ends perpendicular to the centerline and cap them flat",
        .parameters =
            {{.name = "tip",
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
              .type = Point,
              .unit = "mm",
              .help = "a point near the opening where the blood flows in; default: the largest "
                      "opening",
              .meaning = Meaning::Inlet},
             {.name = "name",
              .type = Text,
              .help = "name of the opening at tip; default: inlet, outlet_1, outlet_2 ... by size",
              .meaning = Meaning::Name},
             {.name = "kind",
              .type = Choice,
              .help = "role of the opening at tip for the solver; default: by size",
              .choices = {"inlet", "outlet"}},
             {.name = "planes",
              .type = List,
              .unit = "mm",
              .help = "decisions of an earlier run, 10 numbers per opening: tip, point of the "
                      "plane, unit normal out of the vessel, 1 if a good cap was kept; they are "
                      "used as they are",
              .meaning = Meaning::Planes},
             {.name = "names",
              .type = Text,
              .help = "with planes: kind:name of each opening, separated by commas",
              .meaning = Meaning::Patches}},
        .start = &started<LiveClipping>,
        .thesis = "4.2.7",
        .recipe = {.cuts_ends = true}};
}

}  // namespace vesselbench
