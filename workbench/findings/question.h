#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "workbench/findings/finding.h"

namespace vesselbench {

/// "Bump"; of a question what it asks: "Sac (aneurysm?) or stub?", "Narrowing: stenosis or
/// artefact?". The likeliest comes first; anatomy that is unlikely beside other anatomy is left
/// out.
[[nodiscard]] std::string title_of(const Finding& finding);

/// What the certainty is of: "96 % that a branch ends blind and short".
[[nodiscard]] std::string certainty_words(const Finding& finding);

/// "sac (aneurysm?) 88 %: its body is 1.6 times as wide as its neck".
/// \param window as Audience::window
[[nodiscard]] std::string reading_words(const Reading& reading, bool window = false);

/// All readings in a line: "sac (aneurysm?) 88 %, stub 10 %, vessel 2 %". Empty: no question.
[[nodiscard]] std::string odds_words(const Finding& finding);

/// "17 more below 50 %", the line under which those are folded that are not listed.
/// \param more some are listed above it
[[nodiscard]] std::string folded_words(std::size_t count, bool more = true);

/// The reading that the operation is for; null: it is no question.
[[nodiscard]] const Reading* artefact_reading(const Finding& finding);

/// The reason that is entered for a question that was answered with "keep".
[[nodiscard]] std::string kept_reason(const Finding& finding);

/// Returns if a finding is no question, or answered as the artefact.
/// \param taken_as key of a reading; empty: not answered
/// \throw UsageError that names the readings
void require_answer(const Finding& finding, const std::string& taken_as);

}  // namespace vesselbench
