#pragma once

#include <cstddef>
#include <functional>

#include "geometry/kernel/progress.h"
#include "smoothing/filters/neighbour_blocks.h"

namespace vesselbench {

/// Runs `steps` steps over all blocks, where a step of a block needs the previous step of all
/// blocks within the reach. Several steps process the same part of the surface while it is in the
/// cache, each behind the previous one (time skewing); the parts run in parallel. Two alternating
/// buffers suffice: when a block is written, its value of two steps ago is no longer needed. Every
/// block's step sees exactly the values of the previous step, whatever the order.
/// Source: Wolf, "More iteration space tiling", 1989; Wonnacott, "Achieving scalable locality with
/// time skewing", 2002.
/// \param bytes_at_place bytes that a step reads and writes at each place
/// \param run takes the step (from 0) and the block
void sweep_blocks(const NeighbourBlocks& blocks, std::size_t steps, std::size_t bytes_at_place,
                  const std::function<void(std::size_t step, std::size_t block)>& run,
                  const Progress& progress);

}  // namespace vesselbench
