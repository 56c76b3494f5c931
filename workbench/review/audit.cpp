#include "workbench/review/audit.h"

#include <algorithm>
#include <utility>

#include "geometry/kernel/bare_name.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/printable.h"
#include "geometry/kernel/wording.h"
#include "workbench/project/project.h"
#include "workbench/review/statement.h"
#include "workbench/review/witness.h"

namespace vesselbench {

namespace {

Diagnostic finding(std::string code, std::map<std::string, std::string> words) {
    return {.code = std::move(code), .severity = Severity::Error, .words = std::move(words)};
}

/// Of `all`, those that a record does not contradict are verified.
void check_witnesses(const std::vector<Witness>& all, Audit& audit) {
    const std::vector<Diagnostic> found = contradictions_of(all, audit.record);
    audit.findings.insert(audit.findings.end(), found.begin(), found.end());
    for (const Witness& witness : all)
        if (const std::int64_t seen = entry_seen(witness, audit.record);
            seen > 0 && witness.project == audit.record.project)
            audit.verified.push_back(witness.name + ": " + witness.who +
                                     " saw the record up to entry " + std::to_string(seen) +
                                     ", and it still is what it was");
}

/// In the files and lines that were given.
std::vector<Witness> given_witnesses(const std::vector<std::string>& given,
                                     const RecordCheck& record) {
    std::vector<Witness> list;
    for (const std::string& one : given)
        for (Witness& witness : witnesses_in(one, record)) list.push_back(std::move(witness));
    return list;
}

void check_signatures(const std::vector<EnteredVerdicts>& entered, Audit& audit) {
    for (const auto& [verdicts, signature, key] : entered) {
        ++audit.signatures[signature.state];
        const std::string of = printable(verdicts.reviewer) + ", " + verdicts.written;
        if (signature.state == SignatureState::Verified)
            audit.verified.push_back("verdicts in the project: those of " + of + ", are " +
                                     printable(signature_words(signature)));
        if (signature.state == SignatureState::Invalid)
            audit.findings.push_back(finding(
                "signature-invalid", {{"reviewer", of}, {"reason", printable(signature.problem)}}));
    }
}

void check_replay(Session& session, Audit& audit, const Progress& progress) {
    std::size_t same = 0;
    for (const ReplayEntry& entry : session.replay(progress)) {
        const std::string name =
            "edit " + std::to_string(entry.edit.id) + " " + printable(entry.operation);
        if (!entry.differences.empty())
            audit.findings.push_back(
                finding("replay-differs",
                        {{"name", name}, {"differences", joined(entry.differences, "; ")}}));
        else if (entry.replayed)
            ++same;
        else
            audit.unverified.push_back(name + " was not replayed: " + entry.note);
    }
    audit.verified.push_back(counted(same, "edit") + " of the current state " +
                             (same == 1 ? "gives its" : "give their") + " stored result again");
}

/// Of whom only the name is known.
void add_unknown_people(Audit& audit) {
    const std::size_t unsigned_files = audit.signatures[SignatureState::None],
                      unverified = audit.signatures[SignatureState::Unverified],
                      invalid = audit.signatures[SignatureState::Invalid],
                      verified = audit.signatures[SignatureState::Verified];
    if (unverified + invalid + verified == 0) {
        audit.unverified.emplace_back(
            "who authors and reviewers are: names are as they were given, and nothing is signed");
        return;
    }
    audit.unverified.emplace_back("who authors are: names are as they were given");
    if (unsigned_files > 0)
        audit.unverified.push_back("who gave " + counted(unsigned_files, "file") +
                                   " of verdicts that " + (unsigned_files == 1 ? "is" : "are") +
                                   " not signed");
    if (unverified > 0)
        audit.unverified.push_back("who signed " + counted(unverified, "file") +
                                   " of verdicts: --signers verifies the signatures");
}

/// What a record of this kind cannot show.
void add_limits(const AuditOptions& options, Audit& audit) {
    const RecordCheck& record = audit.record;
    if (!record.entries.empty() && record.entries.front().kind == "found")
        audit.unverified.push_back("what happened before " + record.entries.front().time +
                                   ": the record begins with what was found in the project then");
    if (record.referenced > 0)
        audit.unverified.push_back(
            counted(record.referenced, "image") +
            " kept outside the project: only the SHA-256 of what was read is in it");
    if (!options.replay)
        audit.unverified.emplace_back(
            "that the operations give the stored results: --replay runs them again");
    if (options.against.empty())
        audit.unverified.emplace_back(
            "that the record was not rewritten from some entry on, or its end cut off: --against "
            "compares it with reviewers' files, an older copy, or a line of --witness");
    add_unknown_people(audit);
}

void add_dropped(const Session& session, Audit& audit) {
    const auto dropped =
        std::ranges::count_if(session.snapshot()->history->results(),
                              [](const auto& result) { return result.second.dropped; });
    if (dropped > 0)
        audit.unverified.push_back(counted(static_cast<std::size_t>(dropped), "result") +
                                   " dropped by 'compact'");
}

/// What needs the project's contents, whose rows may be damaged.
void read_project(const AuditOptions& options, Audit& audit, const Progress& progress) {
    try {
        Session session = Session::open(
            options.project, {.find = options.find, .worker = options.worker, .only_reads = true});
        const std::vector<EnteredVerdicts> entered =
            entered_verdicts(session.project(), options.signers, progress);
        check_witnesses(witnesses_of(entered), audit);
        check_signatures(entered, audit);
        audit.statement =
            statement_of(session, review_of(session.project(), session.log(), entered),
                         audit.record.entries, options.find);
        add_dropped(session, audit);
        if (options.replay) check_replay(session, audit, progress);
    } catch (const InvalidInput& error) {
        audit.findings.push_back(finding("record-unreadable", {{"reason", error.what()}}));
    }
}

}  // namespace

Audit audit(const AuditOptions& options, const Progress& progress) {
    Audit made{.project = bare_name(options.project)};
    const double until = options.replay ? 0.3 : 1.0;
    made.record = ProjectFile::open_to_read(options.project, "it is audited")
                      .check_record(progress.part(0.0, until));
    made.findings = made.record.findings;
    if (made.findings.empty())
        made.verified.push_back(counted(made.record.entries.size(), "entry", "entries") + " and " +
                                counted(made.record.rows, "stored row") +
                                " agree, and all stored data have their checksums");
    check_witnesses(given_witnesses(options.against, made.record), made);
    read_project(options, made, progress.part(until, 1.0));
    add_limits(options, made);
    return made;
}

}  // namespace vesselbench
