#pragma once

#include <memory>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "workbench/case/arguments.h"
#include "workbench/operations/clip_opening/clipping.h"

namespace vesselbench {

/// What an edit keeps of a clipping: its resolved arguments, and the report.
struct ClippingRecord {
    Records planes;
    Records names;
    std::shared_ptr<nlohmann::ordered_json> report;  ///< `openings`; `ends`, if they were decided
};

/// The ends of a plan, as reports have them.
/// \param names of the plan's openings
[[nodiscard]] nlohmann::ordered_json ends_json(const OpeningPlan& plan,
                                               const std::vector<std::string>& names);

/// \param decided the plan was made by this run (decide_openings): planes that are given say
/// nothing of the other ends
[[nodiscard]] ClippingRecord record_of(const Surface& before, const Clipping& made, bool decided);

}  // namespace vesselbench
