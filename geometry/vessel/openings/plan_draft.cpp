#include "geometry/vessel/openings/plan_draft.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "geometry/kernel/wording.h"
#include "geometry/vessel/openings/place_warnings.h"
#include "geometry/vessel/openings/unlined_ends.h"

namespace vesselbench {

namespace {

/// A rim or cap this wide beside the widest other end is an end, whatever it looks like [-].
constexpr double kAsWide = 0.8;
/// An end's own vessel, beyond the others, is at least this long [diameters of the end].
constexpr double kLeastOwnVessel = 0.1;

/// A torn rim is longer than it is wide; a hole in a vessel's side is narrower than the vessel.
EndRecord record_of(const SurfaceEnd& end, const Surface& surface, bool border_cuts) {
    if (end.rim.empty())
        return {.place = end.centre,
                .diameter = end.diameter,
                .border =
                    border_cuts && end.patch && surface.patches[*end.patch].kind == PatchKind::Cut};
    const double width = rim_shape(surface, end.rim).diameter();
    return {.place = end.centre,
            .diameter = end.tip ? std::min(end.diameter, width) : width,
            .rim = true};
}

EndRecord record_of(const UnlinedEnd& end, bool asked) {
    return {.place = end.place,
            .diameter = end.diameter,
            .why = std::string(end.sac ? "it looks like an aneurysm, and is" : "it is") +
                   " too short for a centerline, " + formatted(end.length) +
                   " mm beyond the vessels around; open=" + coordinates_argument(end.place) +
                   " opens it",
            .sac = end.sac,
            .asked = asked,
            .offered = true,
            .unlined = true,
            .rest_of = end.rest_of};
}

/// A rim, or an image's border, where no vessel ends: the vessel passes it. A cap that has a
/// name was meant by whoever gave it, as was a surface's own rim or cap that is as wide as the
/// widest other end: a trunk cut close to its furcation looks as if the vessel passed.
bool lies_in_side(const PlanDraft& draft, std::size_t e) {
    const Surface& surface = draft.surface();
    const SurfaceEnd& end = draft.ends()[e];
    if (end.patch ? surface.patches[*end.patch].kind != PatchKind::Cut : end.rim.empty())
        return false;
    const auto rim = end.patch ? rim_shape_of_cap(surface, *end.patch)
                               : std::optional(rim_shape(surface, end.rim));
    if (!rim || !rim->is_graze()) return false;
    if (!draft.options().border_cuts && rim->diameter() > kAsWide * draft.widest_beside(e))
        return false;
    if (!end.tip) return true;
    const auto blind = blind_branch(draft.graph(), *end.tip);
    return blind && blind->length < kLeastOwnVessel * rim->diameter();
}

}  // namespace

PlanDraft::PlanDraft(const Surface& surface, const LinesWithoutFrays& lines,
                     const OpeningPlanOptions& options, const Progress& progress)
    : surface_(surface),
      lines_(lines),
      options_(options),
      ends_(find_surface_ends(surface, lines.graph)),
      made_(ends_.size()),
      records_(ends_.size()),
      decided_(ends_.size(), false) {
    for (std::size_t e = 0; e < ends_.size(); ++e) {
        progress.check_cancelled();
        records_[e] = record_of(ends_[e], surface, options.border_cuts);
        in_side_.push_back(lies_in_side(*this, e));
    }
    if (options.tip) return;
    for (const UnlinedEnd& end : unlined_ends(surface, lines.graph, options.stubs, ends_))
        unlined_.push_back(record_of(end, options.leave_closed));
}

double PlanDraft::decided_share() const {
    return static_cast<double>(std::ranges::count(decided_, true)) /
           static_cast<double>(decided_.size());
}

bool PlanDraft::stays_side(std::size_t e) const {
    return in_side_[e] && (options_.border_cuts || !is_wanted(e));
}

const FrayedTrunk* PlanDraft::frays(std::size_t e) const {
    const auto& tip = ends_[e].tip;
    const auto found = std::ranges::find_if(
        lines_.trunks, [&](const FrayedTrunk& trunk) { return tip && trunk.tip == *tip; });
    return found == lines_.trunks.end() ? nullptr : &*found;
}

Vec3 PlanDraft::tip_place(std::size_t e) const {
    const SurfaceEnd& end = ends_[e];
    return end.tip ? graph().nodes[*end.tip].position : end.centre;
}

double PlanDraft::widest_beside(std::size_t e) const {
    double widest = 0.0;
    for (std::size_t other = 0; other < ends_.size(); ++other)
        if (other != e) widest = std::max(widest, ends_[other].diameter);
    return widest;
}

bool PlanDraft::is_inlet(std::size_t e) const {
    return std::ranges::count(inlets_, e) > 0;
}

bool PlanDraft::is_wanted(std::size_t e) const {
    return is_inlet(e) || std::ranges::count(wanted_, e) > 0;
}

void PlanDraft::open(std::size_t e, const OpeningPlace& place, OpeningWay way,
                     const std::string& why) {
    PlannedOpening opening{.place = place, .way = way, .patch = std::nullopt};
    const auto& patch = ends_[e].patch;
    if (patch && surface_.patches[*patch].kind != PatchKind::Cut)
        opening.patch = surface_.patches[*patch];
    made_[e] = opening;
    decided_[e] = true;
    records_[e].fate = way == OpeningWay::Cut ? EndFate::Opened : EndFate::Kept;
    records_[e].why = why;
    if (way != OpeningWay::Cut) return;
    for (std::string& warning : place_warnings(place)) plan_.warnings.push_back(std::move(warning));
}

void PlanDraft::close(std::size_t e, const std::string& why) {
    decided_[e] = true;
    records_[e].fate = EndFate::Closed;
    records_[e].why = why;
    const SurfaceEnd& end = ends_[e];
    if (end.is_visible())
        plan_.closings.push_back(
            {end.centre, end.patch ? ClosingWay::WallCap : ClosingWay::FillRim});
}

void PlanDraft::close_offering(std::size_t e, const std::string& why) {
    records_[e].offered = true;
    close(e, why + "; open=" + coordinates_argument(ends_[e].centre) + " opens it");
}

void PlanDraft::remove_stub(std::size_t e) {
    decided_[e] = true;
    records_[e].fate = EndFate::Removed;
    records_[e].why = "a stub shorter than its parent is wide: " + records_[e].why;
    plan_.closings.push_back({graph().nodes[*ends_[e].tip].position, ClosingWay::RemoveStub});
}

void PlanDraft::take_along(std::size_t e, std::size_t cut) {
    if (decided_[e]) return;
    decided_[e] = true;
    records_[e].fate = EndFate::Removed;
    records_[e].shared = true;
    records_[e].why = "part of the end at " + place_text(ends_[cut].centre) + ", which was cut off";
}

void PlanDraft::keep_only(std::size_t e) {
    records_ = {records_[e]};
    made_ = {made_[e]};
}

OpeningPlan PlanDraft::finished() {
    for (std::size_t e = 0; e < made_.size(); ++e) {
        if (!made_[e]) continue;
        records_[e].opening = plan_.openings.size();
        if (is_inlet(e)) plan_.inlets.push_back(plan_.openings.size());
        plan_.openings.push_back(*made_[e]);
    }
    plan_.ends = records_;
    add_threads();
    plan_.ends.insert(plan_.ends.end(), unlined_.begin(), unlined_.end());
    const auto rank = [](const EndRecord& end) {
        return std::tuple(end.plain, end.fate, -end.diameter);
    };
    std::ranges::stable_sort(plan_.ends, {}, rank);
    return std::move(plan_);
}

/// The report has every end found.
void PlanDraft::add_threads() {
    for (std::size_t e = 0; e < ends_.size(); ++e) {
        if (!frays(e)) continue;
        for (const ThinEnd& thread : frays(e)->ends)
            plan_.ends.push_back(
                {.place = thread.place,
                 .diameter = thread.diameter,
                 .fate = made_[e] ? EndFate::Removed : EndFate::Closed,
                 .why = "a thread of the vessel that frays at " + place_text(ends_[e].centre),
                 .shared = true,
                 .plain = true});
    }
}

}  // namespace vesselbench
