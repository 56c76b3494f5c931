#include "workbench/batch/batch_table.h"

#include <algorithm>
#include <functional>
#include <map>
#include <string_view>

#include "geometry/kernel/bare_name.h"
#include "geometry/kernel/printable.h"
#include "geometry/kernel/wording.h"
#include "workbench/batch/case_report.h"
#include "workbench/batch/run_case.h"
#include "workbench/case/csv_text.h"
#include "workbench/case/listed_finding.h"

namespace vesselbench {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::vector<std::string> texts_in(const Json& report, const char* list) {
    std::vector<std::string> texts;
    const auto found = report.find(list);
    if (found != report.end() && found->is_array())
        for (const Json& text : *found)
            if (text.is_string()) texts.push_back(text.get<std::string>());
    return texts;
}

/// The texts under a key of a list's objects, each once.
std::vector<std::string> words_in(const Json& report, const char* list, const char* key,
                                  const std::function<bool(const Json&)>& wanted) {
    std::vector<std::string> words;
    const auto found = report.find(list);
    if (found == report.end() || !found->is_array()) return words;
    for (const Json& one : *found)
        if (one.is_object() && one.contains(key) && one[key].is_string() && wanted(one))
            if (const auto word = one[key].get<std::string>(); std::ranges::count(words, word) == 0)
                words.push_back(word);
    return words;
}

void add_report(TableRow& row, const Json& report) {
    const auto any = [](const Json&) { return true; };
    const auto not_met = [](const Json& one) {
        return one.contains("judgement") && one["judgement"] == "not met";
    };
    row.warnings = texts_in(report, "warnings");
    row.warning_codes = words_in(report, "diagnostics", "code", any);
    row.not_met = words_in(report, "requirements", "requirement", not_met);
    if (const auto findings = report.find("findings");
        findings != report.end() && findings->is_array())
        row.findings =
            static_cast<std::size_t>(std::ranges::count_if(*findings, is_listed_finding));
    for (const TableFigure& figure : table_figures())
        row.figures[figure.name] = figure_in(report, figure);
}

/// The name that the case's reports have: a given one replaces those of files.
std::string input_name(const BatchCase& one) {
    const auto given = std::ranges::find(one.values, "name", &CaseValue::option);
    return given == one.values.end() ? bare_name(one.input) : given->text;
}

TableRow row_of(const PlannedCase& one, const BatchOptions& options) {
    const fs::path folder = options.folders.of(one.what.name);
    TableRow row{.name = one.what.name,
                 .input = input_name(one.what),
                 .state = CaseState::NotRun,
                 .review = {},
                 .warnings = {},
                 .warning_codes = {},
                 .not_met = {},
                 .findings = 0,
                 .figures = Json::object(),
                 .failure = {},
                 .thumbnail = {}};
    if (!one.record) return row;
    const Json report = read_report(folder);
    row.review = review_state(folder, options.purpose);
    if (!report.is_null()) {
        row.state = one.record->failure ? CaseState::DoneByHand : CaseState::Done;
        add_report(row, report);
        row.thumbnail = content_if_any(folder / kThumbnail);
    } else {
        row.state = CaseState::Failed;
        row.failure = one.record->failure.value_or(
            CaseFailure{"no-report", "its report.json is missing or damaged", {"--retry"}});
    }
    return row;
}

std::vector<FailureGroup> failure_groups(const std::vector<TableRow>& rows) {
    std::map<std::string, FailureGroup> by_code;
    for (const TableRow& row : rows) {
        if (!row.failure) continue;
        FailureGroup& group = by_code[row.failure->code];
        if (group.cases.empty()) group.text = row.failure->text;
        group.code = row.failure->code;
        group.cases.push_back(row.name);
        for (const std::string& remedy : row.failure->remedies)
            if (std::ranges::count(group.remedies, remedy) == 0) group.remedies.push_back(remedy);
    }
    std::vector<FailureGroup> groups;
    for (auto& [code, group] : by_code) groups.push_back(std::move(group));
    std::ranges::stable_sort(
        groups, [](const auto& a, const auto& b) { return a.cases.size() > b.cases.size(); });
    return groups;
}

/// Spreadsheets run what begins like a formula, and show what reorders a line.
std::string text_field(const std::string& given) {
    constexpr std::string_view kFormula = "=+-@\t";
    std::string text = printable(given);
    if (!text.empty() && kFormula.find(text.front()) != std::string_view::npos) text.insert(0, "'");
    return csv_quoted(text);
}

std::string csv_line(const std::vector<std::string>& fields) {
    return joined(fields, ",") + "\r\n";
}

std::string number_field(const Json& figure) {
    return figure.is_null() ? "" : figure.dump();
}

std::vector<std::string> csv_fields(const TableRow& row) {
    const CaseFailure failure = row.failure.value_or(CaseFailure{});
    std::vector<std::string> fields = {text_field(row.name),
                                       text_field(row.input),
                                       to_string(row.state),
                                       text_field(row.review),
                                       std::to_string(row.warnings.size()),
                                       text_field(joined(row.warning_codes, "; ")),
                                       std::to_string(row.findings),
                                       text_field(joined(row.not_met, "; "))};
    for (const TableFigure& figure : table_figures())
        fields.push_back(number_field(row.figures.value(figure.name, Json())));
    fields.push_back(text_field(failure.code));
    fields.push_back(text_field(failure.text));
    fields.push_back(text_field(joined(failure.remedies, "; ")));
    return fields;
}

Json row_json(const TableRow& row) {
    Json json = {{"case", row.name},
                 {"input", row.input},
                 {"state", to_string(row.state)},
                 {"review", row.review},
                 {"warnings", row.warnings},
                 {"warning_codes", row.warning_codes},
                 {"findings", row.findings},
                 {"requirements_not_met", row.not_met},
                 {"figures", row.figures}};
    if (row.failure)
        json["failure"] = {{"code", row.failure->code},
                           {"text", row.failure->text},
                           {"remedies", row.failure->remedies}};
    return json;
}

}  // namespace

