#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "geometry/image/image.h"
#include "geometry/kernel/progress.h"

namespace vesselbench {

/// Whether a mask's slices are so much thicker than its voxels that a surface which is straight
/// between them has ridges where the vessel runs obliquely through them.
[[nodiscard]] bool has_thick_slices(const Image& mask);

/// As separating_field() for a mask in thick slices: the function bends least between the slices as
/// well, on a grid with planes between them, where no voxel says which side is inside. It starts
/// from the distances within slices, by a cubic from slice to slice.
/// \param mask inside where >= 0.5, with thick slices
/// \return on a part of the finer grid that holds the mask; positive inside [mm]. Voxel centres of
///         the mask keep their sides, and the volume is the voxels'. None if that needs more than
///         2^27 voxels, or the surface would have more parts or handles than the one midway between
///         voxels
/// \throw InvalidInput as separating_field(); Cancelled if the user cancels
[[nodiscard]] std::optional<Image> curved_field(const Image& mask, const Progress& progress = {});

/// The voxels of a curved field's grid that lie in the voxels at which a vessel of the mask is one
/// voxel wide (chain_voxels), as far as a surface between slices allows.
/// \return offsets in the field, ascending
[[nodiscard]] std::vector<std::size_t> chain_voxels_between(const Image& mask, const Image& field);

}  // namespace vesselbench
