#pragma once

#include <cstddef>

#include "smoothing/filters/neighbour_blocks.h"

namespace vesselbench {

/// A position that fills one wide register: x, y, z and 0.
using Pack = double __attribute__((vector_size(32), may_alias));

/// Memory of one pack, as arrays hold it.
struct alignas(sizeof(Pack)) PackRow {
    double values[4];
};

/// One step of a filter as a linear combination at every vertex:
///
///     target = onto + share * (umbrella * U + source * s + target * t + start * o)
///
/// with U the mean of the neighbours' source values minus the own one, s and t the own values in
/// source and target before the step, o the position before the first iteration. U is 0 at a vertex
/// without neighbours.
struct LinearStep {
    enum class Onto { Zero, Source, Target };

    Onto onto = Onto::Source;
    double umbrella = 0.0, source = 0.0, target = 0.0, start = 0.0;
};

/// Input and output arrays of a step; one element per place.
struct StepArrays {
    const Pack* source = nullptr;
    Pack* target = nullptr;
    const Pack* start = nullptr;    ///< may be null if LinearStep::start is 0
    const double* share = nullptr;  ///< null: 1 everywhere
};

/// Takes the step at all vertices of a block. Neighbours are summed in a fixed order, with the
/// widest registers of the CPU at hand; the bits depend neither on that width nor on whether a
/// share of 1 is given or left out.
void take_linear_step(const LinearStep& step, const StepArrays& arrays,
                      const NeighbourBlocks& blocks, std::size_t block);

}  // namespace vesselbench
