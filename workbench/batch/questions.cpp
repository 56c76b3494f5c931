#include "workbench/batch/questions.h"

#include <optional>
#include <utility>

#include "workbench/batch/case_report.h"

namespace vesselbench {

std::vector<CaseQuestion> open_questions(const std::vector<PlannedCase>& cases,
                                         const BatchFolders& folders) {
    std::vector<CaseQuestion> questions;
    for (const PlannedCase& one : cases) {
        if (!one.record || !one.record->failure || one.record->failure->code != kEndInDoubt ||
            is_finished_by_hand(one, folders))
            continue;
        const auto folder = folders.of(one.what.name);
        if (std::optional<EndQuestion> question = read_end_question(folder))
            questions.push_back({.name = one.what.name,
                                 .sha256 = one.sha256,
                                 .question = *std::move(question),
                                 .picture = content_if_any(folder / kEndQuestionPicture)});
    }
    return questions;
}

}  // namespace vesselbench
