#pragma once

#include <string>

#include "workbench/window/model/operation_form.h"
#include "workbench/window/model/stroke.h"

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

/// The brush that a form describes by its fields.
/// \param otherwise for empty fields
[[nodiscard]] BrushTip tip_of(const OperationForm& form, const BrushTip& otherwise);

/// Writes a tip into the fields.
void set_tip(OperationForm& form, const BrushTip& tip);

/// \throw UsageError if a text of the form is wrong
[[nodiscard]] StrokeRequest stroke_of(const OperationForm& form, const BrushTip& tip,
                                      StrokeKeys keys);

/// Name of the vertex attribute that a form's brush paints; empty: it moves vertices.
[[nodiscard]] std::string painted_attribute(const OperationForm& form);

}  // namespace vesselbench
