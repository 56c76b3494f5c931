#pragma once

#include "geometry/image/image.h"
#include "geometry/kernel/surface.h"
#include "tests/forest/ends.h"
#include "tests/forest/field.h"

namespace vesselbench::forest {

/// The walls of a tree with its ends cut; ends that are cut flat are closed by a fan unless the
/// plan's kind is an open surface. [mm]
[[nodiscard]] Surface tree_surface(const Tree& tree, const Plan& plan);

/// The staircase surface of a mask with cubic voxels. [mm]
[[nodiscard]] Surface voxel_surface(const Tree& tree, const Plan& plan);

/// A mask (0 and 1) or intensities (about 0 outside, 1000 inside).
[[nodiscard]] Image tree_image(const Tree& tree, const Plan& plan);

}  // namespace vesselbench::forest
