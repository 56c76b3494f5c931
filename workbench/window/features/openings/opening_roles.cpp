#include "workbench/window/features/openings/opening_roles.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>

#include "geometry/kernel/wording.h"
#include "geometry/vessel/openings/opening_names.h"
#include "workbench/case/argument_texts.h"
#include "workbench/operations/clip_opening/parameters.h"
#include "workbench/operations/shared/opening_arguments.h"
#include "workbench/operations/table.h"
#include "workbench/prepare/decided_ends.h"
#include "workbench/window/case/rail.h"

namespace vesselbench {

namespace {

/// An opening whose middle is farther from a cut's axis was not made there [radii].
constexpr double kOnAxis = 1.0;

/// A decision farther away is of another end [diameters].
constexpr double kSameRow = 1.0;

/// Infinite behind the plane, where the vessel was: the other end of a straight vessel is there.
double distance_to_axis(const Plane& plane, const Vec3& point, double behind) {
    const Vec3 way = point - plane.point;
    const double along = way.dot(plane.normal);
    return along < -behind ? std::numeric_limits<double>::infinity()
                           : (way - along * plane.normal).norm();
}

/// The openings of an edit that opened all ends; empty: it is none.
std::vector<PlannedOpening> openings_of(const Snapshot& now, const EditRecord& edit) {
    const Operation* operation = known_operation(edit.operation);
    if (operation == nullptr || !operation->recipe.cuts_ends || edit.given.has("tip")) return {};
    const auto past = now.past->find(edit.edit);
    if (past == now.past->end() || !past->second.result) return {};
    const Arguments& ran = past->second.result->resolved;
    return ran.has("planes") ? openings_in(ran.records("planes")) : std::vector<PlannedOpening>();
}

}  // namespace

std::vector<FieldText> role_texts(const PatchMeasures& opening, PatchKind role,
                                  const std::vector<Patch>& patches) {
    const std::string at = to_text(Value(rounded_place(opening.centroid)));
    const bool inlet = role == PatchKind::Inlet;
    const bool renamed = !inlet && opening.kind != PatchKind::Outlet;
    return {{"tip", at},
            {"distance", ""},
            {"radii", ""},
            {"planes", ""},
            {"names", ""},
            {"inlet", inlet ? at : ""},
            {"kind", inlet ? "" : to_string(role)},
            {"name", inlet     ? ""
                     : renamed ? free_patch_name("outlet", 1, patches)
                               : opening.name}};
}

std::optional<MadeOpening> made_opening(const Snapshot& now, const std::string& variant,
                                        const PatchMeasures& opening) {
    std::optional<MadeOpening> made;
    for (const LogEntry& entry : now.log) {
        if (!is_part_of(entry.edit.place, variant)) continue;
        const std::vector<PlannedOpening> openings = openings_of(now, entry.edit);
        const double reach = kOnAxis * std::sqrt(opening.area / std::numbers::pi);
        double least = reach;
        if (!openings.empty()) made.reset();
        for (const PlannedOpening& each : openings) {
            const double distance = distance_to_axis(each.place.plane, opening.centroid, reach);
            if (distance > least) continue;
            least = distance;
            made = MadeOpening{entry.edit.edit.id, each.place.tip};
        }
    }
    return made;
}

std::vector<FieldText> found_texts(const Snapshot& now, EditId edit) {
    const LogEntry* entry = find_entry(now, edit);
    if (entry == nullptr) return {};
    const auto past = now.past->find(entry->edit.edit);
    if (past == now.past->end() || !past->second.first) return {};
    const Arguments given = entry->edit.given,
                    found = with_found_places(given, past->second.first->resolved);
    std::vector<FieldText> texts;
    for (const NumberParameter& parameter : kNumberParameters) {
        if (given.has(parameter.numbers) == found.has(parameter.numbers)) continue;
        texts.push_back({parameter.places, to_text(Value(found.list(parameter.places)))});
        texts.push_back({parameter.numbers, ""});
    }
    return texts;
}

std::vector<std::pair<int, EndWish>> former_wishes(const std::vector<EndRow>& rows,
                                                   const Snapshot& now, EditId edit) {
    std::vector<std::pair<int, EndWish>> wishes;
    for (const DecidedEnd& end : decided_ends(now)) {
        if (end.edit.id != edit || rows.empty()) continue;
        const EndRow& row = *std::ranges::min_element(
            rows, {}, [&](const EndRow& r) { return (r.place - end.place).norm(); });
        const bool open = end.role != EndRole::Closed;
        const bool same = row.is_open() == open && !row.doubtful;
        if (!same && (row.place - end.place).norm() < kSameRow * row.diameter)
            wishes.emplace_back(row.number, open ? EndWish::Outlet : EndWish::Closed);
    }
    return wishes;
}

std::string with_name_switched(const std::string& list, const std::string& name) {
    std::vector<std::string> names;
    std::istringstream stream(list);
    for (std::string each; std::getline(stream, each, ',');) names.push_back(each);
    if (std::erase(names, name) == 0) names.push_back(name);
    return joined(names, ",");
}

}  // namespace vesselbench
