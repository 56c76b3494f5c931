#include "workbench/session/edit_place.h"

#include <algorithm>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/plain_name.h"
#include "geometry/kernel/printable.h"
#include "geometry/kernel/wording.h"

namespace vesselbench {

namespace {

bool is_own_step(Step step, const History& history) {
    return belongs_to_variant(step) && step >= history.first_variant_step();
}

}  // namespace

EditPlace place_of_new(Step step, const std::string& variant, const History& history) {
    return {step, is_own_step(step, history) ? variant : std::string()};
}

EditPlace place_of(const Operation& operation, const EditOptions& options, const History& history) {
    const Step step = options.step.value_or(operation.usual_step);
    if (std::ranges::count(operation.allowed, step) == 0)
        throw UsageError(operation.name + " is not allowed in step " + to_string(step) +
                         " (only in: " + joined(step_names(operation.allowed)) + ")");
    if (!is_own_step(step, history)) return {step, {}};
    if (options.variant.empty())
        throw UsageError("step " + to_string(step) +
                         " belongs to a variant; give its name (cfd, rp, ...)");
    if (!is_plain_name(options.variant))
        throw UsageError("the variant '" + shortened(printable(options.variant)) +
                         "' is not allowed: its name consists of " + plain_name_rule());
    return {step, options.variant};
}

/// The entries that precede a new edit of this place.
std::vector<HistoryEntry> entries_before(const History& history, const EditPlace& place) {
    std::vector<HistoryEntry> before = history.line(place.variant);
    std::erase_if(before, [&](const HistoryEntry& e) { return e.place.step > place.step; });
    return before;
}

/// The entries of the edit's line up to it, without it.
std::vector<HistoryEntry> entries_before(const History& history, EditId id) {
    for (const HistoryEntry& entry : history.entries()) {
        if (entry.edit.id != id) continue;
        std::vector<HistoryEntry> before = history.line(entry.place.variant);
        const auto own = std::find_if(before.begin(), before.end(),
                                      [&](const auto& e) { return e.edit.id == id; });
        before.erase(own, before.end());
        return before;
    }
    throw UsageError("the current state has no edit " + std::to_string(id) +
                     "; see its edits with log");
}

std::string variant_meant(const std::string& asked, const History& history) {
    if (!asked.empty()) return asked;
    const std::vector<std::string> variants = history.variants();
    return variants.size() == 1 ? variants.front() : kDefaultVariant;
}

}  // namespace vesselbench
