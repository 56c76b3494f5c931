#pragma once

#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "geometry/kernel/progress.h"
#include "geometry/vessel/sac/neck_plane.h"
#include "geometry/vessel/sac/sac_measures.h"
#include "workbench/case/arguments.h"
#include "workbench/case/measure_json.h"

namespace vesselbench {

/// A neck as an edit marks it.
struct MarkedNeck {
    SacNeck neck;
    double reach = 1.0;         ///< of the regions beside it [diameters of the parent]
    bool accept_doubt = false;  ///< figures are given although the plane hardly is a neck's
};

/// The neck of an edit's arguments `dome`, `at` and `normal`; the normal is turned to the dome.
/// \throw UsageError if one is missing, or the normal has no direction
[[nodiscard]] MarkedNeck neck_in(const Arguments& arguments);

/// The neck that an edit has stored.
/// \param resolved arguments of the edit
/// \return none: the operation marks no neck, or its arguments are of another version
[[nodiscard]] std::optional<MarkedNeck> marked_neck(const std::string& operation,
                                                    const Arguments& resolved);

/// What is measured of a sac, of its regions and of the vessels at its neck.
struct SacFigures {
    SacMeasures measures;
    bool in_doubt = false;         ///< and not accepted: without figures
    nlohmann::ordered_json table;  ///< for reports, and as the part `sac` of `measure`
};

/// The warning that the marked plane hardly is a neck's.
[[nodiscard]] Diagnostic neck_in_doubt(const MarkedNeck& marked, const SacMeasures& measures);

/// Measures the sac on a surface of its vessel.
/// \throw what sac_regions() throws
[[nodiscard]] SacFigures sac_figures(const Surface& surface, const MarkedNeck& marked, Keys keys,
                                     const Progress& progress = {});

}  // namespace vesselbench
