#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "geometry/vessel/ends/end_odds.h"
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

/// What an end was taken for, and by which vessel.
struct ReportedOdds {
    double vessel_diameter = 0.0;  ///< [mm]
    EndOdds odds;
};

/// An end as the report of an edit has it (ends_json).
struct ReportedEnd {
    Vec3 place = Vec3::Zero();                ///< centre of its rim or cap, or its tip [mm]
    double diameter = 0.0;                    ///< of the vessel there [mm]; 0: not said
    bool numbered = false;                    ///< a user may decide about it
    std::string fate = {};                    ///< as to_string(EndFate) has it
    std::optional<std::string> opening = {};  ///< name of its patch; none: it got none
    std::optional<ReportedOdds> odds = {};    ///< none: it was not judged
};

/// The ends that the report of an edit states; ends that cannot be read, as in a record of another
/// version or by a stranger, are left out.
[[nodiscard]] std::vector<ReportedEnd> reported_ends(const std::string& report);

}  // namespace vesselbench
