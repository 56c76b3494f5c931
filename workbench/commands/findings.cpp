#include <iostream>
#include <map>
#include <span>

#include <nlohmann/json.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/printable.h"
#include "geometry/kernel/wording.h"
#include "workbench/case/diagnostic_words.h"
#include "workbench/case/json_text.h"
#include "workbench/case/shell_text.h"
#include "workbench/commands/commands.h"
#include "workbench/commands/console/console.h"
#include "workbench/commands/console/messages.h"
#include "workbench/findings/detectors.h"
#include "workbench/findings/find_findings.h"
#include "workbench/findings/question.h"
#include "workbench/findings/treatment.h"
#include "workbench/operations/table.h"
#include "workbench/prepare/prepared_purposes.h"
#include "workbench/report/log_json.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

std::string percent(double share) {
    return formatted(100.0 * share, "%.0f %%");
}

std::string treatment_text(const Finding& finding) {
    if (finding.treatment() == nullptr) return "-";
    return finding.asks() ? "a question" : finding.treatment()->operation;
}

/// Why the operations that treat findings are refused, by id; absent: not refused, or not tried.
using Refusals = std::map<std::string, std::string>;

Refusals refusals_of(Session& session, std::span<const Finding> findings,
                     const std::string& variant, const Progress& progress) {
    Refusals refusals;
    for (const Finding& finding : findings)
        if (const std::string why = refusal_of(session, finding, variant, progress); !why.empty())
            refusals[finding.id()] = why;
    return refusals;
}

void print_refusals(const Refusals& refusals) {
    for (const auto& [id, why] : refusals)
        std::cout << "\n" << id << " cannot be treated: " << why << "\n";
}

void print_rows(std::span<const Finding> findings, const Refusals& refusals) {
    std::vector<std::vector<std::string>> rows = {
        {"finding", "what", "certainty", "size [mm]", "treated by", "evidence"}};
    for (const Finding& finding : findings)
        rows.push_back({finding.id(), title_of(finding), percent(finding.certainty),
                        formatted(2.0 * finding.size),
                        refusals.contains(finding.id()) ? "refused" : treatment_text(finding),
                        worded(finding.evidence)});
    std::cout << as_columns(rows);
}

/// What the findings may be, and how each is answered.
void print_questions(std::span<const Finding> findings, const Refusals& refusals,
                     const std::string& project) {
    const std::string call = "vesselbench findings " + shell_quoted(project);
    for (const Finding& finding : findings) {
        if (!finding.asks()) continue;
        std::cout << "\n" << title_of(finding) << "  " << certainty_words(finding) << "\n";
        for (const Reading& reading : finding.readings)
            std::cout << "  " << reading_words(reading) << "\n";
        std::cout << "  keep it: " << call << " --keep " << finding.id() << "\n";
        if (const Reading* artefact = artefact_reading(finding);
            finding.treatment() != nullptr && !refusals.contains(finding.id()))
            std::cout << "  answer \"" << artefact->name << "\": " << call << " --apply "
                      << finding.id() << " --as " << artefact->key << "\n";
    }
}

/// Those that are listed.
std::span<const Finding> listed(const std::vector<Finding>& findings,
                                const FindingsArguments& arguments) {
    const bool all = arguments.all || arguments.json;
    return std::span(findings).first(all ? findings.size() : listed_count(findings));
}

void print_open(const std::vector<Finding>& findings, const Refusals& refusals,
                const FindingsArguments& arguments) {
    if (findings.empty()) return void(std::cout << "nothing was found\n");
    const std::span<const Finding> shown = listed(findings, arguments);
    if (!shown.empty()) print_rows(shown, refusals);
    print_questions(shown, refusals, arguments.project);
    print_refusals(refusals);
    if (const std::size_t folded = findings.size() - shown.size(); folded > 0)
        std::cout << (shown.empty() ? "" : "\n") << folded_words(folded, !shown.empty())
                  << ": --all lists them\n";
}

/// With what was tried: "refusal", null where the operation is not refused.
Json tried_json(Json findings, const Refusals& refusals) {
    for (Json& finding : findings["findings"]) {
        const auto refusal = refusals.find(finding["id"].get<std::string>());
        finding["refusal"] = refusal == refusals.end() ? Json(nullptr) : Json(refusal->second);
    }
    return findings;
}

