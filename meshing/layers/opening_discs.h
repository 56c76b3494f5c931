#pragma once

#include <cstdint>
#include <vector>

#include "geometry/kernel/surface.h"
#include "meshing/layers/layered_wall.h"

namespace vesselbench {

/// Moves the vertices inside openings with their rims: the displacement is harmonic over the
/// opening, so that a circle shrinks evenly and what is flat stays flat.
/// \param moved positions [mm] of the surface's vertices of which those of the wall have moved
void carry_openings(const Surface& surface, const LayeredWall& wall, Positions& moved);

/// 1 for the patches of openings of which a triangle turned over. #patches
[[nodiscard]] std::vector<std::uint8_t> turned_openings(const Surface& surface,
                                                        const LayeredWall& wall,
                                                        const Positions& moved);

}  // namespace vesselbench
