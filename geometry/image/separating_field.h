#pragma once

#include "geometry/image/image.h"
#include "geometry/kernel/progress.h"

namespace vesselbench {

/// The function that bends least among those that leave every voxel centre of a mask on its side:
/// positive inside, negative elsewhere. Its zero set is a smooth surface without the mask's
/// staircases, and has the topology of the surface midway between voxels. It is shifted so that it
/// encloses the volume of the voxels.
///
/// Minimises the sum of squared second derivatives, mixed ones included, in a band of voxels around
/// the outline; a voxel deeper than the outline's own is at least its distance from these away.
/// Found by accelerated projected gradients, with the same bits on any number of threads.
/// Source: Lempitsky, "Surface extraction from binary volumes with higher-order smoothness", CVPR
/// 2010; Nesterov 1983; restarts: O'Donoghue, Candes, "Adaptive restart for accelerated gradient
/// schemes", Found. Comput. Math. 2015.
/// \param mask inside where >= 0.5
/// \return about the distance [mm] to the surface near it, beyond the band a constant of the
///         voxel's side
/// \throw InvalidInput if the outline has too many voxels; Cancelled if the user cancels
[[nodiscard]] Image separating_field(const Image& mask, const Progress& progress = {});

}  // namespace vesselbench
