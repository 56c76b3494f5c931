#include "workbench/review/record_gate.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/printable.h"
#include "workbench/project/project.h"
#include "workbench/project/record_check.h"
#include "workbench/review/signature.h"
#include "workbench/review/witness.h"

namespace vesselbench {

namespace {

constexpr const char* kAcceptanceAsked = "acceptance";

bool knows_review(const std::vector<ChainEntry>& entries) {
    return std::ranges::any_of(entries, [](const ChainEntry& entry) {
        return entry.kind == kVerdictsEntered || entry.kind == kAcceptanceAsked ||
               entry.kind == kKeyRetired;
    });
}

/// Everything that contradicts the record; what reviewers saw of it is read only from a sound one.
std::vector<Diagnostic> contradictions_in(const ProjectFile& project, const RecordCheck& check) {
    if (!check.findings.empty()) return check.findings;
    return contradictions_of(witnesses_of(entered_verdicts(project, check.entries)), check);
}

[[noreturn]] void refuse_review(std::vector<Diagnostic> contradictions) {
    contradictions.insert(contradictions.begin(), {.code = "record-contradicted"});
    throw DiagnosedFailure(std::move(contradictions));
}

}  // namespace

void require_sound_record(const Session& session, std::size_t reviewers) {
    const RecordCheck check = session.project().check_record_rows();
    std::vector<Diagnostic> found = contradictions_in(session.project(), check);
    if (found.empty() || (reviewers == 0 && !knows_review(check.entries))) return;
    refuse_review(std::move(found));
}

void require_signed_bytes(const ProjectFile& project, const std::vector<EnteredVerdicts>& entered,
                          const Progress& progress) {
    const std::vector<StoredVerdicts> stored = project.verdicts();
    std::vector<Diagnostic> found;
    for (std::size_t i = 0; i < entered.size(); ++i) {
        if (entered[i].signature.state != SignatureState::Invalid) continue;
        const Signature bytes = checked_signature(stored.at(i), progress);
        if (bytes.state == SignatureState::Invalid)
            found.push_back({.code = "signature-invalid",
                             .severity = Severity::Error,
                             .words = {{"reviewer", printable(entered[i].verdicts.reviewer)},
                                       {"reason", printable(bytes.problem)}}});
    }
    if (!found.empty()) refuse_review(std::move(found));
}

}  // namespace vesselbench
