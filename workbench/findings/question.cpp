#include "workbench/findings/question.h"

#include <algorithm>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/printable.h"
#include "geometry/kernel/wording.h"
#include "workbench/case/diagnostic_words.h"
#include "workbench/case/readable_name.h"
#include "workbench/findings/detectors.h"

namespace vesselbench {

namespace {

constexpr double kNamed = 0.1;  ///< odds of a second anatomy that a title names [-]

std::string percent_text(double share) {
    return formatted(100.0 * share, "%.0f %%");
}

std::string name_with_odds(const Reading& reading) {
    return reading.odds ? reading.name + " " + percent_text(*reading.odds) : reading.name;
}

/// In the order of the readings: the artefact, and of the anatomy the likeliest and what is likely.
std::vector<std::string> names_in_title(const Finding& finding) {
    std::vector<std::string> names;
    bool first = true;
    for (const Reading& reading : finding.readings) {
        if (!reading.anatomy || first || reading.odds.value_or(1.0) >= kNamed)
            names.push_back(reading.name);
        first = first && !reading.anatomy;
    }
    return names;
}

}  // namespace

std::string title_of(const Finding& finding) {
    if (!finding.asks()) return title_of_kind(finding.kind);
    const std::string question = enumerated(names_in_title(finding), "or") + "?";
    const bool named = std::ranges::count(finding.readings, finding.kind, &Reading::key) > 0;
    return named ? readable_sentence(question) : title_of_kind(finding.kind) + ": " + question;
}

std::string certainty_words(const Finding& finding) {
    return percent_text(finding.certainty) + " that " + certain_of_kind(finding.kind);
}

std::string reading_words(const Reading& reading, bool window) {
    const std::string name = name_with_odds(reading);
    if (reading.evidence.empty()) return name;
    return name + ": " + joined(worded(reading.evidence, {.window = window}), ", ");
}

std::string odds_words(const Finding& finding) {
    std::vector<std::string> all;
    for (const Reading& reading : finding.readings) all.push_back(name_with_odds(reading));
    return joined(all);
}

std::string folded_words(std::size_t count, bool more) {
    return std::to_string(count) + (more ? " more below " : " below ") + percent_text(kListed);
}

const Reading* artefact_reading(const Finding& finding) {
    const auto found = std::ranges::find(finding.readings, false, &Reading::anatomy);
    return found == finding.readings.end() ? nullptr : &*found;
}

std::string kept_reason(const Finding& finding) {
    return "kept: " + odds_words(finding);
}

void require_answer(const Finding& finding, const std::string& taken_as) {
    const Reading* artefact = artefact_reading(finding);
    if (artefact == nullptr || taken_as == artefact->key) return;
    const auto named = std::ranges::find(finding.readings, taken_as, &Reading::key);
    if (named != finding.readings.end())
        throw UsageError("a " + named->name + " is anatomy, which no finding removes: keep " +
                         finding.id());
    throw UsageError(finding.id() + " may be anatomy (" + odds_words(finding) +
                     "): keep it, or say that it is none with --as " + artefact->key +
                     (taken_as.empty() ? "" : ", not " + shortened(printable(taken_as))));
}

}  // namespace vesselbench
