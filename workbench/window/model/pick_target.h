#pragma once

#include <optional>
#include <string>
#include <vector>

#include "workbench/window/model/operation_form.h"
#include "workbench/window/model/surface_places.h"

namespace vesselbench {

/// What a click in the view means for a parameter.
enum class PickTarget {
    Surface,  ///< a point on the surface
    Tip,      ///< a vessel's end; elsewhere on the surface, such as on a dome, the point itself
    Opening,  ///< an opening
    Corners   ///< two opposite corners of a box, one after the other
};

/// None: its value is no place, or there is no surface to pick it on. By the parameter's type and
/// name, which mean the same in the whole table.
[[nodiscard]] std::optional<PickTarget> pick_target(const Operation& operation,
                                                    const Parameter& parameter);

/// What to click, for the user: "Click a vessel's end".
[[nodiscard]] std::string pick_instruction(PickTarget target);

/// A parameter's text after a click, as the command line takes it; coordinates are rounded to
/// 0.0001 mm. Of two corners, the first click gives a point, the second one the box.
/// \param text before the click
[[nodiscard]] std::string picked_text(PickTarget target, const std::string& text,
                                      const Vec3& point);

/// False for a box of which only one corner is known.
[[nodiscard]] bool is_complete(PickTarget target, const std::string& text);

/// The form's places that a click can name, with the names of their parameters; typed ones, too.
[[nodiscard]] std::vector<NamedPlace> places_in(const OperationForm& form);

/// True if the form has a parameter whose places are vessel ends or openings.
[[nodiscard]] bool wants_tips(const OperationForm& form);

}  // namespace vesselbench
