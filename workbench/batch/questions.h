#pragma once

#include <string>
#include <vector>

#include "workbench/batch/plan.h"
#include "workbench/prepare/end_question.h"

namespace vesselbench {

/// A case that stopped because vessel ends or its inlet are in doubt.
struct CaseQuestion {
    std::string name;    ///< of the case
    std::string sha256;  ///< PlannedCase::sha256
    EndQuestion question;
    std::string picture;  ///< a PNG file's bytes; empty: none
};

/// The cases that wait for an answer, in their order: those that failed by a doubt, and that nobody
/// has finished by hand since.
[[nodiscard]] std::vector<CaseQuestion> open_questions(const std::vector<PlannedCase>& cases,
                                                       const BatchFolders& folders);

}  // namespace vesselbench
