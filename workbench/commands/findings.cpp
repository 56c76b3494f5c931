#include <iostream>

#include <nlohmann/json.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/printable.h"
#include "geometry/kernel/wording.h"
#include "workbench/case/diagnostic_words.h"
#include "workbench/case/json_text.h"
#include "workbench/commands/commands.h"
#include "workbench/commands/console/console.h"
#include "workbench/commands/console/messages.h"
#include "workbench/findings/detectors.h"
#include "workbench/findings/find_findings.h"
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

void print_open(const std::vector<Finding>& findings) {
    if (findings.empty()) return void(std::cout << "nothing was found\n");
    std::vector<std::vector<std::string>> rows = {
        {"finding", "certainty", "size [mm]", "treated by", "evidence"}};
    for (const Finding& finding : findings)
        rows.push_back({finding.id(), percent(finding.certainty), formatted(2.0 * finding.size),
                        finding.treatment() != nullptr ? finding.treatment()->operation : "-",
                        worded(finding.evidence)});
    std::cout << as_columns(rows);
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

void print_accepted(const LogEntry& entry, const FindingsArguments& arguments) {
    if (entry.result)
        for (const Diagnostic& warning : entry.result->warnings)
            warn(worded(warning, {.project = arguments.project}));
    if (arguments.json)
        std::cout << text_from_json(log_json(entry), 2) << "\n";
    else
        std::cout << "edit " << entry.edit.edit.id << ": " << entry.edit.operation << "\n";
}

void dismiss_one(const FindingsArguments& arguments, const FindingSearch& search) {
    const Finding& finding = finding_meant(search.findings, arguments.dismissed);
    dismiss(arguments.project, search, finding, arguments.reason);
    if (!arguments.json) std::cout << "dismissed: " << finding.id() << "\n";
}

void restore_one(const FindingsArguments& arguments) {
    const auto restored = restore(arguments.project, arguments.restored);
    if (!restored) throw UsageError(shortened(arguments.restored) + " is not dismissed");
    if (!arguments.json) std::cout << "restored: " << restored->id() << "\n";
}

void check(const FindingsArguments& arguments) {
    if (arguments.reason.empty() != arguments.dismissed.empty())
        throw UsageError("--dismiss and --reason are given together");
}

}  // namespace

void show_findings(const FindingsArguments& arguments, const Progress& progress) {
    check(arguments);
    Session session = Session::open(arguments.project, {.find = find_operation});
    const std::string variant =
        variant_of(arguments.project, arguments.variant, *session.snapshot()->history);
    const Scene scene = session.scene(variant, progress.part(0.0, 0.3));
    const FindingSearch found = find_findings(scene, progress.part(0.3, 1.0));
    if (!arguments.accepted.empty())
        return print_accepted(
            accept(session, finding_meant(found.findings, arguments.accepted), variant, progress),
            arguments);
    if (!arguments.dismissed.empty()) dismiss_one(arguments, found);
    if (!arguments.restored.empty()) restore_one(arguments);
    const JudgedFindings findings = judged(found, stored_dismissals(arguments.project));
    if (arguments.json) {
        Json json = {{"project", session.project().name()}, {"variant", variant}};
        json.update(findings_json(findings));
        std::cout << text_from_json(json, 2) << "\n";
    } else if (arguments.dismissed.empty() && arguments.restored.empty()) {
        print_open(findings.open);
        print_dismissed(findings.dismissed);
        for (const std::string& line : not_searched_lines(findings.not_searched))
            std::cout << line << "\n";
    }
}

}  // namespace vesselbench
