#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "workbench/flow/flow_results.h"

namespace vesselbench {

/// A figure with all that a table needs.
struct FlowFigure {
    std::string key;   ///< of the document: "wall_shear.mean_pa"
    std::string name;  ///< "mean wall shear stress"
    std::string unit;  ///< "Pa"
    double value = 0.0;
    std::string definition;  ///< how it is computed, and whose definition that is
};

/// The figures of the whole model, in the order of the table.
[[nodiscard]] std::vector<FlowFigure> flow_figures(const FlowResults& results);

/// The document of `results --json`: the case, the figures with their definitions, openings, the
/// methods paragraph with its references.
[[nodiscard]] nlohmann::ordered_json results_json(const FlowResults& results);

/// The iterations as a table (CSV): residuals, pressures [Pa], flows [cm^3/s], wall shear [Pa].
[[nodiscard]] std::string history_csv(const FlowHistory& history);

}  // namespace vesselbench
