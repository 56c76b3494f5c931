#include "workbench/operations/shared/opening_arguments.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace vesselbench {

namespace {

constexpr double kUnitLength = 1e-6;  ///< a normal's length differs from 1 by less

/// Of OpeningWay and of ClosingWay, in the order of their values, which flat lists contain.
const std::vector<std::string> kOpeningWays = {"cut", "keep", "cap", "rename"};
const std::vector<std::string> kClosingWays = {"fill", "wall", "remove"};

template <class Way>
Way way_in(const Arguments& record, const std::vector<std::string>& ways) {
    return static_cast<Way>(std::ranges::find(ways, record.text("way")) - ways.begin());
}

template <class Way>
const std::string& name_of(Way way, const std::vector<std::string>& ways) {
    return ways.at(static_cast<std::size_t>(way));
}

Parameter place_field(const std::string& name, const std::string& help) {
    return {
        .name = name, .type = ParameterType::Point, .unit = "mm", .help = help, .required = true};
}

Parameter choice_field(const std::string& name, const std::string& help,
                       const std::vector<std::string>& choices) {
    return {.name = name,
            .type = ParameterType::Choice,
            .help = help,
            .choices = choices,
            .required = true};
}

bool is_unit(const Vec3& normal) {
    return std::abs(normal.norm() - 1.0) <= kUnitLength;
}

}  // namespace

std::vector<Parameter> plane_fields() {
    return {place_field("tip", "of the vessel's end"),
            place_field("point", "of the plane"),
            {.name = "normal",
             .type = ParameterType::Point,
             .unit = "-",
             .help = "unit normal of the plane, out of the vessel",
             .required = true},
            choice_field("way",
                         "cut: the vessel is cut and capped; keep: a good cap is kept; cap: a flat "
                         "rim is capped as it is; rename: only its name changes",
                         kOpeningWays)};
}

std::vector<Parameter> name_fields() {
    return {choice_field("kind", "role of the opening",
                         {to_string(PatchKind::Inlet), to_string(PatchKind::Outlet),
                          to_string(PatchKind::Cut), to_string(PatchKind::Wall)}),
            {.name = "name",
             .type = ParameterType::Text,
             .help = "of the opening",
             .required = true,
             .meaning = Meaning::Name}};
}

std::vector<Parameter> closing_fields() {
    return {place_field("place", "centre of the rim or the cap, or tip of the branch"),
            choice_field("way",
                         "fill: its rim is closed as wall; wall: its cap becomes wall; remove: its "
                         "stub is removed",
                         kClosingWays)};
}

Records planes_argument(std::span<const PlannedOpening> openings) {
    std::vector<Arguments> records;
    for (const auto& [place, way, patch] : openings)
        records.push_back({{"tip", place.tip},
                           {"point", place.plane.point},
                           {"normal", place.plane.normal},
                           {"way", name_of(way, kOpeningWays)}});
    return Records(std::move(records));
}

std::vector<PlannedOpening> openings_in(const Records& planes) {
    std::vector<PlannedOpening> openings;
    for (const Arguments& record : planes.list()) {
        const Plane plane{record.point("point"), record.point("normal")};
        if (!is_unit(plane.normal)) return {};
        openings.push_back({.place = {.tip = record.point("tip"), .plane = plane},
                            .way = way_in<OpeningWay>(record, kOpeningWays),
                            .patch = std::nullopt});
    }
    return openings;
}

Records names_argument(std::span<const Patch> patches) {
    std::vector<Arguments> records;
    for (const Patch& patch : patches)
        records.push_back({{"kind", to_string(patch.kind)}, {"name", patch.name}});
    return Records(std::move(records));
}

std::vector<Patch> patches_in(const Records& names) {
    std::vector<Patch> patches;
    for (const Arguments& record : names.list())
        patches.push_back({record.text("name"), patch_kind_from(record.text("kind"))});
    return patches;
}

Records closings_argument(std::span<const PlannedClosing> closings) {
    std::vector<Arguments> records;
    for (const auto& [place, way] : closings)
        records.push_back({{"place", place}, {"way", name_of(way, kClosingWays)}});
    return Records(std::move(records));
}

std::vector<PlannedClosing> closings_in(const Records& closings) {
    std::vector<PlannedClosing> found;
    for (const Arguments& record : closings.list())
        found.push_back({record.point("place"), way_in<ClosingWay>(record, kClosingWays)});
    return found;
}

std::vector<EndRecord> ends_of(const OpeningPlan& plan) {
    std::vector<EndRecord> ends;
    for (const PlannedClosing& closing : plan.closings)
        ends.push_back(
            {.place = closing.place,
             .fate = closing.way == ClosingWay::RemoveStub ? EndFate::Removed : EndFate::Closed});
    for (std::size_t i = 0; i < plan.openings.size(); ++i) {
        const PlannedOpening& opening = plan.openings[i];
        ends.push_back({.place = opening.place.tip,
                        .diameter = opening.place.diameter,
                        .fate = opening.way == OpeningWay::Cut ? EndFate::Opened : EndFate::Kept,
                        .opening = i});
    }
    return ends;
}

Patch chosen_patch(const std::optional<Patch>& present, const std::optional<std::string>& kind,
                   const std::optional<std::string>& name) {
    Patch patch = present.value_or(Patch{"", PatchKind::Outlet});
    if (kind) patch.kind = patch_kind_from(*kind);
    if (name || patch.name.empty()) patch.name = name.value_or(to_string(patch.kind));
    return patch;
}

}  // namespace vesselbench
