#include <utility>

#include <nlohmann/json.hpp>

#include "geometry/kernel/unsmoothed.h"
#include "workbench/operations/clip_opening/clipping.h"
#include "workbench/operations/clip_opening/clipping_record.h"
#include "workbench/operations/clip_opening/clipping_warnings.h"
#include "workbench/operations/clip_opening/parameters.h"
#include "workbench/operations/shared/opening_arguments.h"
#include "workbench/operations/shared/replacing_stepper.h"
#include "workbench/operations/shared/stated_changes.h"
#include "workbench/operations/table.h"

namespace vesselbench {

namespace {

using nlohmann::ordered_json;

/// What matters if blood flows through the openings.
void add_flow_warnings(const Arguments& arguments, const Clipping& made,
                       const ordered_json& openings, Outcome& outcome) {
    const bool own_choice = !arguments.has("tip") && !arguments.has("inlet");
    const bool further = own_choice && !gathers(arguments);
    const bool portal = own_choice && arguments.optional_text("vessel") == kPortalVein;
    for (const auto& warning :
         {tilt_warning(openings), further ? further_inlets(made.surface) : std::nullopt,
          portal ? std::optional(portal_inlet(made.surface)) : std::nullopt})
        if (warning) outcome.warnings.push_back(*warning);
}

/// Replays do not depend on the numbers of ends.
void store_places(const Arguments& given, const OpeningPlanOptions& used, Arguments& resolved) {
    for (const NumberParameter& parameter : kNumberParameters) {
        if (!given.has(parameter.numbers)) continue;
        std::vector<double> places;
        for (const Vec3& place : used.*parameter.into)
            places.insert(places.end(), {place.x(), place.y(), place.z()});
        resolved.set(parameter.places, places);
        resolved.remove(parameter.numbers);
    }
}

Outcome clipped_by(const Arguments& arguments, const Scene& scene, const Progress& progress) {
    check_clip_arguments(arguments);
    const Surface& surface = surface_of(scene);
    Clipping made = arguments.has("planes") ? repeat_openings(surface, arguments, progress)
                                            : decide_openings(scene, arguments, progress);
    const ClippingRecord record = record_of(surface, made, !arguments.has("planes"));
    Outcome outcome;
    outcome.resolved = arguments;
    store_places(arguments, made.options, outcome.resolved);
    outcome.resolved.set("planes", record.planes);
    outcome.resolved.set("names", record.names);
    if (!made.plan.closings.empty())
        outcome.resolved.set("closings", closings_argument(made.plan.closings));
    outcome.report = record.report;
    outcome.warnings = end_warnings(made.plan);
    outcome.warnings.insert(outcome.warnings.end(), made.plan.warnings.begin(),
                            made.plan.warnings.end());
    if (arguments.text("check") == "flow")
        add_flow_warnings(arguments, made, (*record.report)["openings"], outcome);
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

/// The ends that its own record names are cut off, and loops of vessels perhaps, but no vessel.
StatedChange cut_ends(const Scene& before, const Outcome& outcome) {
    StatedChange stated{.parts = kAnyGain, .handles = kAnyLoss, .rims = kAnyGrowth};
    add_kept_wall(stated, before, outcome);
    for (const PlannedOpening& opening : openings_in(outcome.resolved.records("planes")))
        stated.named.push_back({opening.place.tip, opening.place.plane});
    if (!outcome.resolved.has("closings")) return stated;
    for (const PlannedClosing& closing : closings_in(outcome.resolved.records("closings")))
        if (closing.way == ClosingWay::RemoveStub) stated.named.push_back({closing.place});
    return stated;
}

}  // namespace

Operation clip_opening_operation() {
    return {
        .name = "clip-opening",
        .usual_step = Step::Openings,
        .allowed = {Step::Branches, Step::LocalRepair, Step::Openings},
        .summary = "open vessel ends: cap flat rims, cut the others perpendicular to the vessel",
        .parameters = clip_opening_parameters(),
        .start = &started<LiveClipping>,
        .may_change = &cut_ends,
        .thesis = "4.2.7",
        .recipe = {.cuts_ends = true},
        .example = {
            .scene = ExampleScene::Branches, .placed = {"tip"}, .changed = {{"radii", 4.0}}}};
}

}  // namespace vesselbench
