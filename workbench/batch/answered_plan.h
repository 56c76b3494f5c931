#pragma once

#include <vector>

#include "workbench/batch/answers.h"
#include "workbench/batch/run_case.h"

namespace vesselbench {

/// Cases with what was answered to their questions.
struct AnsweredPlan {
    std::vector<PlannedCase> cases;
    Answers answers;  ///< all that the batch is to keep
};

/// Plans cases with the answers that the batch's folder keeps, and with those of options.answers,
/// which replace a case's earlier ones. Answers for other files than a case has are not taken.
/// Writes nothing.
/// \param tell receives a line for each case whose answers are not taken
/// \throw InvalidInput if a file of answers is malformed, or a new answer is of no case of the
/// batch, or at no end of its question; IoError
[[nodiscard]] AnsweredPlan plan_with_answers(const std::vector<BatchCase>& cases,
                                             const BatchOptions& options, const BatchTeller& tell);

}  // namespace vesselbench
