#include "workbench/review/audit.h"

#include <algorithm>
#include <filesystem>
#include <iostream>

#include "geometry/kernel/pending_files.h"
#include "geometry/kernel/printable.h"
#include "geometry/kernel/wording.h"
#include "workbench/case/diagnostic_words.h"
#include "workbench/case/json_text.h"
#include "workbench/commands/commands.h"
#include "workbench/commands/console/console.h"
#include "workbench/commands/console/messages.h"
#include "workbench/operations/table.h"
#include "workbench/project/utc_time.h"
#include "workbench/review/audit_texts.h"
#include "workbench/review/witness.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

void print_entries(const RecordCheck& record) {
    std::vector<std::vector<std::string>> rows = {
        {"entry", "time", "kind", "subject", "by", "what"}};
    for (const ChainEntry& entry : record.entries)
        rows.push_back({std::to_string(entry.number), entry.time, entry.kind,
                        shortened(printable(entry.subject), 40), entry.author, entry_words(entry)});
    std::cout << as_columns(rows);
}

std::string edit_text(const Json& edit) {
    std::string text = edit["operation"].get<std::string>();
    const auto arguments = edit["arguments"].get<std::string>(),
               effect = edit["effect"].get<std::string>();
    if (!arguments.empty()) text += " " + arguments;
    return text + (effect.empty() ? "" : "; " + effect);
}

/// What reports on patients' models should state, and the edits.
void print_statement(const Json& statement) {
    if (statement.is_null()) return;
    std::vector<std::vector<std::string>> rows = {{"item", "what"}};
    for (const Json& item : statement["items"])
        rows.push_back({item["item"].get<std::string>(), item["text"].get<std::string>()});
    rows.push_back({"review", statement["review"].get<std::string>()});
    for (const Json& edit : statement["edits"])
        rows.push_back(
            {"edit " + edit["edit"].dump() + "." + edit["revision"].dump(), edit_text(edit)});
    std::cout << as_columns(rows) << "\n";
}

void print_list(const std::string& title, const std::vector<std::string>& texts) {
    if (texts.empty()) return;
    std::cout << title << "\n";
    for (const std::string& text : texts) std::cout << as_columns({{"  -", text}});
}

void print_audit(const Audit& audit) {
    std::cout << "record of " << printable(audit.project) << ", project "
              << printable(audit.record.project) << "\n\n";
    print_statement(audit.statement);
    print_entries(audit.record);
    if (!audit.record.entries.empty())
        std::cout << "head " << printable(audit.record.entries.back().hash) << "\n";
    std::cout << "\n";
    print_list("verified:", audit.verified);
    print_list("cannot be verified:", audit.unverified);
    print_list("DOES NOT VERIFY:", worded(audit.findings));
}

/// Nobody should keep the head of a record that the project contradicts.
void print_witness(const Audit& audit) {
    if (audit.findings.empty()) std::cout << witness_line(audit.record, utc_now()) << "\n";
}

std::string what_is_wrong(const std::vector<Diagnostic>& findings) {
    const bool altered = std::ranges::any_of(
        findings, [](const Diagnostic& finding) { return finding.code != "signature-invalid"; });
    return std::string(altered ? "the project is not what its record says: " : "") +
           worded(findings.front()) +
           (findings.size() > 1 ? " (and " + counted(findings.size() - 1, "more finding") + ")"
                                : "");
}

}  // namespace

bool audit_project(const AuditArguments& arguments, const Progress& progress) {
    const Audit made = audit({.project = arguments.project,
                              .against = arguments.against,
                              .signers = arguments.signers,
                              .replay = arguments.replay,
                              .find = find_operation},
                             progress);
    if (!arguments.html.empty()) {
        PendingFiles files;
        files.add_mark(arguments.html, audit_html(made));
        files.commit();
    }
    if (arguments.witness)
        print_witness(made);
    else if (arguments.json)
        std::cout << text_from_json(audit_json(made), 2) << "\n";
    else
        print_audit(made);
    if (made.findings.empty()) return true;
    complain(what_is_wrong(made.findings));
    return false;
}

}  // namespace vesselbench
