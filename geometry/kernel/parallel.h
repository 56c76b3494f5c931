#pragma once

#include <cstddef>
#include <functional>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

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

/// Adds up on all threads, always in the same order: the same bits on any number of threads.
/// \tparam Sums starts as Sums{}, and has +
/// \param add add(sums, i) adds element i = 0 ... count - 1 to the sums
template <class Sums, class Add>
[[nodiscard]] Sums summed(std::size_t count, const Add& add) {
    constexpr std::size_t kGrain = 8192;  // decides the order, and so the bits
    return tbb::parallel_deterministic_reduce(
        tbb::blocked_range<std::size_t>(0, count, kGrain), Sums{},
        [&](const auto& range, Sums sums) {
            for (std::size_t i = range.begin(); i != range.end(); ++i) add(sums, i);
            return sums;
        },
        std::plus<Sums>());
}

}  // namespace vesselbench
