#include "workbench/window/features/review/review_words.h"

#include "geometry/kernel/printable.h"
#include "workbench/window/case/local_time.h"

namespace vesselbench {

namespace {

constexpr std::size_t kLongestLine = 120;  ///< [bytes]

std::string line_of(const std::string& reviewer, const std::string& text) {
    return printable(shortened(reviewer + ": " + text, kLongestLine));
}

std::string remark_of(const GivenVerdict& given) {
    return line_of(given.reviewer,
                   given.comment.empty() ? to_string(given.verdict) : given.comment);
}

}  // namespace

std::string pin_words(const GivenPin& pin) {
    return line_of(pin.reviewer, pin.pin.text.empty() ? "pin" : pin.pin.text) +
           (pin.outdated ? " (outdated)" : "");
}

std::string verdict_words(const GivenVerdict& given) {
    std::string words = printable(given.reviewer);
    if (!given.role.empty()) words += ", " + printable(given.role);
    words += ": " + to_string(given.verdict) + (given.outdated ? " (outdated)" : "");
    return words + ", " + local_time(given.time, "%Y-%m-%d %H:%M");
}

std::string remark_of(const ReviewedEdit& edit) {
    for (const GivenVerdict& given : edit.verdicts)
        if (given.verdict == Verdict::Reject && !given.outdated) return remark_of(given);
    return edit.verdicts.empty() ? "" : remark_of(edit.verdicts.front());
}

bool is_rejected(const ReviewedEdit& edit) {
    return edit.status == ReviewStatus::Rejected || edit.status == ReviewStatus::Disputed;
}

}  // namespace vesselbench
