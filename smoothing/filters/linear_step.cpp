#include "smoothing/filters/linear_step.h"

#include <cstdint>

#define ALWAYS_INLINE inline __attribute__((always_inline))

namespace vesselbench {

namespace {

using StepBlock = void(const LinearStep&, const StepArrays&, const NeighbourBlocks&, std::size_t);

/// The step with its terms sorted by their factors: target = the sum over the mean of the
/// neighbours, s, t and o of (share * by_share + always).
struct Combination {
    double by_share[4], always[4];

    Combination(const LinearStep& step, bool has_neighbours)
        : by_share{has_neighbours ? step.umbrella : 0.0,
                   step.source - (has_neighbours ? step.umbrella : 0.0), step.target, step.start},
          always{0.0, step.onto == LinearStep::Onto::Source ? 1.0 : 0.0,
                 step.onto == LinearStep::Onto::Target ? 1.0 : 0.0, 0.0} {}

    /// Coefficient at share 1.
    [[nodiscard]] double constant(int term) const { return by_share[term] + always[term]; }
};

/// Position of a pass within a block's groups.
struct GroupCursor {
    std::size_t first;    ///< place of the block
    std::uint32_t count;  ///< members of the group
    const std::uint16_t* member;
    const std::uint32_t* neighbour;
};

constexpr unsigned kShareTerm = 1, kTargetTerm = 2, kStartTerm = 4;

/// Terms without a coefficient are skipped: their input may not be a number yet.
unsigned terms_of(const LinearStep& step, const StepArrays& arrays) {
    const bool share = arrays.share != nullptr, onto_target = step.onto == LinearStep::Onto::Target;
    const double target = step.target + (onto_target ? 1.0 : 0.0);
    const bool reads_target = share ? step.target != 0.0 || onto_target : target != 0.0;
    return (share ? kShareTerm : 0) | (reads_target ? kTargetTerm : 0) |
           (step.start != 0.0 ? kStartTerm : 0);
}

}  // namespace

namespace any_cpu {
#include "smoothing/filters/linear_step.inc"
}

#pragma GCC push_options
#pragma GCC target("avx2")

namespace avx2 {
#include "smoothing/filters/linear_step.inc"
}

#pragma GCC pop_options

void take_linear_step(const LinearStep& step, const StepArrays& arrays,
                      const NeighbourBlocks& blocks, std::size_t block) {
    static const bool wide = __builtin_cpu_supports("avx2") != 0;
    if (wide)
        avx2::take_step(step, arrays, blocks, block);
    else
        any_cpu::take_step(step, arrays, blocks, block);
}

}  // namespace vesselbench
