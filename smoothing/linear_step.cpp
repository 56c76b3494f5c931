#include "smoothing/linear_step.h"

#include <cstdint>

#define ALWAYS_INLINED __attribute__((always_inline))
#define ALWAYS_INLINE inline ALWAYS_INLINED

namespace vesselbench::detail {

namespace any_cpu {
#include "smoothing/linear_step.inc"
}

#pragma GCC push_options
#pragma GCC target("avx2")

namespace avx2 {
#include "smoothing/linear_step.inc"
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

}  // namespace vesselbench::detail