void print_dismissed(const std::vector<DismissedFinding>& dismissed) {
    if (dismissed.empty()) return;
    std::vector<std::vector<std::string>> rows = {{"dismissed", "by", "time", "reason"}};
    for (const auto& [dismissal, finding] : dismissed)
        rows.push_back({finding ? finding->id() : dismissal.id() + " (no longer found)",
                        dismissal.author, dismissal.time, dismissal.reason});
    std::cout << "\n" << as_columns(rows);
}

/// \throw UsageError if the model has no such finding
const Finding& finding_meant(const std::vector<Finding>& findings, const std::string& id) {
    const Finding* finding = finding_of_id(findings, id);
    if (finding == nullptr)
        throw UsageError("the model has no finding " + shortened(printable(id)) +
                         "; 'vesselbench findings' lists those it has");
    return *finding;
}

void print_treated(const LogEntry& entry, const FindingsArguments& arguments) {
    if (entry.result)
        for (const Diagnostic& warning : entry.result->warnings)
            warn(worded(warning, {.project = arguments.project}));
    if (arguments.json)
        std::cout << text_from_json(log_json(entry), 2) << "\n";
    else
        std::cout << "edit " << entry.edit.edit.id << ": " << entry.edit.operation << "\n";
}

/// The reason that is given; of a question that is kept without one, what it asked.
std::string reason_for(const Finding& finding, const FindingsArguments& arguments) {
    if (arguments.kept.empty() || !arguments.reason.empty()) return arguments.reason;
    if (finding.asks()) return kept_reason(finding);
    throw UsageError("say with --reason why " + finding.id() + " is kept");
}

void keep_one(const FindingsArguments& arguments, const FindingSearch& search) {
    const bool kept = !arguments.kept.empty();
    const Finding& finding =
        finding_meant(search.findings, kept ? arguments.kept : arguments.dismissed);
    dismiss(arguments.project, search, finding, reason_for(finding, arguments));
    if (!arguments.json) std::cout << (kept ? "kept: " : "dismissed: ") << finding.id() << "\n";
}

void restore_one(const FindingsArguments& arguments) {
    const auto restored = restore(arguments.project, arguments.restored);
    if (!restored) throw UsageError(shortened(arguments.restored) + " is not dismissed");
    if (!arguments.json) std::cout << "restored: " << restored->id() << "\n";
}

void check(const FindingsArguments& arguments) {
    if (!arguments.dismissed.empty() && arguments.reason.empty())
        throw UsageError("--dismiss and --reason are given together");
    if (!arguments.reason.empty() && arguments.dismissed.empty() && arguments.kept.empty())
        throw UsageError("--reason says why something is kept: give --keep or --dismiss, too");
    if (!arguments.taken_as.empty() && arguments.applied.empty())
        throw UsageError("--as answers a finding that is applied: give --apply, too");
}

}  // namespace

void show_findings(const FindingsArguments& arguments, const Progress& progress) {
    check(arguments);
    Session session = Session::open(arguments.project, {.find = find_operation});
    const std::string variant =
        variant_of(arguments.project, arguments.variant, *session.snapshot()->history);
    const Scene scene = session.scene(variant, progress.part(0.0, 0.3));
    const FindingSearch found =
        find_findings(scene, stated_ends(session.log(variant)), progress.part(0.3, 1.0));
    if (!arguments.applied.empty())
        return print_treated(treat(session, finding_meant(found.findings, arguments.applied),
                                   arguments.taken_as, variant, progress),
                             arguments);
    const bool keeps = !arguments.dismissed.empty() || !arguments.kept.empty();
    if (keeps) keep_one(arguments, found);
    if (!arguments.restored.empty()) restore_one(arguments);
    const JudgedFindings findings = judged(found, stored_dismissals(arguments.project));
    Refusals refusals;
    if (arguments.tried)
        refusals = refusals_of(session, listed(findings.open, arguments), variant, progress);
    if (arguments.json) {
        Json json = {{"project", session.project().name()}, {"variant", variant}};
        const Json found_json = findings_json(findings);
        json.update(arguments.tried ? tried_json(found_json, refusals) : found_json);
        std::cout << text_from_json(json, 2) << "\n";
    } else if (!keeps && arguments.restored.empty()) {
        print_open(findings.open, refusals, arguments);
        print_dismissed(findings.dismissed);
        for (const std::string& line : not_searched_lines(findings.not_searched))
            std::cout << line << "\n";
    }
}

}  // namespace vesselbench
