#pragma once

#include <vector>

#include "workbench/flow/flow_results.h"
#include "workbench/report/report_html.h"

namespace vesselbench {

/// Puts the results into report.html and report.json of the preparation that the case is in, in
/// place of earlier ones. Reports that are missing, or not of this version, stay as they are.
/// \throw IoError
void add_flow_section(const FlowResults& results, const std::vector<ReportPicture>& pictures);

}  // namespace vesselbench
