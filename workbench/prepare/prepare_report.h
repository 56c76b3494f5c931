#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "meshing/products/cfd_parameters.h"
#include "workbench/prepare/input.h"
#include "workbench/report/report_html.h"
#include "workbench/session/session.h"

namespace vesselbench {

/// The results of prepare, for the report.
struct PreparedCase {
    std::string purpose;  ///< its name
    Input input;
    Scene scene;  ///< the result
    CfdParameters flow;
    std::size_t reviewers = 0;                 ///< who have to accept it; 0: nobody
    std::vector<std::string> products;         ///< names of the files and folders written
    std::vector<std::string> earlier_results;  ///< names of those in the same folder
    std::vector<Diagnostic> warnings;          ///< beside those of the edits
};

struct PreparedReport {
    nlohmann::ordered_json document;  ///< report.json
    std::vector<ReportPicture> pictures;
    std::vector<ReportSection> sections;  ///< those of the edits, in order
    std::vector<Diagnostic> warnings;     ///< all, notes too, as in the document's diagnostics
};

/// Measures before and after, distances to the source and to the exact surface away from the
/// openings, flow, volume mesh; draws the pictures, or warns that OpenGL is not available.
[[nodiscard]] PreparedReport prepare_report(Session& session, const PreparedCase& prepared,
                                            const Progress& progress);

}  // namespace vesselbench
