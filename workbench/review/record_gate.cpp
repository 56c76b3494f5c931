#include "workbench/review/record_gate.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "geometry/kernel/diagnosed_error.h"
#include "workbench/project/project.h"
#include "workbench/project/record_check.h"

namespace vesselbench {

namespace {

// Kinds of a record's entries.
constexpr const char* kVerdictsEntered = "verdicts";
constexpr const char* kAcceptanceAsked = "acceptance";

bool knows_review(const std::vector<ChainEntry>& entries) {
    return std::ranges::any_of(entries, [](const ChainEntry& entry) {
        return entry.kind == kVerdictsEntered || entry.kind == kAcceptanceAsked;
    });
}

}  // namespace

void require_sound_record(const Session& session, std::size_t reviewers) {
    RecordCheck check = session.project().check_record_rows();
    if (check.findings.empty() || (reviewers == 0 && !knows_review(check.entries))) return;
    std::vector<Diagnostic> contradictions = std::move(check.findings);
    contradictions.insert(contradictions.begin(), {.code = "record-contradicted"});
    throw DiagnosedFailure(std::move(contradictions));
}

}  // namespace vesselbench
