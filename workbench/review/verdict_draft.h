#pragma once

#include <string>
#include <vector>

#include "workbench/review/review.h"

namespace vesselbench {

/// What somebody who reviews in the program is about to say of an edit, or of the whole model,
/// which has no marks.
struct VerdictDraft {
    std::string comment;  ///< of a rejection: its reason
    std::vector<Pin> pins;
    std::vector<ReviewedDistance> distances;
};

/// The straight distance of two places [mm].
[[nodiscard]] ReviewedDistance distance_between(const Vec3& from, const Vec3& to);

/// Why it cannot be entered as such a verdict: "a rejection needs a reason"; empty: it can.
[[nodiscard]] std::string why_incomplete(const VerdictDraft& draft, Verdict verdict);

/// What of a draft is still to be entered when `given` is: it may have been added to meanwhile.
[[nodiscard]] VerdictDraft rest_of(VerdictDraft draft, const VerdictDraft& given);

/// The draft as a reviewer's verdict on an edit. Of each reviewer the newest verdict counts:
/// therefore the marks that the reviewer has given of the same edit and result precede the draft's.
[[nodiscard]] EditVerdict verdict_of(const VerdictDraft& draft, Verdict verdict,
                                     const ReviewedEdit& edit, const std::string& reviewer);

}  // namespace vesselbench
