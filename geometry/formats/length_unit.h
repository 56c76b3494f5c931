#pragma once

#include <optional>
#include <string>

#include "geometry/kernel/surface.h"

namespace vesselbench {

enum class LengthUnit { Millimetre, Centimetre, Metre };

[[nodiscard]] std::string to_string(LengthUnit unit);  ///< "mm", "cm", "m"

/// \throw UsageError unless the text is mm, cm or m
[[nodiscard]] LengthUnit length_unit_from(const std::string& text);

[[nodiscard]] double millimetres_per(LengthUnit unit);

/// A decision about a file's unit and why it was made.
struct UnitGuess {
    LengthUnit unit = LengthUnit::Millimetre;
    std::string reason;  ///< one sentence with figures
    /// The readings, if another unit is nearly as plausible: "in mm it is 98 mm long ..., in cm
    /// ...". Else empty.
    std::string doubt;
};

/// The unit in which the coordinates describe a vessel: compares the typical radius (twice the
/// volume over the area; r for a tube) and the extent with those of vessels.
/// \param surface in the file's unit, not empty
/// \param usual of such files: others need a better reason
[[nodiscard]] UnitGuess guess_length_unit(const Surface& surface,
                                          LengthUnit usual = LengthUnit::Millimetre);

}  // namespace vesselbench
