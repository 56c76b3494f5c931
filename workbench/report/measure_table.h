#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "workbench/session/stored_measures.h"

namespace vesselbench {

/// "12.34 mm", "diameter 8.10 mm inscribed, 8.25 mm by area (53.5 mm²)".
[[nodiscard]] std::string measure_text(const KeptMeasure& measure);

/// Kept measures as a table for spreadsheets (RFC 4180): a header, then a line each.
[[nodiscard]] std::string measures_csv(const std::vector<KeptMeasure>& measures);

/// The same as a list of objects. Figures that a measure does not have are left out.
[[nodiscard]] nlohmann::ordered_json measures_json(const std::vector<KeptMeasure>& measures);

}  // namespace vesselbench
