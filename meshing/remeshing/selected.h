#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <tbb/parallel_for.h>

#include "geometry/kernel/progress.h"

namespace vesselbench {

/// The numbers i < count with wanted(i), ascending. wanted runs on all threads and must not change
/// anything: the passes of remeshing look for their edges on all threads and edit them on one, in a
/// fixed order, so that the result is the same for any number of threads.
/// \throw Cancelled if the user cancels
template <class Wanted>
std::vector<std::uint32_t> selected(std::size_t count, const Progress& cancel,
                                    const Wanted& wanted) {
    constexpr std::size_t kChunk = 4096;
    std::vector<std::vector<std::uint32_t>> parts((count + kChunk - 1) / kChunk);
    tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t part) {
        cancel.check_cancelled();
        const std::size_t end = std::min(count, (part + 1) * kChunk);
        for (std::size_t i = part * kChunk; i < end; ++i)
            if (wanted(static_cast<std::uint32_t>(i)))
                parts[part].push_back(static_cast<std::uint32_t>(i));
    });
    std::vector<std::uint32_t> all;
    for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
    return all;
}

/// Calls visit(i) for i < count on all threads; visit writes to element i only.
/// \throw Cancelled if the user cancels
template <class Visit>
void for_all(std::size_t count, const Progress& cancel, const Visit& visit) {
    constexpr std::size_t kChunk = 512;
    tbb::parallel_for(std::size_t{0}, (count + kChunk - 1) / kChunk, [&](std::size_t part) {
        cancel.check_cancelled();
        const std::size_t end = std::min(count, (part + 1) * kChunk);
        for (std::size_t i = part * kChunk; i < end; ++i) visit(static_cast<std::uint32_t>(i));
    });
}

}  // namespace vesselbench
