#include <algorithm>
#include <memory>
#include <optional>
#include <sstream>
#include <utility>

#include <nlohmann/json.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/wording.h"
#include "geometry/vessel/centerlines/branch_queries.h"
#include "geometry/vessel/centerlines/centerlines.h"
#include "geometry/vessel/openings/opening_names.h"
#include "geometry/vessel/openings/openings.h"
#include "workbench/operations/shared/opening_json.h"
#include "workbench/operations/shared/replacing_stepper.h"
#include "workbench/operations/table.h"

namespace vesselbench {

namespace {

using nlohmann::ordered_json;

/// Numbers of one opening in `planes`: tip, point, normal, 1 if a cap is kept.
constexpr std::size_t kNumbers = 10;

void check_arguments(const Arguments& arguments) {
    if ((arguments.has("name") || arguments.has("kind")) && !arguments.has("tip") &&
        !arguments.has("planes"))
        throw UsageError("clip-opening: name and kind belong to one opening: give its tip, too");
    if (arguments.has("distance") && arguments.has("radii"))
        throw UsageError("clip-opening: give distance or radii, not both");
    if (arguments.has("planes") != arguments.has("names"))
        throw UsageError("clip-opening: give planes and names together");
}

/// The centerlines of all vessel ends; if none of them is at the tip, those to the tip.
std::shared_ptr<const CenterlineGraph> lines_with_tip(const Surface& surface,
                                                      const std::optional<Vec3>& tip,
                                                      const Progress& progress) {
    auto lines = centerlines_of(surface, {}, progress.part(0.0, 0.7));
    if (!tip) return lines;
    const auto nearest = nearest_tip(*lines, *tip);
    if (nearest &&
        (lines->nodes[*nearest].position - *tip).norm() <= 2.0 * tip_radius(*lines, *nearest))
        return lines;
    // A stub or a sac that the automatic search leaves out.
    return centerlines_of(surface, {.ends = {*tip}}, progress.part(0.7, 0.9));
}

OpeningPlan decide(const Surface& surface, const Arguments& arguments, const Progress& progress) {
    const OpeningPlanOptions options{.tip = arguments.optional_point("tip"),
                                     .distance = arguments.optional_real("distance"),
                                     .radii = arguments.optional_real("radii")};
    OpeningPlan plan =
        plan_openings(surface, *lines_with_tip(surface, options.tip, progress), options);
    const auto kind = arguments.optional_text("kind");
    const auto name = arguments.optional_text("name");
    if (kind || name)
        for (auto& opening : plan.openings) {
            if (!opening.patch) opening.patch = Patch{"", PatchKind::Outlet};
            if (kind) opening.patch->kind = patch_kind_from(*kind);
            if (name || opening.patch->name.empty())
                opening.patch->name = name.value_or(to_string(opening.patch->kind));
        }
    return plan;
}

/// The plan resolved by an earlier run.
OpeningPlan stored(const Arguments& arguments) {
    const auto& numbers = arguments.list("planes");
    std::istringstream names(arguments.text("names"));
    OpeningPlan plan;
    for (std::size_t i = 0; i + kNumbers <= numbers.size(); i += kNumbers) {
        const auto at = [&](std::size_t k) { return Eigen::Map<const Vec3>(&numbers[i + k]); };
        PlannedOpening opening{.place = {.tip = at(0), .plane = {at(3), at(6)}},
                               .keep = numbers[i + 9] != 0.0,
                               .patch = std::nullopt};
        std::string entry;
        const bool given = static_cast<bool>(std::getline(names, entry, ','));
        const auto colon = entry.find(':');
        if (!given || colon == std::string::npos || std::abs(at(6).norm() - 1.0) > 1e-6) break;
        opening.patch = Patch{entry.substr(colon + 1), patch_kind_from(entry.substr(0, colon))};
        plan.openings.push_back(std::move(opening));
    }
    if (plan.openings.empty() || plan.openings.size() * kNumbers != numbers.size())
        throw UsageError(
            "clip-opening: planes needs 10 numbers per opening (tip, point, unit normal, 1 for a "
            "kept cap), and names as many entries kind:name");
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
    Resolved resolved;
    for (const auto& opening : plan.openings) {
        const auto& place = opening.place;
        const std::size_t p = nearest_opening(surface, place.plane.point).value_or(0);
        const Patch& patch = surface.patches[p];
        for (const Vec3& v : {place.tip, place.plane.point, place.plane.normal})
            resolved.planes.insert(resolved.planes.end(), {v.x(), v.y(), v.z()});
        resolved.planes.push_back(opening.keep ? 1.0 : 0.0);
        resolved.names +=
            (resolved.names.empty() ? "" : ",") + to_string(patch.kind) + ":" + patch.name;
        ordered_json figures = figures_of(surface, patches, p);
        figures["distance_from_tip_mm"] = place.distance;
        figures["kept"] = opening.keep;
        resolved.openings.push_back(std::move(figures));
    }
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
    OpeningPlan plan =
        arguments.has("planes") ? stored(arguments) : decide(surface, arguments, progress);
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
              .help = "a point near the tip of the branch to open; default: every vessel end"},
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
                      "opening"},
             {.name = "name",
              .type = Text,
              .help = "name of the opening at tip; default: inlet, outlet_1, outlet_2 ... by size"},
             {.name = "kind",
              .type = Choice,
              .help = "role of the opening at tip for the solver; default: by size",
              .choices = {"inlet", "outlet"}},
             {.name = "planes",
              .type = List,
              .unit = "mm",
              .help = "decisions of an earlier run, 10 numbers per opening: tip, point of the "
                      "plane, unit normal out of the vessel, 1 if a good cap was kept; they are "
                      "used as they are"},
             {.name = "names",
              .type = Text,
              .help = "with planes: kind:name of each opening, separated by commas"}},
        .start = &started<LiveClipping>,
        .thesis = "4.2.7",
        .recipe = {.cuts_ends = true}};
}

}  // namespace vesselbench
