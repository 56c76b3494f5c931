#include "workbench/window/case/export_state.h"

#include "geometry/kernel/diagnosed_error.h"
#include "workbench/prepare/acceptance_gate.h"
#include "workbench/prepare/vessel_question.h"
#include "workbench/review/review.h"
#include "workbench/session/stored_texts.h"

namespace vesselbench {

namespace {

std::string why_not_accepted(const Session& session, const std::filesystem::path& project,
                             const std::string& variant, const Review& review) {
    try {
        require_acceptance(session, project, variant, 0, review);
        return "";
    } catch (const DiagnosedFailure& failure) {
        return failure.what();
    }
}

}  // namespace

ExportState export_state(const Session& session, const std::filesystem::path& project,
                         const std::string& variant) {
    const Review review = review_of(session, variant);
    const bool reviewed = review.files > 0;
    return {.review = reviewed ? review_words(review) : "",
            .unsettled = reviewed && status_of(review) != ReviewStatus::Accepted,
            .refusal = why_not_accepted(session, project, variant, review),
            .flow = FlowSettings(stored_text(project, StoredText::Flow)),
            .split = flow_in_vessel({}, session.log(variant)).split};
}

}  // namespace vesselbench
