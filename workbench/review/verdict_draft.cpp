#include "workbench/review/verdict_draft.h"

#include <algorithm>
#include <utility>

namespace vesselbench {

ReviewedDistance distance_between(const Vec3& from, const Vec3& to) {
    return {.from = from, .to = to, .length = (to - from).norm()};
}

std::string why_incomplete(const VerdictDraft& draft, Verdict verdict) {
    const bool reason = draft.comment.find_first_not_of(' ') != std::string::npos;
    return verdict == Verdict::Reject && !reason ? "a rejection needs a reason" : "";
}

VerdictDraft rest_of(VerdictDraft draft, const VerdictDraft& given) {
    if (draft.comment == given.comment) draft.comment.clear();
    std::erase_if(draft.pins, [&](const Pin& pin) {
        return std::ranges::any_of(given.pins, [&](const Pin& other) {
            return pin.place == other.place && pin.text == other.text;
        });
    });
    std::erase_if(draft.distances, [&](const ReviewedDistance& distance) {
        return std::ranges::any_of(given.distances, [&](const ReviewedDistance& other) {
            return distance.from == other.from && distance.to == other.to &&
                   distance.text == other.text;
        });
    });
    return draft;
}

EditVerdict verdict_of(const VerdictDraft& draft, Verdict verdict, const ReviewedEdit& edit,
                       const std::string& reviewer) {
    EditVerdict said{
        .edit = edit.edit, .hash = edit.hash, .verdict = verdict, .comment = draft.comment};
    for (const GivenPin& given : edit.pins)
        if (given.reviewer == reviewer && !given.outdated) said.pins.push_back(given.pin);
    for (const GivenDistance& given : edit.distances)
        if (given.reviewer == reviewer && !given.outdated) said.distances.push_back(given.distance);
    said.pins.insert(said.pins.end(), draft.pins.begin(), draft.pins.end());
    said.distances.insert(said.distances.end(), draft.distances.begin(), draft.distances.end());
    return said;
}

}  // namespace vesselbench
