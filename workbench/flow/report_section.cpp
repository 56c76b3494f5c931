#include "workbench/flow/report_section.h"

#include <filesystem>

#include <nlohmann/json.hpp>

#include "geometry/kernel/pending_files.h"
#include "geometry/kernel/whole_file.h"
#include "geometry/kernel/wording.h"
#include "workbench/case/json_text.h"
#include "workbench/flow/methods_text.h"
#include "workbench/flow/results_json.h"
#include "workbench/report/base64.h"
#include "workbench/report/rendered_template.h"
#include "workbench/report/report_template.h"

namespace vesselbench {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kReportPage = "report.html";
constexpr const char* kReportDocument = "report.json";
constexpr const char* kFlowKey = "flow_results";

/// The section's place in the page.
constexpr const char* kSectionBegin = "<!-- flow results -->";
constexpr const char* kSectionEnd = "<!-- end of flow results -->";

Json section_texts(const FlowResults& results, const std::vector<ReportPicture>& pictures) {
    Json figures = Json::array(), openings = Json::array(), gallery = Json::array();
    for (const FlowFigure& figure : flow_figures(results))
        figures.push_back({{"name", figure.name + " [" + figure.unit + "]"},
                           {"value", formatted(figure.value, "%.4g")},
                           {"definition", figure.definition}});
    for (const OpeningFigures& opening : results.openings)
        openings.push_back({{"name", opening.recorded.name},
                            {"kind", to_string(opening.recorded.kind)},
                            {"flow", formatted(opening.flow, "%.4g")},
                            {"pressure", formatted(opening.pressure, "%.4g")}});
    for (const ReportPicture& picture : pictures)
        gallery.push_back({{"title", picture.title}, {"png", base64(picture.png)}});
    return {{"figures", figures},
            {"openings", openings},
            {"pictures", gallery},
            {"steady", !results.cycle},
            {"pulsatile", results.cycle.has_value()},
            {"not_converged", !results.converged},
            {"methods", methods_text(results)},
            {"references", method_references(results)}};
}

/// The page with another section; the page itself if it has no place for one.
std::string with_section(const std::string& page, const std::string& section) {
    const std::size_t begin = page.find(kSectionBegin), end = page.find(kSectionEnd);
    if (begin == std::string::npos || end == std::string::npos || end < begin) return page;
    return page.substr(0, begin) + kSectionBegin + "\n" + section + page.substr(end);
}

}  // namespace

void add_flow_section(const FlowResults& results, const std::vector<ReportPicture>& pictures) {
    const fs::path page = results.flow.prepared / kReportPage,
                   document = results.flow.prepared / kReportDocument;
    if (!fs::is_regular_file(page) || !fs::is_regular_file(document)) return;
    Json report = json_from_text(file_content(document), kReportDocument, kLargestStoredJson);
    if (!report.is_object()) return;
    report[kFlowKey] = results_json(results);
    const std::string section = rendered_template(report_templates().at("flow_section.html"),
                                                  section_texts(results, pictures));
    PendingFiles files;
    files.add_mark(page, with_section(file_content(page), section));
    files.add_mark(document, text_from_json(printable_json(std::move(report)), 2) + "\n");
    files.commit();
}

}  // namespace vesselbench
