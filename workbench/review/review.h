#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "workbench/review/entered_verdicts.h"
#include "workbench/session/session.h"

namespace vesselbench {

/// SHA-256 of an edit as it is in a state: its operation, place, arguments, revision, what it
/// decided by itself, and the digest of its result. A verdict holds for what has the same hash.
[[nodiscard]] std::string edit_hash(const ProjectFile& project, const LogEntry& entry);

/// The verdict of one reviewer on one edit that was entered last; of one signer, unless what was
/// entered after a signed rejection is not signed (reviewer_identity.h).
struct GivenVerdict {
    std::string reviewer, role, time;
    Verdict verdict = Verdict::None;
    std::string comment;
    int revision = 1;       ///< that was reviewed
    bool outdated = false;  ///< the edit, or its result, is another one now
    Signature signature;    ///< of the file that it came with
    std::string person;     ///< ReviewerIdentity::person
};

enum class ReviewStatus : std::uint8_t {
    Open,      ///< nobody has decided
    Accepted,  ///< by at least one reviewer, and rejected by none
    Rejected,  ///< by at least one reviewer, and accepted by none
    Disputed,  ///< accepted by one, rejected by another
    Outdated   ///< decided for an earlier revision or result only
};

[[nodiscard]] std::string to_string(ReviewStatus status);

/// A pin of a reviewer's newest verdicts that name the edit.
struct GivenPin {
    std::string reviewer;
    Pin pin;
    bool outdated = false;  ///< the edit, or its result, is another one now
};

/// A distance of a reviewer's newest verdicts that name the edit.
struct GivenDistance {
    std::string reviewer;
    ReviewedDistance distance;
    bool outdated = false;  ///< the edit, or its result, is another one now
};

/// An edit of the current state with its verdicts.
struct ReviewedEdit {
    EditRef edit;
    EditPlace place;
    std::string operation;
    std::string hash;
    bool pending = false;  ///< it has no result yet: no verdict holds
    ReviewStatus status = ReviewStatus::Open;
    std::vector<GivenVerdict> verdicts;    ///< by reviewer, ascending
    std::vector<GivenPin> pins;            ///< by reviewer, also of those who have not decided
    std::vector<GivenDistance> distances;  ///< likewise
};

/// The reviews of the current state.
struct Review {
    std::vector<ReviewedEdit> edits;    ///< by step, then time
    std::vector<GivenVerdict> overall;  ///< of the whole model, by reviewer
    std::size_t files = 0;              ///< that were entered
};

/// \throw InvalidInput if stored verdicts are damaged
[[nodiscard]] Review review_of(const Session& session);

/// The part of a review that a variant's model consists of.
[[nodiscard]] Review review_of(const Session& session, const std::string& variant);

/// The review of a log's edits by what was entered.
/// \param files that were entered, oldest first
[[nodiscard]] Review review_of(const ProjectFile& project, const std::vector<LogEntry>& log,
                               const std::vector<EnteredVerdicts>& files);

/// Of all its edits and of the verdicts on the whole: rejected before disputed, outdated, open,
/// accepted.
[[nodiscard]] ReviewStatus status_of(const Review& review);

/// Of the verdicts on the whole model alone.
[[nodiscard]] ReviewStatus status_of_whole(const Review& review);

/// One line: "accepted by A. Kern, B. Roth", who accept every edit; "every edit accepted, by A.
/// Kern, B. Roth", none of whom does; "open: 2 of 5 edits accepted".
[[nodiscard]] std::string review_words(const Review& review);

/// What is missing until `reviewers`, different persons, have accepted every edit and nobody has
/// rejected one, or the whole: "2 smooth (open)". Empty: nothing.
[[nodiscard]] std::vector<std::string> missing_acceptance(const Review& review,
                                                          std::size_t reviewers);

/// \throw DiagnosedFailure that names what missing_acceptance() finds
void require_accepted(const Review& review, std::size_t reviewers);

}  // namespace vesselbench
