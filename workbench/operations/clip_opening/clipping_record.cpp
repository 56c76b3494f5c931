#include "workbench/operations/clip_opening/clipping_record.h"

#include <algorithm>
#include <array>
#include <utility>

#include <nlohmann/json.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/vessel/openings/opening_names.h"
#include "workbench/case/json_fields.h"
#include "workbench/operations/shared/opening_arguments.h"
#include "workbench/operations/shared/opening_json.h"

namespace vesselbench {

namespace {

using nlohmann::ordered_json;

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

/// Figures of an opening in the report.
ordered_json figures_of(const Surface& surface, const std::vector<PatchMeasures>& patches,
                        std::size_t row) {
    const auto patch = std::ranges::find(patches, row, &PatchMeasures::row);
    return opening_json(surface, patch == patches.end() ? PatchMeasures{} : *patch,
                        Keys::WithUnits);
}

/// Standard deviation of the direction of a cut [deg]; null where none was made or measured.
ordered_json doubt_json(const OpeningPlan& plan, const EndRecord& end) {
    if (!end.opening) return nullptr;
    const PlannedOpening& opening = plan.openings[*end.opening];
    if (opening.way != OpeningWay::Cut || !opening.place.measured) return nullptr;
    return opening.place.doubt_deg;
}

/// What was measured of an end and what it is likely to be; null where it was not judged.
ordered_json verdict_json(const EndRecord& end) {
    if (!end.verdict) return nullptr;
    const EndVerdict& v = *end.verdict;
    ordered_json features = ordered_json::object();
    const EndFeatures values = features_of(v.profile);
    for (std::size_t f = 0; f < values.size(); ++f)
        features[std::string(kEndFeatures[f])] = values[f];
    ordered_json inlet = nullptr;
    if (v.inlet) {
        inlet = {{"odds", v.inlet->odds}, {"features", ordered_json::object()}};
        for (std::size_t f = 0; f < kInletFeatures.size(); ++f)
            inlet["features"][std::string(kInletFeatures[f])] = v.inlet->features[f];
    }
    ordered_json through = ordered_json::array();
    for (const SharedVessel& vessel : v.through)
        through.push_back({{"vessel", vessel.branch}, {"diameter_mm", vessel.diameter}});
    return {{"inlet", inlet},
            {"vessel_mm", v.profile.diameter},
            {"through", std::move(through)},
            {"opening", v.odds.opening},
            {"sac", v.odds.sac},
            {"bump", v.odds.bump},
            {"doubtful", v.doubtful},
            {"features", std::move(features)}};
}

/// \throw InvalidInput if it is none of this program
ReportedOdds odds_of_report(const ordered_json& odds) {
    JsonFields fields(odds, "odds");
    return {fields.required<double>("vessel_mm"),
            {fields.required<double>("opening"), fields.required<double>("sac"),
             fields.required<double>("bump")}};
}

/// \throw InvalidInput if it is none of this program
ReportedEnd end_of_report(const ordered_json& end) {
    JsonFields fields(end, "end");
    const auto place = fields.required<std::array<double, 3>>("place_mm");
    const auto has = [&](const char* key) {
        const ordered_json* field = fields.child(key);
        return field != nullptr && !field->is_null();
    };
    ReportedEnd made{.place = Vec3(place[0], place[1], place[2]),
                     .diameter = fields.optional<double>("diameter_mm").value_or(0.0),
                     .numbered = has("number"),
                     .fate = fields.optional<std::string>("fate").value_or("")};
    if (has("opening")) made.opening = fields.required<std::string>("opening");
    if (has("odds")) made.odds = odds_of_report(end.at("odds"));
    return made;
}

}  // namespace

ordered_json ends_json(const OpeningPlan& plan, const std::vector<std::string>& names) {
    ordered_json list = ordered_json::array();
    for (const EndRecord& end : plan.ends)
        list.push_back({{"number", end.number > 0 ? ordered_json(end.number) : nullptr},
                        {"place_mm", {end.place.x(), end.place.y(), end.place.z()}},
                        {"diameter_mm", end.diameter},
                        {"flow_share", end.verdict ? ordered_json(end.share()) : nullptr},
                        {"direction_sd_deg", doubt_json(plan, end)},
                        {"fate", to_string(end.fate)},
                        {"opening", end.opening ? ordered_json(names[*end.opening]) : nullptr},
                        {"why", end.why},
                        {"odds", verdict_json(end)}});
    return list;
}

ClippingRecord record_of(const Surface& before, const Clipping& made, bool decided) {
    const Surface& surface = made.surface;
    OpeningPlan plan = made.plan;
    const std::vector<PatchMeasures> patches = measure_patches(surface);
    const std::size_t planned = plan.openings.size();
    add_renamed(plan, before, surface, patches);
    std::vector<Patch> chosen;
    std::vector<std::string> names;  // of the plan's openings
    ordered_json openings = ordered_json::array();
    for (std::size_t i = 0; i < plan.openings.size(); ++i) {
        const auto& opening = plan.openings[i];
        const std::size_t p = nearest_opening(surface, opening.place.plane.point).value_or(0);
        chosen.push_back(surface.patches[p]);
        names.push_back(surface.patches[p].name);
        if (i >= planned) continue;
        ordered_json figures = figures_of(surface, patches, p);
        figures["distance_from_tip_mm"] = opening.place.distance;
        figures["kept"] = opening.way != OpeningWay::Cut;
        openings.push_back(std::move(figures));
    }
    auto report = std::make_shared<ordered_json>();
    (*report)["openings"] = std::move(openings);
    if (decided) (*report)["ends"] = ends_json(plan, names);
    return {planes_argument(plan.openings), names_argument(chosen), std::move(report)};
}

std::vector<ReportedEnd> reported_ends(const std::string& report) {
    std::vector<ReportedEnd> ends;
    const ordered_json parsed = ordered_json::parse(report, nullptr, false);
    if (!parsed.is_object() || !parsed.contains("ends")) return ends;
    for (const ordered_json& end : parsed.at("ends")) {
        try {
            ends.push_back(end_of_report(end));
        } catch (const InvalidInput&) {  // left out
        }
    }
    return ends;
}

}  // namespace vesselbench
