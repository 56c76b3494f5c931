#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "geometry/kernel/surface.h"

namespace vesselbench {

enum class LengthUnit { Millimetre, Centimetre, Metre, Micrometre };

[[nodiscard]] std::string to_string(LengthUnit unit);  ///< "mm", "cm", "m", "um"

/// The unit that a file calls so, in any case: "mm", "millimeter", "microns", "µm" ...; none:
/// no known one.
[[nodiscard]] std::optional<LengthUnit> unit_named(std::string_view name);

/// \throw UsageError unless the text is mm, cm, m or um
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

/// True if a vessel may be as long as the surface [mm], and no excerpt of one is smaller.
[[nodiscard]] bool is_vessel_sized(const Surface& surface);

/// The unit in which the coordinates describe a vessel: compares the typical radius (twice the
/// volume over the area; r for a tube) and the extent with those of vessels.
/// \param surface in the file's unit, not empty
/// \param usual of such files: others need a better reason
[[nodiscard]] UnitGuess guess_length_unit(const Surface& surface,
                                          LengthUnit usual = LengthUnit::Millimetre);

}  // namespace vesselbench
