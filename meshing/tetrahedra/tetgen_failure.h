#pragma once

#include <span>
#include <string>

#include "geometry/kernel/diagnostic.h"
#include "geometry/kernel/surface.h"

namespace vesselbench {

/// What one of TetGen's error codes means.
[[nodiscard]] std::string tetgen_error_text(int code);

/// Why a surface cannot be filled: what was tried, where it fails, and the remedy.
/// \param attempts a line for each
/// \param intersecting triangles that intersect others; the first five are listed with their places
[[nodiscard]] Diagnostic tetgen_failure(const Surface& surface,
                                        std::span<const std::string> attempts,
                                        std::span<const TriangleId> intersecting);

}  // namespace vesselbench
