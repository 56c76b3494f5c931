#pragma once

#include <map>
#include <string>
#include <vector>

#include "workbench/window/form/field_text.h"

namespace vesselbench {

/// The parameters that movements of the mouse drive (thesis 6.3.5); empty: none.
struct DriveAxes {
    std::string across;   ///< to the right: more
    std::string up;       ///< up: more
    std::string shifted;  ///< either, while Shift is held

    bool operator==(const DriveAxes&) const = default;
};

/// How far the mouse has moved for each of them [pixels].
struct DriveReach {
    double across = 0.0, up = 0.0, shifted = 0.0;

    bool operator==(const DriveReach&) const = default;
};

/// The parameters of a form that can be driven now: numbers that have an effect.
[[nodiscard]] std::vector<std::string> driven_parameters(const OperationForm& form);

/// The axes without parameters that cannot be driven now; those take the first that can.
[[nodiscard]] DriveAxes usable_axes(const OperationForm& form, DriveAxes axes);

/// The value of a parameter after a movement. Counts grow by 1 every few pixels, values of a
/// bounded range by a share of it, others by a factor. \param start before it \param pixels of the
/// movement; positive: more \return within the parameter's range
[[nodiscard]] double driven_value(const Parameter& parameter, double start, double pixels);

/// A value on an axis, rounded to a step of 1, 2 or 5 times a power of ten, of which the axis has
/// some hundreds; within the axis.
[[nodiscard]] double rounded_on_axis(double value, double from, double to);

/// The value as a field's text, without digits that no movement means.
[[nodiscard]] std::string driven_text(const Parameter& parameter, double value);

/// The texts that a movement gives a form.
/// \param before the form when the movement began
/// \param starts values of parameters that are not given there; what is missing is not driven
[[nodiscard]] std::vector<FieldText> driven_texts(const OperationForm& before,
                                                  const std::map<std::string, double>& starts,
                                                  const DriveAxes& axes, const DriveReach& reach);

}  // namespace vesselbench
