#pragma once

#include <cstddef>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace vesselbench {

/// Calls visit(v) for v = 0 ... count - 1, vertices or other elements, on all threads; visit may
/// write to element v only.
template <class Visit>
void for_each_vertex(std::size_t count, const Visit& visit) {
    constexpr std::size_t kGrain = 2048;  // about 50 microseconds of work
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, kGrain), [&](const auto& range) {
        for (std::size_t v = range.begin(); v != range.end(); ++v) visit(v);
    });
}

}  // namespace vesselbench
