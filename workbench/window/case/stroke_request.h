#pragma once

#include <string>

#include "workbench/case/operation.h"

namespace vesselbench {

/// True for operations that are painted: driven live by dabs.
[[nodiscard]] bool is_brush(const Operation& operation);

/// Keys held when a stroke begins.
struct StrokeKeys {
    bool smooth = false;  ///< smooths, whatever the brush
    bool invert = false;  ///< lowers instead of lifting, erases instead of painting
};

/// A stroke to be started: the operation with those of its arguments that are not about dabs, and
/// what all of its dabs have in common.
struct StrokeRequest {
    std::string operation;
    Arguments given;
    double radius = 1.0;    ///< [mm]
    double strength = 0.5;  ///< negative: inverted [-]
    double falloff = 1.0;   ///< [-]
};

}  // namespace vesselbench
