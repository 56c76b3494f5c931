#include "workbench/window/case/edit_input.h"

#include <algorithm>
#include <utility>

#include "workbench/session/edit_place.h"
#include "workbench/session/known_results.h"
#include "workbench/window/case/rail.h"
#include "workbench/window/case/readable.h"

namespace vesselbench {

namespace {

/// Number of the edits that precede it, itself, and those that follow it in what is shown.
std::size_t edits_around(const EditPlace& place, const History& history,
                         const std::string& variant) {
    return history.line(place.variant.empty() ? variant : place.variant).size();
}

}  // namespace

std::optional<EditInput> input_of(const EditSite& site, const History& history,
                                  const std::string& variant) {
    EditPlace place = place_of_new(site.step, variant, history);
    if (site.edit) {
        const auto edit = history.find(*site.edit);
        if (!edit) return std::nullopt;
        place = history.edits().at(*edit);
    }
    auto before = site.edit ? entries_before(history, *site.edit) : entries_before(history, place);
    if (before.empty()) return std::nullopt;
    const std::size_t until = before.size() + (site.edit ? 1 : 0);
    return EditInput{
        .site = {site.edit, place.step},
        .before = before,
        .result = known_end(before),
        .has_pending = std::ranges::count(before, EditStatus::Pending, &HistoryEntry::status) > 0,
        .has_later = edits_around(place, history, variant) > until};
}

bool is_earlier(const EditInput& input) {
    return input.site.edit || input.has_later;
}

std::string input_text(const EditInput& input, const std::string& operation) {
    const EditSite& site = input.site;
    std::string text =
        site.edit ? "Before edit " + std::to_string(*site.edit) + ", " + readable(operation)
                  : readable(operation) + " goes in after " + title_of(site.step);
    if (input.has_pending) text += ". Pending edits before it are not in it yet: run them first";
    return text;
}

}  // namespace vesselbench