std::string to_string(CaseState state) {
    return state == CaseState::NotRun   ? "not run"
           : state == CaseState::Done   ? "done"
           : state == CaseState::Failed ? "failed"
                                        : "done by hand";
}

std::size_t BatchTable::count(CaseState state) const {
    return static_cast<std::size_t>(std::ranges::count(rows, state, &TableRow::state));
}

BatchTable batch_table(const std::vector<PlannedCase>& cases, const BatchOptions& options) {
    BatchTable table{.purpose = options.purpose, .rows = {}, .failures = {}};
    for (const PlannedCase& one : cases) table.rows.push_back(row_of(one, options));
    table.failures = failure_groups(table.rows);
    return table;
}

std::string table_csv(const BatchTable& table) {
    std::vector<std::string> header = {
        "case",     "input",         "state",    "review",
        "warnings", "warning_codes", "findings", "requirements_not_met"};
    for (const TableFigure& figure : table_figures()) header.push_back(figure.name);
    for (const char* name : {"failure_code", "failure", "remedies"}) header.emplace_back(name);
    std::string text = csv_line(header);
    for (const TableRow& row : table.rows) text += csv_line(csv_fields(row));
    return text;
}

Json table_json(const BatchTable& table) {
    Json rows = Json::array(), failures = Json::array();
    for (const TableRow& row : table.rows) rows.push_back(row_json(row));
    for (const FailureGroup& group : table.failures)
        failures.push_back({{"code", group.code},
                            {"cases", group.cases},
                            {"text", group.text},
                            {"remedies", group.remedies}});
    return {{"purpose", table.purpose}, {"cases", rows}, {"failures", failures}};
}

}  // namespace vesselbench
