#include "workbench/batch/table_page.h"

#include <algorithm>
#include <vector>

#include "geometry/kernel/wording.h"
#include "workbench/batch/case_report.h"
#include "workbench/batch/page_parts.h"
#include "workbench/batch/page_texts.h"
#include "workbench/case/purposes.h"
#include "workbench/report/base64.h"
#include "workbench/report/rendered_template.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

std::string summary_of(const BatchTable& table) {
    std::string text = counted(table.rows.size(), "case");
    for (const CaseState state :
         {CaseState::Done, CaseState::DoneByHand, CaseState::Failed, CaseState::NotRun})
        if (const std::size_t count = table.count(state); count > 0)
            text += (text.find(':') == std::string::npos ? ": " : ", ") + std::to_string(count) +
                    " " + to_string(state);
    return text + ".";
}

/// Those that at least one case has.
std::vector<TableFigure> figures_in(const BatchTable& table) {
    std::vector<TableFigure> figures;
    for (const TableFigure& figure : table_figures())
        if (std::ranges::any_of(table.rows, [&](const TableRow& row) {
                return row.figures.contains(figure.name) && !row.figures[figure.name].is_null();
            }))
            figures.push_back(figure);
    return figures;
}

Json figures_json(const TableRow& row, const std::vector<TableFigure>& figures) {
    Json cells = Json::array();
    for (const TableFigure& figure : figures) {
        const Json value = row.figures.value(figure.name, Json());
        const std::string format = "%." + std::to_string(figure.digits) + "f";
        cells.push_back(
            {{"value", value.is_null() ? "" : value.dump()},
             {"text", value.is_null() ? "" : formatted(value.get<double>(), format.c_str())}});
    }
    return cells;
}

std::string with_dashes(std::string text) {
    for (char& letter : text)
        if (letter == ' ') letter = '-';
    return text;
}

Json row_json(const TableRow& row, const std::vector<TableFigure>& figures) {
    const bool has_report = row.state == CaseState::Done || row.state == CaseState::DoneByHand;
    return {{"name", row.name},
            {"link", or_false(has_report ? "cases/" + row.name + "/report.html" : "")},
            {"input", row.input},
            {"thumbnail", or_false(base64(row.thumbnail))},
            {"state", to_string(row.state)},
            {"state_class", with_dashes(to_string(row.state))},
            {"failure", or_false(row.failure ? row.failure->code : "")},
            {"review", row.review},
            {"warning_count", has_report ? std::to_string(row.warnings.size()) : ""},
            {"warning_codes", joined(row.warning_codes)},
            {"any_warnings", !row.warnings.empty()},
            {"warnings", row.warnings},
            {"not_met", joined(row.not_met)},
            {"findings", has_report ? std::to_string(row.findings) : ""},
            {"figures", figures_json(row, figures)}};
}

}  // namespace

std::string table_page(const BatchTable& table) {
    const auto& texts = batch_page_texts();
    const std::string &script = texts.at("table.js"), &style = texts.at("table.css");
    Json page = {
        {"title", "Cases prepared for " + table.purpose + ": " + find_purpose(table.purpose).title},
        {"summary", summary_of(table)},
        {"questions", or_false(table.questions > 0 ? counted(table.questions, "question") : "")},
        {"script_hash", source_hash(script)},
        {"style_hash", source_hash(style)},
        {"script", script},
        {"style", style},
        {"any_failures", !table.failures.empty()},
        {"failures", Json::array()},
        {"columns", Json::array()},
        {"rows", Json::array()}};
    for (const FailureGroup& group : table.failures)
        page["failures"].push_back({{"code", group.code},
                                    {"count", counted(group.cases.size(), "case")},
                                    {"cases", joined(group.cases)},
                                    {"text", group.text},
                                    {"any_remedies", !group.remedies.empty()},
                                    {"remedies", group.remedies}});
    const std::vector<TableFigure> figures = figures_in(table);
    for (const TableFigure& figure : figures)
        page["columns"].push_back({{"title", figure.title}, {"unit", or_false(figure.unit)}});
    for (const TableRow& row : table.rows) page["rows"].push_back(row_json(row, figures));
    return rendered_template(texts.at("table.html"), page);
}

}  // namespace vesselbench
