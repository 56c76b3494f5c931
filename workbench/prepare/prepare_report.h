#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "meshing/products/cfd_parameters.h"
#include "workbench/prepare/input.h"
#include "workbench/report/report_html.h"
#include "workbench/session/session.h"

namespace vesselbench {

/// What prepare made, as far as the report needs it.
struct PreparedCase {
    std::string purpose;  ///< "cfd" or "rp"
    Input input;
    Scene scene;  ///< the result
    CfdParameters flow;
    std::vector<std::string> products;  ///< names of the files and folders written
    std::vector<std::string> warnings;  ///< beside those of the edits
};

struct PreparedReport {
    nlohmann::ordered_json document;  ///< report.json
    std::vector<ReportPicture> pictures;
};

/// Measures before and after, distances to the source and to the exact surface away from the
/// openings, patches, flow, volume mesh; draws the pictures where OpenGL is there.
[[nodiscard]] PreparedReport prepare_report(Session& session, const PreparedCase& prepared,
                                            const Progress& progress);

}  // namespace vesselbench
