#pragma once

#include <functional>
#include <span>

#include "geometry/kernel/surface.h"
#include "smoothing/quality/quality_measures.h"
#include "workbench/case/operation.h"

namespace vesselbench {

/// A suggestion for a target smoothness, and what it makes of the surface (thesis 6.5.6).
struct PresetSuggestion {
    double tau = 0.0;     ///< [-]
    Arguments arguments;  ///< to type; of the filter's parameters those that were searched
    Surface surface;      ///< without the check for crossing walls
    bool does_nothing = false;
    double error = 0.0;                  ///< mean distance from the surface before [mm]
    double curvature_percent = 100.0;    ///< of the surface before
    double volume_change_percent = 0.0;  ///< of the surface before
};

/// The filter's own parameters, which suggestions replace; thresholds of staircases stay.
[[nodiscard]] std::span<const char* const> filter_values();

/// Arguments without these.
[[nodiscard]] Arguments without_filter_values(Arguments given);

/// Sends suggestions for little, medium and strong smoothing (kPresetTaus), one after the other.
/// \param operation of the table, with a search of filters
/// \param given by the user, without defaults; as without_filter_values()
/// \throw as the operation; Cancelled
void suggest_presets(const Operation& operation, const Scene& scene, const Arguments& given,
                     const std::function<void(PresetSuggestion)>& receive,
                     const Progress& progress);

}  // namespace vesselbench
