#pragma once

#include <span>
#include <string>

#include "geometry/kernel/surface.h"

namespace vesselbench {

/// A small picture of a whole surface, seen from the side of a change, with what changed in a
/// colour of its own.
/// \param changed signed distance from the surface before, #V; empty: nothing changed
/// \param outward of the surface at the change; zero: from the front
/// \return a PNG file's bytes; empty without usable OpenGL
[[nodiscard]] std::string thumbnail_png(const Surface& surface, std::span<const double> changed,
                                        const Vec3& outward);

}  // namespace vesselbench
