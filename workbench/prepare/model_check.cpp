#include "workbench/prepare/model_check.h"

#include <algorithm>
#include <array>
#include <limits>
#include <memory>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/wording.h"
#include "geometry/vessel/centerlines/centerlines.h"
#include "geometry/vessel/openings/frayed_trunks.h"
#include "geometry/vessel/openings/opening_axis.h"
#include "workbench/operations/shared/opening_arguments.h"
#include "workbench/operations/table.h"

namespace vesselbench {

namespace {

/// Edges that show a vessel: so many to its diameter.
constexpr double kEdgesAcross = 4.0;

bool cuts_ends(const LogEntry& entry) {
    return find_operation(entry.edit.operation).recipe.cuts_ends;
}

/// True for an edit that takes away what its caller says.
bool takes_as_asked(const LogEntry& entry) {
    if (!cuts_ends(entry)) return find_operation(entry.edit.operation).usual_step == Step::Branches;
    return std::ranges::any_of(std::array{"distance", "radii", "planes"},
                               [&](const char* name) { return entry.edit.given.has(name); });
}

/// The variant's edits that are done or can be, in their order, up to one of them; 0: all.
std::vector<LogEntry> edits_until(const Session& session, const std::string& variant, EditId last) {
    std::vector<LogEntry> edits = session.log(variant);
    std::erase_if(edits, [](const LogEntry& entry) { return entry.status == EditStatus::Stale; });
    const auto end = std::ranges::find(edits, last, [](const auto& e) { return e.edit.edit.id; });
    if (end != edits.end()) edits.erase(end + 1, edits.end());
    return edits;
}

/// From the first edit that cuts ends on.
std::vector<LogEntry> edits_from_first_cut(const Session& session, const std::string& variant,
                                           EditId last) {
    std::vector<LogEntry> edits = edits_until(session, variant, last);
    edits.erase(edits.begin(), std::ranges::find_if(edits, cuts_ends));
    return edits;
}

/// Places that stay closed: those given to the edit, and another one.
std::string closed_argument(const LogEntry& entry, const Vec3& place) {
    std::string text;
    if (entry.edit.given.has("closed"))
        for (const double number : entry.edit.given.list("closed"))
            text += formatted(number, "%.5g") + ",";
    return text + coordinates_argument(place);
}

/// About an edit that opened an end where it should not, or lost its vessel, and what to do.
Diagnostic about_end(const LogEntry& entry, const Vec3& tip) {
    const bool by_hand = entry.edit.given.has("tip") || entry.edit.given.has("planes");
    Remedy remedy{.action = RemedyAction::Remove};
    if (!by_hand) remedy = {.arguments = {{"closed", closed_argument(entry, tip)}}};
    return {.operation = entry.edit.operation, .edit = entry.edit.edit.id, .remedies = {remedy}};
}

bool has_edge(const Operation& operation) {
    return std::ranges::count(operation.parameters, std::string("edge"), &Parameter::name) > 0;
}

/// The edit after which the vessels are missing first, and what to do about it.
Diagnostic loser_of(Session& session, const std::vector<LogEntry>& edits,
                    const BeforeOpenings& before, const CenterlineGraph& lines) {
    for (const LogEntry& entry : edits) {
        const Surface after = surface_of(session.scene_after(entry.edit.edit.id));
        std::vector<LostVessel> lost = lost_vessels(lines, after, before.asked);
        std::erase_if(lost, [](const LostVessel& vessel) { return !vessel.matters(); });
        if (lost.empty()) continue;
        if (cuts_ends(entry)) return about_end(entry, lost.front().tip);
        Remedy remedy{.action = RemedyAction::Remove};
        if (has_edge(find_operation(entry.edit.operation)))
            remedy = {
                .arguments = {{"mode", "uniform"},
                              {"edge", formatted(lost.back().diameter / kEdgesAcross, "%.2g")}}};
        return {
            .operation = entry.edit.operation, .edit = entry.edit.edit.id, .remedies = {remedy}};
    }
    return {};
}

/// The edit that made an opening, and the tip that it cut.
struct Cutter {
    LogEntry entry;
    Vec3 tip = Vec3::Zero();
};

std::optional<Cutter> cutter_of(const std::vector<LogEntry>& edits, const Vec3& opening) {
    std::optional<Cutter> found;
    double least = std::numeric_limits<double>::infinity();
    for (const LogEntry& entry : edits) {
        if (!cuts_ends(entry) || !entry.result || !entry.result->resolved.has("planes")) continue;
        for (const PlannedOpening& made : openings_in(entry.result->resolved.records("planes"))) {
            const double distance = (made.place.plane.point - opening).norm();
            if (distance >= least) continue;
            least = distance;
            found = {entry, made.place.tip};
        }
    }
    return found;
}

/// \param edits from the first one that cuts ends to the one that made `after`
/// \throw AlgorithmFailure if an opening lies in a vessel's side
void require_ends_opened(const std::vector<LogEntry>& edits, const BeforeOpenings& before,
                         const Surface& after) {
    const std::vector<std::size_t> wrong = openings_in_walls(before.surface, after);
    if (wrong.empty()) return;
    const Vec3 at = patch_shape(after, wrong.front()).plane.point;
    const auto cutter = cutter_of(edits, at);
    Diagnostic found = cutter ? about_end(cutter->entry, cutter->tip) : Diagnostic{};
    found.code = "opening-in-wall";
    found.place = at;
    found.words = {{"opening", after.patches[wrong.front()].name}};
    throw DiagnosedFailure(std::move(found));
}

/// What is missing of vessels that carry little of the flow; none: nothing.
std::optional<Diagnostic> lost_warning(const std::vector<LostVessel>& lost) {
    if (lost.empty()) return std::nullopt;
    return Diagnostic{.code = "thin-vessels-missing",
                      .place = lost.front().place,
                      .figures = {{"vessels", static_cast<double>(lost.size())},
                                  {"diameter_mm", lost.front().diameter},
                                  {"flow_percent", 100.0 * lost.front().share}}};
}

/// \throw AlgorithmFailure that lists the vessels and names the edit that lost them
[[noreturn]] void refuse_lost(Session& session, const std::vector<LogEntry>& edits,
                              const BeforeOpenings& before, const VesselCheck& check) {
    std::string text;
    for (const LostVessel& vessel : check.lost)
        if (vessel.matters())
            text += "\n  " + formatted(vessel.length, "%.1f") + " mm at " +
                    place_text(vessel.place) + ", diameter " + formatted(vessel.diameter) + " mm";
    Diagnostic found = loser_of(session, edits, before, check.lines);
    found.code = "vessels-lost";
    found.words = {{"vessels", text}};
    if (found.edit) found.words["by"] = std::to_string(*found.edit) + ", " + found.operation;
    for (const LostVessel& vessel : check.lost)
        if (vessel.matters() && !found.place) found.place = vessel.place;
    throw DiagnosedFailure(std::move(found));
}

/// The centerlines without the threads of frayed trunks, which nobody misses.
CenterlineGraph vessel_lines(const Surface& surface, const Progress& progress) {
    return without_frays(surface, *centerlines_of(surface, {}, progress)).graph;
}

}  // namespace

std::optional<BeforeOpenings> before_openings(Session& session, const std::string& variant,
                                              EditId last) {
    std::optional<BeforeOpenings> before;
    EditId previous = 0;
    for (const LogEntry& entry : edits_until(session, variant, last)) {
        const EditId id = entry.edit.edit.id;
        if (!before && cuts_ends(entry) && previous != 0)
            before = BeforeOpenings{surface_of(session.scene_after(previous)), {}};
        if (before && takes_as_asked(entry))
            before->asked.push_back(
                {surface_of(session.scene_after(previous)), surface_of(session.scene_after(id))});
        previous = id;
    }
    return before;
}

VesselCheck compared_vessels(const BeforeOpenings& before, const Surface& after,
                             const Progress& progress) {
    const auto without_lines = [](const std::exception& failure) {
        return VesselCheck{.warning = Diagnostic{.code = "vessels-not-compared",
                                                 .words = {{"reason", failure.what()}}}};
    };
    try {
        VesselCheck check{.lines = vessel_lines(before.surface, progress)};
        check.lost = lost_vessels(check.lines, after, before.asked);
        return check;
    } catch (const AlgorithmFailure& failure) {
        return without_lines(failure);
    } catch (const InvalidInput& failure) {
        return without_lines(failure);
    }
}

void ModelChecks::check_cut(const LogEntry& edit, const std::optional<BeforeOpenings>& before) {
    if (edit.result->id == cut_) return;
    const EditId id = edit.edit.edit.id;
    if (before)
        require_ends_opened(edits_from_first_cut(session_, variant_, id), *before,
                            surface_of(session_.scene_after(id)));
    cut_ = edit.result->id;
}

void ModelChecks::check_whole(const LogEntry& edit, const std::optional<BeforeOpenings>& before,
                              const Progress& progress) {
    if (edit.result->id == whole_) return;
    const EditId id = edit.edit.edit.id;
    warning_.reset();
    if (before) {
        const VesselCheck check =
            compared_vessels(*before, surface_of(session_.scene_after(id)), progress);
        if (std::ranges::any_of(check.lost, &LostVessel::matters))
            refuse_lost(session_, edits_from_first_cut(session_, variant_, id), *before, check);
        warning_ = check.warning ? check.warning : lost_warning(check.lost);
    }
    whole_ = edit.result->id;
}

void ModelChecks::after(const LogEntry& edit, const Progress& progress) {
    if (!cuts_ends(edit) || !edit.result) return;
    if (edit.result->id == cut_ && edit.result->id == whole_) return;
    const auto before = before_openings(session_, variant_, edit.edit.edit.id);
    check_cut(edit, before);
    check_whole(edit, before, progress);
}

void ModelChecks::surface_final(const Progress& progress) {
    std::vector<LogEntry> edits = edits_until(session_, variant_, 0);
    std::erase_if(edits, [](const auto& edit) { return edit.edit.place.step >= Step::Product; });
    const auto cut = std::ranges::find_if(edits.rbegin(), edits.rend(), cuts_ends);
    if (cut == edits.rend()) return;
    if (cut->result && cut->result->id != cut_)
        check_cut(*cut, before_openings(session_, variant_, cut->edit.edit.id));
    const LogEntry& last = edits.back();
    if (last.result && last.result->id != whole_)
        check_whole(last, before_openings(session_, variant_, last.edit.edit.id), progress);
}

}  // namespace vesselbench
