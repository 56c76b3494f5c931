#include "workbench/review/review.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include <nlohmann/json.hpp>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/printable.h"
#include "geometry/kernel/wording.h"
#include "workbench/project/content_hash.h"
#include "workbench/project/stored_text.h"
#include "workbench/review/reviewer_identity.h"

namespace vesselbench {

namespace {

bool decides(Verdict verdict) {
    return verdict == Verdict::Accept || verdict == Verdict::Reject;
}

/// An entered file and whose it is.
struct GivenFile {
    const EnteredVerdicts* entered;
    ReviewerIdentity by;
};

std::vector<GivenFile> with_givers(const std::vector<EnteredVerdicts>& files) {
    const std::vector<ReviewerIdentity> identities = identities_of(files);
    std::vector<GivenFile> given;
    for (std::size_t i = 0; i < files.size(); ++i) given.push_back({&files[i], identities[i]});
    return given;
}

/// Verdicts by who gave them.
class ByGiver {
public:
    /// Of each giver the one entered last. Nobody takes a signed rejection back without signing.
    void enter(const GivenFile& from, GivenVerdict verdict) {
        verdict.reviewer = from.entered->verdicts.reviewer;
        verdict.role = from.entered->verdicts.role;
        verdict.signature = from.entered->signature;
        verdict.person = from.by.person;
        Last& last = last_[from.by.giver];
        if (last.is_signed && !from.by.is_signed && last.verdict.verdict == Verdict::Reject) return;
        last = {std::move(verdict), from.by.is_signed};
    }

    /// By the reviewers' names.
    [[nodiscard]] std::vector<GivenVerdict> list() const {
        std::vector<GivenVerdict> list;
        for (const auto& [giver, last] : last_) list.push_back(last.verdict);
        std::ranges::stable_sort(list, {}, &GivenVerdict::reviewer);
        return list;
    }

private:
    struct Last {
        GivenVerdict verdict;
        bool is_signed = false;
    };

