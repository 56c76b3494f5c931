#include "workbench/review/review.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include <nlohmann/json.hpp>

#include "geometry/kernel/bare_name.h"
#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/printable.h"
#include "geometry/kernel/wording.h"
#include "workbench/case/json_text.h"
#include "workbench/case/version.h"
#include "workbench/project/content_hash.h"
#include "workbench/project/project.h"
#include "workbench/project/record_check.h"
#include "workbench/project/stored_text.h"
#include "workbench/project/utc_time.h"

namespace vesselbench {

namespace {

std::string sha256(const std::string& text) {
    ContentHash hash;
    hash.add(std::as_bytes(std::span(text)));
    return hash.hex();
}

bool decides(Verdict verdict) {
    return verdict == Verdict::Accept || verdict == Verdict::Reject;
}

/// By reviewer: the newest, of equal times the one entered last.
using ByReviewer = std::map<std::string, GivenVerdict>;

void keep_newest(ByReviewer& verdicts, GivenVerdict verdict) {
    const auto [found, is_new] = verdicts.try_emplace(verdict.reviewer, verdict);
    if (!is_new && found->second.time <= verdict.time) found->second = std::move(verdict);
}

std::vector<GivenVerdict> list_of(const ByReviewer& verdicts) {
    std::vector<GivenVerdict> list;
    for (const auto& [reviewer, verdict] : verdicts) list.push_back(verdict);
    return list;
}

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

std::vector<VerdictFile> stored_verdicts(const ProjectFile& project) {
    std::vector<VerdictFile> files;
    for (const std::string& text : project.verdicts())
        files.push_back(verdicts_from_text(text, "the stored verdicts"));
    return files;
}

void add_verdicts(const std::vector<VerdictFile>& files, ReviewedEdit& edit) {
    ByReviewer newest;
    for (const VerdictFile& file : files)
        for (const EditVerdict& verdict : file.edits)
            if (verdict.edit.id == edit.edit.id && verdict.verdict != Verdict::None)
                keep_newest(newest, {.reviewer = file.reviewer,
                                     .role = file.role,
                                     .time = verdict.time,
                                     .verdict = verdict.verdict,
                                     .comment = verdict.comment,
                                     .revision = verdict.edit.revision,
                                     .outdated = verdict.hash != edit.hash});
    edit.verdicts = list_of(newest);
    edit.status = status_of(edit.verdicts);
}

/// True of an edit that is listed only because its reviewer saw it, for a verdict on the whole.
bool says_nothing(const EditVerdict& verdict) {
    return verdict.verdict == Verdict::None && verdict.comment.empty() && verdict.pins.empty() &&
           verdict.distances.empty();
}

void add_marks(const std::vector<VerdictFile>& files, ReviewedEdit& edit) {
    std::map<std::string, const EditVerdict*> newest;
    for (const VerdictFile& file : files)
        for (const EditVerdict& verdict : file.edits) {
            if (verdict.edit.id != edit.edit.id || says_nothing(verdict)) continue;
            const EditVerdict*& found = newest[file.reviewer];
            if (found == nullptr || found->time <= verdict.time) found = &verdict;
        }
    for (const auto& [reviewer, verdict] : newest) {
        const bool outdated = verdict->hash != edit.hash;
        for (const Pin& pin : verdict->pins)
            edit.pins.push_back({.reviewer = reviewer, .pin = pin, .outdated = outdated});
        for (const ReviewedDistance& distance : verdict->distances)
            edit.distances.push_back(
                {.reviewer = reviewer, .distance = distance, .outdated = outdated});
    }
}

Review review_of(const ProjectFile& project, const std::vector<LogEntry>& log) {
    const std::vector<VerdictFile> files = stored_verdicts(project);
    Review review{.files = files.size()};
    for (const LogEntry& entry : log) {
        ReviewedEdit& edit =
            review.edits.emplace_back(ReviewedEdit{.edit = entry.edit.edit,
                                                   .place = entry.edit.place,
                                                   .operation = entry.edit.operation,
                                                   .hash = edit_hash(project, entry)});
        add_verdicts(files, edit);
        add_marks(files, edit);
    }
    ByReviewer overall;
    for (const VerdictFile& file : files)
        if (file.overall != Verdict::None)
            keep_newest(overall, {.reviewer = file.reviewer,
                                  .role = file.role,
                                  .time = file.written,
                                  .verdict = file.overall,
                                  .comment = file.overall_comment,
                                  .outdated = !saw_all(file, review.edits)});
    review.overall = list_of(overall);
    return review;
}

std::set<std::string> accepting(const Review& review) {
    std::set<std::string> names;
    for (const ReviewedEdit& edit : review.edits)
        for (const GivenVerdict& given : edit.verdicts)
            if (given.verdict == Verdict::Accept && !given.outdated) names.insert(given.reviewer);
    return names;
}

std::string edit_words(const ReviewedEdit& edit) {
    return std::to_string(edit.edit.id) + " " + printable(edit.operation);
}

/// "rejected by A. Kern", "accepted by 1 of 2"
std::string lack_of(const ReviewedEdit& edit, std::size_t reviewers) {
    if (edit.status != ReviewStatus::Rejected && edit.status != ReviewStatus::Accepted)
        return to_string(edit.status);
    std::vector<std::string> names;
    for (const GivenVerdict& given : edit.verdicts)
        if (!given.outdated && decides(given.verdict)) names.push_back(printable(given.reviewer));
    if (edit.status == ReviewStatus::Rejected) return "rejected by " + enumerated(names);
    return "accepted by " + std::to_string(names.size()) + " of " + std::to_string(reviewers);
}

bool is_accepted(const ReviewedEdit& edit, std::size_t reviewers) {
    const auto accepts = std::ranges::count_if(edit.verdicts, [](const GivenVerdict& given) {
        return !given.outdated && given.verdict == Verdict::Accept;
    });
    return edit.status == ReviewStatus::Accepted && static_cast<std::size_t>(accepts) >= reviewers;
}

/// \throw InvalidInput unless the verdicts are of this project's record
void check_origin(const VerdictFile& file, const std::string& name, const Session& session) {
    const ProjectFile& project = session.project();
    if (file.project != project.id())
        throw InvalidInput(name + ".project.id is another project's, " +
                           shortened(printable(file.project_name)) + ": import it there");
    const History& history = *session.snapshot()->history;
    for (std::size_t i = 0; i < file.edits.size(); ++i)
        if (!history.edits().contains(file.edits[i].edit))
            throw InvalidInput(
                name + ".edits[" + std::to_string(i) + "].edit: this project has no revision " +
                std::to_string(file.edits[i].edit.revision) + " of edit " +
                std::to_string(file.edits[i].edit.id) + "; the verdicts are of another copy of it");
    if (!project.has_entry(file.chain_head))
        throw InvalidInput(name +
                           ".chain_head is no entry of this project's record: the verdicts are of "
                           "another copy of it, or its record was rewritten ('audit --against' "
                           "says more)");
}

std::string facts_of(const VerdictFile& file) {
    nlohmann::ordered_json edits = nlohmann::ordered_json::object();
    for (const EditVerdict& verdict : file.edits)
        edits[std::to_string(verdict.edit.id) + "." + std::to_string(verdict.edit.revision)] =
            to_string(verdict.verdict);
    return text_from_json({{"reviewer", file.reviewer},
                           {"role", file.role},
                           {"written", file.written},
                           {"chain_head", file.chain_head},
                           {"overall", to_string(file.overall)},
                           {"edits", edits}});
}

/// \param name of the verdicts in error texts
ImportedVerdicts enter(Session& session, VerdictFile verdicts, const std::string& name) {
    ImportedVerdicts done{.verdicts = std::move(verdicts)};
    check_origin(done.verdicts, name, session);
    const std::string text = text_of(done.verdicts);
    done.known = !session.add_verdicts(
        text, sha256(text),
        {.kind = "verdicts", .subject = done.verdicts.reviewer, .facts = facts_of(done.verdicts)});
    std::set<std::string> now;
    for (const LogEntry& entry : session.log()) now.insert(edit_hash(session.project(), entry));
    done.outdated = static_cast<std::size_t>(
        std::ranges::count_if(done.verdicts.edits, [&](const EditVerdict& verdict) {
            return verdict.verdict != Verdict::None && !now.contains(verdict.hash);
        }));
    return done;
}

/// \param said verdicts, to which time, reviewer and origin are added
ImportedVerdicts enter_now(Session& session, const Reviewer& reviewer, VerdictFile said) {
    const ProjectFile& project = session.project();
    said.program = version();
    said.project = project.id();
    said.project_name = project.name();
    said.chain_head = project.record_head();
    said.reviewer = reviewer.name;
    said.role = reviewer.role;
    said.written = utc_now();
    for (EditVerdict& verdict : said.edits) verdict.time = said.written;
    const std::string name = "the verdict";
    return enter(session, verdicts_from_text(text_of(said), name), name);
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
    return sha256(
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
    return review_of(session.project(), session.log());
}

Review review_of(const Session& session, const std::string& variant) {
    return review_of(session.project(), session.log(variant));
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
    const std::set<std::string> names = accepting(review);
    if (status == ReviewStatus::Accepted)
        return printable("accepted by " +
                         joined(std::vector<std::string>(names.begin(), names.end())));
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

std::string imported_words(const ImportedVerdicts& imported) {
    const std::string by = printable(imported.verdicts.reviewer);
    if (imported.known) return "these verdicts of " + by + " are entered already";
    std::string words = counted(imported.verdicts.edits.size(), "verdict") + " of " + by;
    if (imported.outdated > 0)
        words += ", " + std::to_string(imported.outdated) + " of them on what has changed since";
    return words;
}

ImportedVerdicts import_verdicts(Session& session, const std::filesystem::path& file) {
    return enter(session, verdicts_from_file(file), bare_name(file));
}

ImportedVerdicts enter_verdict(Session& session, const Reviewer& reviewer, EditVerdict verdict) {
    return enter_now(session, reviewer, {.edits = {std::move(verdict)}});
}

ImportedVerdicts enter_overall(Session& session, const Reviewer& reviewer, const Review& seen,
                               Verdict verdict, const std::string& comment) {
    VerdictFile said{.overall = verdict, .overall_comment = comment};
    for (const ReviewedEdit& edit : seen.edits)
        said.edits.push_back({.edit = edit.edit, .hash = edit.hash});
    return enter_now(session, reviewer, std::move(said));
}

}  // namespace vesselbench
