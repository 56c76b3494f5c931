#include "workbench/review/import_checks.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <set>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/printable.h"
#include "workbench/project/project.h"
#include "workbench/project/record_check.h"
#include "workbench/project/utc_time.h"
#include "workbench/review/reviewer_name.h"

namespace vesselbench {

namespace {

/// Clocks of two machines differ by less.
constexpr std::chrono::minutes kAhead{10};

std::string shown_in_quotes(const std::string& text) {
    return "'" + shortened(printable(text)) + "'";
}

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

void check_time(const std::string& time, const std::string& place) {
    if (!is_utc_time(time)) throw InvalidInput(place + " is no time: " + shown_in_quotes(time));
    if (time > utc_text(std::chrono::system_clock::now() + kAhead))
        throw InvalidInput(place + " is in the future: " + shown_in_quotes(time) + "; it is " +
                           utc_now() + " here");
}

void check_times(const VerdictFile& file, const std::string& name) {
    check_time(file.written, name + ".written");
    for (std::size_t i = 0; i < file.edits.size(); ++i)
        check_time(file.edits[i].time, name + ".edits[" + std::to_string(i) + "].time");
}

/// \throw InvalidInput if an eye would take the name for that of another reviewer
void check_reviewer_name(const VerdictFile& file, const std::string& name,
                         std::span<const EnteredVerdicts> entered) {
    const std::string place = name + ".reviewer.name " + shown_in_quotes(file.reviewer);
    if (has_hidden_characters(file.reviewer))
        throw InvalidInput(place + " holds characters that show nothing: give it without them");
    const std::string outline = name_outline(file.reviewer),
                      compared = compared_name(file.reviewer);
    if (outline.empty()) throw InvalidInput(place + " has no letter");
    for (const EnteredVerdicts& one : entered)
        if (const std::string& other = one.verdicts.reviewer;
            name_outline(other) == outline && compared_name(other) != compared)
            throw InvalidInput(place + " is nearly that of a reviewer of this project, " +
                               shown_in_quotes(other) +
                               ": give the same name, or one that nobody mistakes");
}

/// The edits that were in the project when a page was made with this head.
std::set<EditId> edits_known_at(const std::string& head, const std::vector<ChainEntry>& entries) {
    std::set<EditId> edits;
    for (const ChainEntry& entry : entries) {
        if (entry.kind == "edit")
            if (const std::size_t blank = entry.subject.find(' '); blank != std::string::npos)
                edits.insert(std::atoll(entry.subject.c_str() + blank + 1));
        if (entry.hash == head) break;
    }
    return edits;
}

/// True if the file lists every edit of a variant that its page had.
bool lists_all(const VerdictFile& file, const std::vector<LogEntry>& log,
               const std::set<EditId>& known) {
    std::set<EditId> listed;
    for (const EditVerdict& verdict : file.edits) listed.insert(verdict.edit.id);
    return std::ranges::all_of(log, [&](const LogEntry& entry) {
        return !known.contains(entry.edit.edit.id) || listed.contains(entry.edit.edit.id);
    });
}

/// A verdict on the whole that lists some edits only would be outdated from the start.
void check_seen_edits(const VerdictFile& file, const std::string& name, const Session& session) {
    if (file.overall != Verdict::Reject) return;
    const std::set<EditId> known =
        edits_known_at(file.chain_head, session.project().record_entries());
    std::vector<std::string> variants = session.snapshot()->history->variants();
    if (variants.empty()) variants.emplace_back();
    if (std::ranges::none_of(variants, [&](const std::string& variant) {
            return lists_all(file, session.log(variant), known);
        }))
        throw InvalidInput(name +
                           ".overall rejects the whole model, but .edits lists only some of its "
                           "edits: list those that were seen, as the page does");
}

}  // namespace

void check_before_entering(const VerdictFile& file, const std::string& name, const Session& session,
                           std::span<const EnteredVerdicts> entered) {
    check_origin(file, name, session);
    check_times(file, name);
    check_reviewer_name(file, name, entered);
    check_seen_edits(file, name, session);
}

}  // namespace vesselbench
