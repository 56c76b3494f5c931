#pragma once

#include <cstdint>
#include <vector>

#include "geometry/kernel/surface.h"
#include "gpu/colours.h"

namespace vesselbench {

/// A vessel's end that was left closed.
struct ClosedEnd {
    Vec3 place = Vec3::Zero();  ///< [mm]
    double diameter = 0.0;      ///< of the vessel there [mm]
};

/// What became of a vertex of the source.
enum class SourceFate : std::uint8_t {
    Kept,
    Closed,  ///< within a diameter of an end that was left closed
    Lost     ///< farther from the model than twice the mean edge of either: cut off, or removed
};

/// What became of the source's vertices, #V.
/// \throw InvalidInput if the model has no triangle
[[nodiscard]] std::vector<SourceFate> source_fates(const Surface& source, const Surface& model,
                                                   const std::vector<ClosedEnd>& closed);

/// The wall's colour for what was kept, violet for closed ends, bright blue for what was lost.
[[nodiscard]] Colour fate_colour(SourceFate fate);

}  // namespace vesselbench
