#pragma once

#include <optional>
#include <string>
#include <vector>

#include "workbench/window/model/operation_form.h"
#include "workbench/window/model/surface_places.h"

namespace vesselbench {

/// What a click in the view means for a parameter. Where there is an image, places can be clicked
/// in its slices, too.
enum class PickTarget {
    Surface,  ///< a point on the surface
    Tip,      ///< a vessel end; elsewhere on the surface, such as on a dome, the point itself
    Ends,     ///< as Tip, several; another click on one removes it
    Opening,  ///< an opening
    Corners,  ///< two opposite corners of a box, one after the other
    Voxel,    ///< a point in a slice of the image
    Labels    ///< labels in slices; another click on one removes it
};

/// True for what only slices offer.
[[nodiscard]] bool is_in_slices(PickTarget target);

/// None: its value is no place, or nothing shows it.
[[nodiscard]] std::optional<PickTarget> pick_target(const Parameter& parameter);

/// What to click, for the user: "Click a vessel end".
[[nodiscard]] std::string pick_instruction(PickTarget target);

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
