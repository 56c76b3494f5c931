#pragma once

#include <span>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace vesselbench {

/// A picture of the report.
struct ReportPicture {
    std::string title;
    std::string png;  ///< the file's bytes
};

/// The report as one self-contained page: the contents of report.json as tables, with pictures.
/// \param report the document of prepare_report()
[[nodiscard]] std::string report_html(const nlohmann::ordered_json& report,
                                      std::span<const ReportPicture> pictures);

}  // namespace vesselbench
