#include "workbench/window/features/openings/end_choices.h"

#include <algorithm>
#include <functional>
#include <utility>

#include "geometry/vessel/openings/opening_names.h"
#include "workbench/case/argument_texts.h"
#include "workbench/operations/clip_opening/parameters.h"
#include "workbench/operations/shared/opening_arguments.h"

namespace vesselbench {

namespace {

/// Planes that differ by less are the same: texts of coordinates are exact, but those of handles
/// are rounded.
constexpr double kSamePoint = 1e-6;   // mm
constexpr double kSameNormal = 1e-8;  // of the normals' difference [-]
constexpr double kSamePlace = 0.5;    // of a closing and its end [diameters]

/// The ends that a parameter names, by places or by numbers.
std::set<int> named_in(const OperationForm& form, const PlannedEnds& planned,
                       const NumberParameter& parameter) {
    std::set<int> named;
    const std::vector<double> places = list_of(form, parameter.places);
    for (std::size_t i = 0; i + 2 < places.size(); i += 3)
        if (const auto number = planned.number_at({places[i], places[i + 1], places[i + 2]}))
            named.insert(*number);
    for (const double number : list_of(form, parameter.numbers))
        named.insert(static_cast<int>(number));
    return named;
}

bool same_plane(const Plane& a, const Plane& b) {
    return (a.point - b.point).norm() < kSamePoint && (a.normal - b.normal).norm() < kSameNormal;
}

/// As planned with the user's choices, or without them.
bool is_planned(const PlannedEnds& planned, int number, const Plane& plane) {
    const PlannedOpening* now = planned.opening(number);
    const EndRecord* end = planned.plain->end(number);
    return (now != nullptr && same_plane(now->place.plane, plane)) ||
           (end != nullptr && end->opening &&
            same_plane(planned.plain->plan.openings[*end->opening].place.plane, plane));
}

bool closes(const std::vector<PlannedClosing>& closings, const EndRecord& end, ClosingWay way) {
    return std::ranges::any_of(closings, [&](const PlannedClosing& closing) {
        return closing.way == way && (closing.place - end.place).norm() < kSamePlace * end.diameter;
    });
}

bool is_planned_stub(const PlannedEnds& planned, const EndRecord& end) {
    return planned.decided(end).fate == EndFate::Removed || end.fate == EndFate::Removed;
}

/// What `planes` says of ends that no list names.
void take_planes(const OperationForm& form, const PlannedEnds& planned, EndChoices& choices) {
    const std::vector<PlannedOpening> openings = openings_in(records_of(form, "planes"));
    if (openings.empty()) return;
    std::set<int> given;
    for (const PlannedOpening& opening : openings) {
        const auto number = planned.number_at(opening.place.tip);
        if (!number) continue;
        given.insert(*number);
        if (!is_planned(planned, *number, opening.place.plane))
            choices.cuts[*number] = opening.place.plane;
    }
    for (const EndRecord& end : planned.plain->plan.ends) {
        const int number = end.number;
        if (number == 0 || choices.open.contains(number) || choices.closed.contains(number) ||
            choices.inlets.contains(number) || given.contains(number) == end.opening.has_value())
            continue;
        (given.contains(number) ? choices.open : choices.closed).insert(number);
    }
}

void take_closings(const OperationForm& form, const PlannedEnds& planned, EndChoices& choices) {
    const std::vector<PlannedClosing> closings = closings_in(records_of(form, "closings"));
    for (const EndRecord& end : planned.plain->plan.ends) {
        if (end.number == 0 || is_planned_stub(planned, end) ||
            !closes(closings, end, ClosingWay::RemoveStub))
            continue;
        choices.removed.insert(end.number);
        choices.closed.erase(end.number);
    }
}

std::string places_text(const PlannedEnds& planned, const std::set<int>& numbers) {
    std::vector<double> places;
    for (const int number : numbers) {
        const EndRecord* end = planned.plain->end(number);
        if (end == nullptr) continue;
        const Vec3 at = rounded_place(end->place);
        places.insert(places.end(), {at.x(), at.y(), at.z()});
    }
    return places.empty() ? "" : to_text(Value(places));
}

double diameter_of(const PlannedEnds& planned, int number) {
    const PlannedOpening* opening = planned.opening(number);
    const EndRecord* end = planned.plain->end(number);
    return opening != nullptr && opening->place.diameter > 0.0 ? opening->place.diameter
           : end != nullptr                                    ? end->diameter
                                                               : 0.0;
}

/// The inlets of a plan by the numbers of its ends without a user.
std::set<int> planned_inlets(const EndChoices& choices, const PlannedEnds& planned) {
    std::set<int> inlets, named;
    for (const EndRecord& end : planned.plain->plan.ends) {
        const EndRecord& now = planned.decided(end);
        if (end.number == 0 || !now.opening || !is_open(choices, planned, end.number)) continue;
        const OpeningPlan& plan = &now == &end ? planned.plain->plan : *planned.chosen;
        if (std::ranges::count(plan.inlets, *now.opening) > 0) inlets.insert(end.number);
        const auto& patch = plan.openings[*now.opening].patch;
        if (patch && patch->kind == PatchKind::Inlet) named.insert(end.number);
    }
    return inlets.empty() ? named : inlets;
}

/// The openings of all open ends, the widest first.
std::vector<std::pair<int, PlannedOpening>> all_openings(const EndChoices& choices,
                                                         const PlannedEnds& planned) {
    std::vector<std::pair<int, PlannedOpening>> openings;
    for (const EndRecord& end : planned.plain->plan.ends)
        if (end.number > 0 && is_open(choices, planned, end.number))
            if (const auto opening = opening_of(choices, planned, end.number))
                openings.emplace_back(end.number, *opening);
    std::ranges::stable_sort(openings, std::greater{}, [&](const auto& opening) {
        return diameter_of(planned, opening.first);
    });
    return openings;
}

/// A name that says the role stays; others are as name_openings() gives them.
std::vector<Patch> patches_of(const std::vector<std::pair<int, PlannedOpening>>& openings,
                              const std::set<int>& inlets) {
    std::vector<Patch> patches;
    for (const auto& [number, opening] : openings) {
        const PatchKind kind = inlets.contains(number) ? PatchKind::Inlet : PatchKind::Outlet;
        const bool keeps = opening.patch && opening.patch->kind == kind;
        patches.push_back(keeps ? *opening.patch : Patch{"", kind});
    }
    const int first = inlets.size() > 1 ? 1 : 0;
    for (Patch& patch : patches)
        if (patch.name.empty())
            patch.name = free_patch_name(to_string(patch.kind),
                                         patch.kind == PatchKind::Inlet ? first : 1, patches);
    return patches;
}

/// What becomes of the ends without an opening.
std::vector<PlannedClosing> all_closings(const EndChoices& choices, const PlannedEnds& planned) {
    const OpeningPlan& plan = planned.chosen ? *planned.chosen : planned.plain->plan;
    std::vector<PlannedClosing> closings = plan.closings;
    for (const EndRecord& end : planned.plain->plan.ends) {
        if (end.number == 0 || !is_open(choices, planned, end.number)) continue;
        std::erase_if(closings, [&](const PlannedClosing& closing) {
            return (closing.place - end.place).norm() < kSamePlace * end.diameter;
        });
    }
    for (const int number : choices.removed)
        if (const EndRecord* end = planned.plain->end(number))
            closings.push_back({end->place, ClosingWay::RemoveStub});
    return closings;
}

/// None is not given.
std::string text_of(const Records& records) {
    return records.list().empty() ? "" : to_text(Value(records));
}

/// The texts that say all of the plan.
void fix_plan(const EndChoices& choices, const PlannedEnds& planned,
              std::vector<FieldText>& texts) {
    const auto openings = all_openings(choices, planned);
    const std::vector<Patch> patches = patches_of(openings, inlets_of(choices, planned));
    std::vector<PlannedOpening> planes;
    for (const auto& [number, opening] : openings) planes.push_back(opening);
    texts.push_back({"planes", text_of(planes_argument(planes))});
    texts.push_back({"names", text_of(names_argument(patches))});
    texts.push_back({"closings", text_of(closings_argument(all_closings(choices, planned)))});
}

}  // namespace

EndChoices choices_in(const OperationForm& form, const PlannedEnds& planned) {
    EndChoices choices;
    choices.inlets = named_in(form, planned, kNumberParameters[0]);
    choices.open = named_in(form, planned, kNumberParameters[1]);
    choices.closed = named_in(form, planned, kNumberParameters[2]);
    take_planes(form, planned, choices);
    take_closings(form, planned, choices);
    std::erase_if(choices.cuts,
                  [&](const auto& cut) { return !is_open(choices, planned, cut.first); });
    return choices;
}

bool is_open(const EndChoices& choices, const PlannedEnds& planned, int number) {
    if (choices.removed.contains(number) || choices.closed.contains(number)) return false;
    if (choices.open.contains(number) || choices.inlets.contains(number)) return true;
    const EndRecord* end = planned.plain->end(number);
    if (end == nullptr) return false;
    // An end that is no longer named is again as it was before.
    const EndRecord& now = planned.decided(*end);
    return now.asked || now.wanted ? end->opening.has_value() : now.opening.has_value();
}

std::set<int> inlets_of(const EndChoices& choices, const PlannedEnds& planned) {
    if (!choices.inlets.empty()) return choices.inlets;
    std::set<int> inlets = planned_inlets(choices, planned);
    if (!inlets.empty()) return inlets;
    int widest = 0;
    for (const EndRecord& end : planned.plain->plan.ends)
        if (end.number > 0 && is_open(choices, planned, end.number) &&
            (widest == 0 || diameter_of(planned, end.number) > diameter_of(planned, widest)))
            widest = end.number;
    if (widest > 0) inlets.insert(widest);
    return inlets;
}

std::optional<PlannedOpening> opening_of(const EndChoices& choices, const PlannedEnds& planned,
                                         int number) {
    const PlannedOpening* opening = planned.opening(number);
    if (opening == nullptr) return std::nullopt;
    PlannedOpening found = *opening;
    if (const auto cut = choices.cuts.find(number); cut != choices.cuts.end()) {
        found.place.plane = cut->second;
        found.way = OpeningWay::Cut;
    }
    return found;
}

std::vector<FieldText> texts_of(const EndChoices& choices, const PlannedEnds& planned) {
    std::set<int> closed = choices.closed;
    closed.insert(choices.removed.begin(), choices.removed.end());
    std::vector<FieldText> texts = {{"inlet", places_text(planned, choices.inlets)},
                                    {"open", places_text(planned, choices.open)},
                                    {"closed", places_text(planned, closed)}};
    for (const NumberParameter& parameter : kNumberParameters)
        texts.push_back({parameter.numbers, ""});
    if (choices.fixes_plan()) {
        fix_plan(choices, planned, texts);
        return texts;
    }
    for (const char* name : {"planes", "names", "closings"}) texts.push_back({name, ""});
    return texts;
}

}  // namespace vesselbench
