#include "geometry/vessel/openings/blind_ends.h"

#include <algorithm>

#include "geometry/kernel/wording.h"

namespace vesselbench {

namespace {

/// A shorter branch may be a bump of the wall [radii].
constexpr double kLeastProtrusion = 1.0 / 3.0;

/// As long as it is wide, and wider than every visible end: it is where the blood enters, and
/// the image, or its mask, ends there. Its tip is rounded, so its width is the branch's.
bool is_widest_trunk(const PlanDraft& draft, std::size_t e, const BlindBranch& blind) {
    const double width = std::max(draft.ends()[e].diameter, 2.0 * blind.widest);
    const bool widest = std::ranges::none_of(draft.ends(), [&](const SurfaceEnd& other) {
        return other.is_visible() && kAsLarge * other.diameter >= width;
    });
    return widest && blind.length >= 2.0 * blind.widest;
}

/// True if a blind branch too long for a sac or a knob is among the ends.
bool has_rounded_end(const PlanDraft& draft) {
    return std::ranges::any_of(draft.ends(), [&](const SurfaceEnd& end) {
        if (end.is_visible() || !end.tip) return false;
        const auto blind = blind_branch(draft.graph(), *end.tip);
        return blind && !blind->is_short() && !blind->bulges;
    });
}

/// \param facing the end that it faces, if any (facing_ends)
std::string doubt_about(const PlanDraft& draft, std::size_t e,
                        const std::optional<std::size_t>& facing) {
    const std::size_t tip = *draft.ends()[e].tip;
    if (facing)
        return "the vessel is broken there: it faces the end at " +
               place_text(draft.ends()[*facing].centre);
    const auto blind = blind_branch(draft.graph(), tip);
    if (blind && blind->length < kLeastProtrusion * blind->widest)
        return "it protrudes by " + formatted(blind->length) + " mm only from the vessels around";
    if (!draft.options().voxels) return "";
    const VoxelWidth width = width_at_tip(draft.graph(), tip, *draft.options().voxels);
    if (!width.is_fading()) return "";
    return "it fades from the image there: " + formatted(width.diameter) +
           " mm wide, between voxels " + formatted(width.voxels) + " mm apart";
}

}  // namespace

bool opens_blind_ends(const PlanDraft& draft) {
    bool determined = false;
    int found = 0;
    for (std::size_t e = 0; e < draft.ends().size(); ++e) {
        const SurfaceEnd& end = draft.ends()[e];
        const bool named = end.patch && draft.surface().patches[*end.patch].kind != PatchKind::Cut;
        if (named || (!end.rim.empty() && !draft.in_side(e))) determined = true;
        if (end.is_visible() && !draft.in_side(e) && (end.tip || draft.is_open(e))) ++found;
    }
    return !determined || found < 2;
}

std::vector<std::string> doubts_about_ends(const PlanDraft& draft) {
    const std::vector<SurfaceEnd>& ends = draft.ends();
    std::vector<std::string> doubts(ends.size());
    if (draft.options().strict) return doubts;
    const auto facing = facing_ends(ends, draft.graph());
    for (std::size_t e = 0; e < ends.size(); ++e)
        if (!ends[e].is_visible() && !draft.is_wanted(e) && !draft.frays(e))
            doubts[e] = doubt_about(draft, e, facing[e]);
    return doubts;
}

bool is_spare(const PlanDraft& draft, std::size_t e) {
    int open = 0;
    double widest = 0.0;
    for (std::size_t other = 0; other < draft.ends().size(); ++other) {
        if (!draft.is_open(other)) continue;
        ++open;
        widest = std::max(widest, draft.ends()[other].diameter);
    }
    return open >= 2 && widest >= draft.ends()[e].diameter;
}

bool is_wider_than_all(const PlanDraft& draft, std::size_t e) {
    const std::vector<SurfaceEnd>& ends = draft.ends();
    for (std::size_t other = 0; other < ends.size(); ++other)
        if (ends[other].is_visible() && draft.is_open(other) &&
            ends[other].diameter >= ends[e].diameter)
            return false;
    const auto blind = blind_branch(draft.graph(), *ends[e].tip);
    return !draft.options().strict && blind && !blind->bulges &&
           (draft.frays(e) || !blind->is_short() || is_widest_trunk(draft, e, *blind));
}

std::optional<ClosedLook> looks_closed(const PlanDraft& draft, std::size_t e) {
    const std::size_t tip = *draft.ends()[e].tip;
    const auto blind = blind_branch(draft.graph(), tip);
    if (!blind || !blind->is_short()) return std::nullopt;
    const bool sac = blind->bulges || is_ball(draft.surface(), draft.graph(), tip);
    const auto visible = std::ranges::count_if(draft.ends(), &SurfaceEnd::is_visible);
    const bool needless = visible >= 2 && (draft.options().border_cuts ||
                                           (blind->is_knob() && !has_rounded_end(draft)));
    if (!sac && (!needless || is_widest_trunk(draft, e, *blind))) return std::nullopt;
    return ClosedLook{.why = sac ? "it looks like an aneurysm" : "its branch is short",
                      .sac = sac && (!blind->bulges || blind->is_sac())};
}

}  // namespace vesselbench
