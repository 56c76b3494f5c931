#pragma once

#include <span>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "workbench/case/recipe_part.h"

namespace vesselbench {

/// A picture of the report.
struct ReportPicture {
    std::string title;
    std::string png;  ///< the file's bytes
};

/// The report as one self-contained page: the contents of report.json as tables, with pictures.
/// \param report the document of prepare_report()
/// \param sections of the document that follow the others, as operations declare them
[[nodiscard]] std::string report_html(const nlohmann::ordered_json& report,
                                      std::span<const ReportPicture> pictures,
                                      std::span<const ReportSection> sections);

}  // namespace vesselbench
