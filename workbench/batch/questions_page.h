#pragma once

#include <string>
#include <vector>

#include "workbench/batch/questions.h"

namespace vesselbench {

/// The page of a batch's folder on which its questions are answered.
inline constexpr const char* kQuestionsPage = "questions.html";

/// One self-contained page, which works without a network: each case with its doubt, the picture of
/// its numbered ends, and what each end may be, of which the proposal is chosen. It saves the
/// answers as answers_in() reads them. All texts are escaped, and its policy (CSP) allows its own
/// script and style alone.
[[nodiscard]] std::string questions_page(const std::vector<CaseQuestion>& questions);

}  // namespace vesselbench
