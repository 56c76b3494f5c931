#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "workbench/flow/flow_record.h"

namespace vesselbench {

/// A figure of every iteration, in the order of FlowHistory::iterations.
using FlowSeries = std::vector<double>;

/// What the solver has written of its iterations, or steps of time, so far (watched_tables).
struct FlowHistory {
    std::vector<int> iterations;                  ///< ascending
    std::map<std::string, FlowSeries> residuals;  ///< initial ones, by equation: Ux, Uy, Uz, p [-]
    std::map<std::string, FlowSeries> pressures;  ///< mean, by opening [Pa]
    std::map<std::string, FlowSeries> flows;      ///< outwards, by opening [cm^3/s]
    FlowSeries wall_shear;                        ///< mean magnitude over the wall [Pa]
};

/// The iterations that all tables have; of one that was run twice, the later. Empty: it never ran.
/// \throw InvalidInput if a table is damaged
[[nodiscard]] FlowHistory flow_history(const std::filesystem::path& folder,
                                       const FlowRecord& record);

}  // namespace vesselbench
