#pragma once

#include <optional>
#include <string>

#include "workbench/case/operation.h"

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

}  // namespace vesselbench
