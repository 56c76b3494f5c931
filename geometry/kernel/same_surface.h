#pragma once

#include "geometry/kernel/surface.h"

namespace vesselbench {

/// True if two surfaces share the arrays of their shape, whose contents are not compared: false
/// does not mean that the shapes differ.
[[nodiscard]] inline bool same_shape(const Surface& a, const Surface& b) {
    return a.topology == b.topology && a.positions == b.positions;
}

/// As same_shape, with the arrays of patch labels and attributes.
[[nodiscard]] inline bool same_surface(const Surface& a, const Surface& b) {
    return same_shape(a, b) && a.patch_labels == b.patch_labels && a.attributes == b.attributes;
}

}  // namespace vesselbench
