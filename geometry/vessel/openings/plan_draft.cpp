#include "geometry/vessel/openings/plan_draft.h"

#include <algorithm>
#include <functional>
#include <tuple>
#include <utility>

#include "geometry/kernel/wording.h"
#include "geometry/vessel/ends/stub_lines.h"
#include "geometry/vessel/openings/end_texts.h"
#include "geometry/vessel/openings/place_warnings.h"
#include "geometry/vessel/openings/rim_shape.h"

namespace vesselbench {

namespace {

/// An end's own vessel, beyond the others, is at least this long [diameters of the end].
constexpr double kLeastOwnVessel = 0.1;
/// A blind branch without a line that is so likely a bump is no end [-].
constexpr double kMostBump = 0.5;

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

/// Where an image's border grazes a vessel that passes, none ends: its cap is long, the wall leans
/// towards it, and no vessel of its own leads to it.
bool is_grazed(const Surface& surface, const CenterlineGraph& graph, const SurfaceEnd& end) {
    const auto rim = rim_shape_of_cap(surface, *end.patch);
    if (!rim || !rim->is_graze()) return false;
    const auto blind = end.tip ? blind_branch(graph, *end.tip) : std::nullopt;
    return !end.tip || (blind && blind->length < kLeastOwnVessel * rim->diameter());
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
    }
    if (options.tip) {
        choice_.ends.resize(ends_.size());
        grazes_.assign(ends_.size(), false);
        return;
    }
    const std::vector<Stub> stubs = stubs_apart(options.stubs, lines.graph, ends_);
    choice_ = choose_ends({.surface = surface,
                           .graph = lines.graph,
                           .image = options.image,
                           .border_cuts = options.border_cuts},
                          ends_, stubs, progress);
    for (std::size_t e = 0; e < ends_.size(); ++e) {
        grazes_.push_back(records_[e].border && is_grazed(surface, lines.graph, ends_[e]));
        if (grazes_[e]) {  // no vessel ends there, however wide the cap is
            choice_.ends[e].open = choice_.ends[e].doubtful = false;
            choice_.ends[e].share = 0.0;
        }
        records_[e].verdict = choice_.ends[e];
    }
    for (std::size_t s = 0; s < stubs.size(); ++s)
        if (const EndVerdict& verdict = choice_.stubs[s];
            verdict.open || verdict.odds.bump < kMostBump)
            stubs_.push_back({.place = stubs[s].tip,
                              .diameter = verdict.profile.diameter,
                              .why = closed_text(verdict),
                              .asked = options.leave_closed,
                              .stub = true,
                              .verdict = verdict});
}

double PlanDraft::decided_share() const {
    return static_cast<double>(std::ranges::count(decided_, true)) /
           static_cast<double>(decided_.size());
}

std::vector<double> PlanDraft::courses() const {
    std::vector<double> courses;
    for (const EndVerdict& verdict : choice_.ends) courses.push_back(verdict.profile.diameter);
    return courses;
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
    for (Diagnostic& warning : place_warnings(place)) plan_.warnings.push_back(std::move(warning));
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
        plan_.openings.push_back(*made_[e]);
    }
    choose_inlets();
    plan_.ends = records_;
    add_threads();
    plan_.ends.insert(plan_.ends.end(), stubs_.begin(), stubs_.end());
    number_ends();
    const auto rank = [](const EndRecord& end) {
        return std::tuple(end.plain, end.fate, -end.diameter);
    };
    std::ranges::stable_sort(plan_.ends, {}, rank);
    return std::move(plan_);
}

/// Those that were named; else as the trunk says, unless the surface names one.
void PlanDraft::choose_inlets() {
    plan_.gathers = options_.gathers;
    if (inlets_.empty() &&
        std::ranges::count(surface_.patches, PatchKind::Inlet, &Patch::kind) == 0)
        take_trunk();
    for (const std::size_t e : inlets_)
        if (made_[e]) plan_.inlets.push_back(*records_[e].opening);
}

/// The blood enters at the trunk, or where it gathers at all other ends.
void PlanDraft::take_trunk() {
    const auto trunk = this->trunk();
    if (!trunk) return;
    std::vector<bool> opened;
    for (const auto& made : made_) opened.push_back(made.has_value());
    std::vector<bool> outlets = named_outlets();
    if (!options_.gathers || std::ranges::count(outlets, true) == 0) {
        plan_.inlet_doubtful = has_rival(choice_.ends, *trunk, opened);
        outlets.assign(made_.size(), false);
        outlets[*trunk] = true;
    }
    for (std::size_t e = 0; e < made_.size(); ++e)
        if (opened[e] && outlets[e] != options_.gathers) inlets_.push_back(e);
}

/// The likeliest; where blood gathers and it is not open, the likeliest of the others, since all
/// but one have to be inlets.
std::optional<std::size_t> PlanDraft::trunk() const {
    if (choice_.inlet && made_[*choice_.inlet]) return choice_.inlet;
    std::optional<std::size_t> found;
    for (std::size_t e = 0; options_.gathers && e < made_.size(); ++e) {
        const auto& inlet = choice_.ends[e].inlet;
        if (made_[e] && inlet && (!found || inlet->odds > choice_.ends[*found].inlet->odds))
            found = e;
    }
    return found;
}

/// By end: those that the surface's patches name; none, if that would leave no inlet.
std::vector<bool> PlanDraft::named_outlets() const {
    std::vector<bool> outlets;
    bool inlet_left = false;
    for (const auto& made : made_) {
        outlets.push_back(made && made->patch && made->patch->kind == PatchKind::Outlet);
        inlet_left = inlet_left || (made && !outlets.back());
    }
    if (!inlet_left) outlets.assign(outlets.size(), false);
    return outlets;
}

void PlanDraft::number_ends() {
    std::vector<EndRecord*> judged;
    for (EndRecord& end : plan_.ends)
        if (end.verdict) judged.push_back(&end);
    std::ranges::stable_sort(judged, std::greater{}, [](const EndRecord* end) {
        return std::pair(end->verdict->share, end->verdict->profile.diameter);
    });
    int number = 0;
    for (EndRecord* end : judged) end->number = ++number;
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
                 .why = "a strand of the lumen that splits at " + place_text(ends_[e].centre),
                 .shared = true,
                 .plain = true});
    }
}

}  // namespace vesselbench