    std::map<std::string, Last> last_;
};

ReviewStatus status_of(const std::vector<GivenVerdict>& verdicts) {
    bool accepted = false, rejected = false, outdated = false;
    for (const GivenVerdict& given : verdicts) {
        accepted |= !given.outdated && given.verdict == Verdict::Accept;
        rejected |= !given.outdated && given.verdict == Verdict::Reject;
        outdated |= given.outdated && decides(given.verdict);
    }
    if (accepted && rejected) return ReviewStatus::Disputed;
    if (accepted) return ReviewStatus::Accepted;
    if (rejected) return ReviewStatus::Rejected;
    return outdated ? ReviewStatus::Outdated : ReviewStatus::Open;
}

/// A verdict on the whole holds while every edit is one that its file saw.
bool saw_all(const VerdictFile& file, const std::vector<ReviewedEdit>& edits) {
    std::set<std::string> seen;
    for (const EditVerdict& verdict : file.edits) seen.insert(verdict.hash);
    return std::ranges::all_of(edits,
                               [&](const ReviewedEdit& edit) { return seen.contains(edit.hash); });
}

void add_verdicts(const std::vector<GivenFile>& files, ReviewedEdit& edit) {
    ByGiver last;
    for (const GivenFile& file : files)
        for (const EditVerdict& verdict : file.entered->verdicts.edits)
            if (verdict.edit.id == edit.edit.id && verdict.verdict != Verdict::None)
                last.enter(file, {.time = verdict.time,
                                  .verdict = verdict.verdict,
                                  .comment = verdict.comment,
                                  .revision = verdict.edit.revision,
                                  .outdated = edit.pending || verdict.hash != edit.hash});
    edit.verdicts = last.list();
    edit.status = status_of(edit.verdicts);
}

void add_marks(const std::vector<GivenFile>& files, ReviewedEdit& edit) {
    struct Marks {
        std::string reviewer;
        const EditVerdict* verdict;
    };

    std::map<std::string, Marks> last;
    for (const GivenFile& file : files)
        for (const EditVerdict& verdict : file.entered->verdicts.edits)
            if (verdict.edit.id == edit.edit.id && !says_nothing(verdict))
                last[file.by.giver] = {file.entered->verdicts.reviewer, &verdict};
    for (const auto& [giver, marks] : last) {
        const auto& [reviewer, verdict] = marks;
        const bool outdated = edit.pending || verdict->hash != edit.hash;
        for (const Pin& pin : verdict->pins)
            edit.pins.push_back({.reviewer = reviewer, .pin = pin, .outdated = outdated});
        for (const ReviewedDistance& distance : verdict->distances)
            edit.distances.push_back(
                {.reviewer = reviewer, .distance = distance, .outdated = outdated});
    }
}

/// By how many edits each reviewer accepts.
std::map<std::string, std::size_t> acceptances(const Review& review) {
    std::map<std::string, std::size_t> counts;
    for (const ReviewedEdit& edit : review.edits)
        for (const GivenVerdict& given : edit.verdicts)
            if (given.verdict == Verdict::Accept && !given.outdated) ++counts[given.reviewer];
    return counts;
}

/// "accepted by A. Kern", who accepts every edit; "every edit accepted, by A. Kern, B. Roth", who
/// share them.
std::string acceptance_words(const Review& review) {
    std::vector<std::string> some, all;
    for (const auto& [reviewer, count] : acceptances(review)) {
        some.push_back(reviewer);
        if (count == review.edits.size()) all.push_back(reviewer);
    }
    return all.empty() ? "every edit accepted, by " + joined(some) : "accepted by " + joined(all);
}

std::string edit_words(const ReviewedEdit& edit) {
    return std::to_string(edit.edit.id) + " " + printable(edit.operation);
}

/// The persons who accept an edit.
std::set<std::string> accepting(const ReviewedEdit& edit) {
    std::set<std::string> who;
    for (const auto& given : edit.verdicts)
        if (!given.outdated && given.verdict == Verdict::Accept) who.insert(given.person);
    return who;
}

/// "rejected by A. Kern", "accepted by 1 of 2"
std::string lack_of(const ReviewedEdit& edit, std::size_t reviewers) {
    if (edit.status != ReviewStatus::Rejected && edit.status != ReviewStatus::Accepted)
        return to_string(edit.status);
    if (edit.status == ReviewStatus::Accepted)
        return "accepted by " + std::to_string(accepting(edit).size()) + " of " +
               std::to_string(reviewers);
    std::vector<std::string> names;
    for (const GivenVerdict& given : edit.verdicts)
        if (!given.outdated && decides(given.verdict)) names.push_back(printable(given.reviewer));
    return "rejected by " + enumerated(names);
}

bool is_accepted(const ReviewedEdit& edit, std::size_t reviewers) {
    return edit.status == ReviewStatus::Accepted && accepting(edit).size() >= reviewers;
}

}  // namespace

std::string to_string(ReviewStatus status) {
    switch (status) {
        case ReviewStatus::Accepted:
            return "accepted";
        case ReviewStatus::Rejected:
            return "rejected";
        case ReviewStatus::Disputed:
            return "disputed";
        case ReviewStatus::Outdated:
            return "outdated";
        case ReviewStatus::Open:
            break;
    }
    return "open";
}

std::string edit_hash(const ProjectFile& project, const LogEntry& entry) {
    const EditRecord& edit = entry.edit;
    return hash_of_text(
        nlohmann::json({{"edit", edit.edit.id},
                        {"revision", edit.edit.revision},
                        {"step", to_string(edit.place.step)},
                        {"variant", edit.place.variant},
                        {"operation", edit.operation},
                        {"arguments", stored_text(edit.given)},
                        {"resolved", entry.result ? stored_text(entry.result->resolved) : ""},
                        {"result", entry.result ? project.digest(entry.result->id) : ""}})
            .dump());
}

Review review_of(const Session& session) {
    return review_of(session.project(), session.log(), entered_verdicts(session.project()));
}

Review review_of(const Session& session, const std::string& variant) {
    return review_of(session.project(), session.log(variant), entered_verdicts(session.project()));
}

Review review_of(const ProjectFile& project, const std::vector<LogEntry>& log,
                 const std::vector<EnteredVerdicts>& files) {
    Review review{.files = files.size()};
    const std::vector<GivenFile> given = with_givers(files);
    for (const LogEntry& entry : log) {
        ReviewedEdit& edit =
            review.edits.emplace_back(ReviewedEdit{.edit = entry.edit.edit,
                                                   .place = entry.edit.place,
                                                   .operation = entry.edit.operation,
                                                   .hash = edit_hash(project, entry),
                                                   .pending = entry.status == EditStatus::Pending});
        add_verdicts(given, edit);
        add_marks(given, edit);
    }
    ByGiver overall;
    for (const GivenFile& file : given)
        if (const VerdictFile& said = file.entered->verdicts; said.overall != Verdict::None)
            overall.enter(file, {.time = said.written,
                                 .verdict = said.overall,
                                 .comment = said.overall_comment,
                                 .outdated = !saw_all(said, review.edits)});
    review.overall = overall.list();
    return review;
}

ReviewStatus status_of(const Review& review) {
    using enum ReviewStatus;
    std::set<ReviewStatus> found;
    for (const ReviewedEdit& edit : review.edits) found.insert(edit.status);
    for (const GivenVerdict& given : review.overall)
        if (!given.outdated && given.verdict == Verdict::Reject) found.insert(Rejected);
    if (found.empty()) return Open;
    for (const ReviewStatus status : {Rejected, Disputed, Outdated, Open})
        if (found.contains(status)) return status;
    return Accepted;
}

ReviewStatus status_of_whole(const Review& review) {
    return status_of(review.overall);
}

std::string review_words(const Review& review) {
    if (review.files == 0) return "not reviewed";
    const ReviewStatus status = status_of(review);
    if (status == ReviewStatus::Accepted) return printable(acceptance_words(review));
    const auto accepted =
        std::ranges::count(review.edits, ReviewStatus::Accepted, &ReviewedEdit::status);
    return to_string(status) + ": " + std::to_string(accepted) + " of " +
           counted(review.edits.size(), "edit") + " accepted";
}

std::vector<std::string> missing_acceptance(const Review& review, std::size_t reviewers) {
    std::vector<std::string> missing;
    for (const ReviewedEdit& edit : review.edits)
        if (!is_accepted(edit, reviewers))
            missing.push_back(edit_words(edit) + " (" + lack_of(edit, reviewers) + ")");
    for (const GivenVerdict& given : review.overall)
        if (!given.outdated && given.verdict == Verdict::Reject)
            missing.push_back("the whole model (rejected by " + printable(given.reviewer) + ")");
    return missing;
}

void require_accepted(const Review& review, std::size_t reviewers) {
    const std::vector<std::string> missing = missing_acceptance(review, reviewers);
    if (missing.empty()) return;
    throw DiagnosedFailure({.code = "not-accepted",
                            .figures = {{"reviewers", static_cast<double>(reviewers)},
                                        {"missing", static_cast<double>(missing.size())}},
                            .words = {{"edits", joined(missing)}}});
}

}  // namespace vesselbench
