#pragma once

#include <string>
#include <vector>

#include "workbench/window/case/pick_target.h"
#include "workbench/window/case/surface_places.h"
#include "workbench/window/form/operation_form.h"

namespace vesselbench {

/// A parameter's text after a click, as the command line takes it; coordinates are rounded
/// (rounded_place). Of two corners, the first click gives a point, the second one the box.
/// \param text before the click
[[nodiscard]] std::string picked_text(PickTarget target, const std::string& text,
                                      const Vec3& point);

/// A list of labels, ascending, with one more, or without it if it is there.
[[nodiscard]] std::string picked_labels(const std::string& text, int label);

/// False for a box of which only one corner is known, and for labels, of which there may be more.
[[nodiscard]] bool is_complete(PickTarget target, const std::string& text);

/// The form's places that a click can name, with the names of their parameters; typed ones, too.
[[nodiscard]] std::vector<NamedPlace> places_in(const OperationForm& form);

/// True if the form has a parameter whose places are vessel ends or openings.
[[nodiscard]] bool wants_tips(const OperationForm& form);

}  // namespace vesselbench
