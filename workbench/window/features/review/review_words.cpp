#include "workbench/window/features/review/review_words.h"

#include "geometry/kernel/printable.h"
#include "geometry/kernel/wording.h"
#include "workbench/window/case/local_time.h"

namespace vesselbench {

namespace {

constexpr std::size_t kLongestLine = 120, kLongestPin = 60;  ///< [bytes]

std::string line_of(const std::string& reviewer, const std::string& text, std::size_t most) {
    return printable(shortened(reviewer + ": " + text, most));
}

std::string remark_of(const GivenVerdict& given) {
    const std::string text = given.comment.empty() ? to_string(given.verdict) : given.comment;
    return line_of(given.reviewer, text, kLongestLine);
}

}  // namespace

std::string pin_words(const GivenPin& pin) {
    return line_of(pin.reviewer, pin.pin.text.empty() ? "pin" : pin.pin.text, kLongestPin) +
           (pin.outdated ? " (outdated)" : "");
}

std::string length_words(const ReviewedDistance& distance) {
    return formatted((distance.to - distance.from).norm(), "%.2f mm");
}

std::string distance_words(const GivenDistance& given) {
    const std::string& text = given.distance.text;
    return line_of(given.reviewer, length_words(given.distance) + (text.empty() ? "" : ", " + text),
                   kLongestPin) +
           (given.outdated ? " (outdated)" : "");
}

std::string verdict_words(const GivenVerdict& given) {
    std::string words = printable(given.reviewer);
    if (!given.role.empty()) words += ", " + printable(given.role);
    words += ": " + to_string(given.verdict) + (given.outdated ? " (outdated)" : "");
    return words + ", " + local_time(given.time, "%Y-%m-%d %H:%M");
}

std::string remark_of(const std::vector<GivenVerdict>& verdicts) {
    for (const GivenVerdict& given : verdicts)
        if (given.verdict == Verdict::Reject && !given.outdated) return remark_of(given);
    return verdicts.empty() ? "" : remark_of(verdicts.front());
}

std::string remark_of(const ReviewedEdit& edit) {
    return remark_of(edit.verdicts);
}

bool is_rejected(const ReviewedEdit& edit) {
    return edit.status == ReviewStatus::Rejected || edit.status == ReviewStatus::Disputed;
}

}  // namespace vesselbench
