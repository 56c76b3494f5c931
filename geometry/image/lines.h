#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <tbb/parallel_for.h>

namespace vesselbench {

/// Calls change(line) for every line of voxels along one axis, in parallel; a line is a copy that
/// is written back. Lines are independent, so the result does not depend on the threads.
template <class Function>
void for_each_line(std::vector<float>& values, const std::array<int, 3>& size, int axis,
                   const Function& change) {
    const auto n = static_cast<std::size_t>(size[static_cast<std::size_t>(axis)]);
    std::size_t stride = 1;
    for (int a = 0; a < axis; ++a)
        stride *= static_cast<std::size_t>(size[static_cast<std::size_t>(a)]);
    const std::size_t lines = values.size() / n;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, lines, 64), [&](const auto& range) {
        std::vector<float> line(n);
        for (std::size_t l = range.begin(); l != range.end(); ++l) {
            const std::size_t start = l / stride * stride * n + l % stride;
            for (std::size_t i = 0; i < n; ++i) line[i] = values[start + i * stride];
            change(line);
            for (std::size_t i = 0; i < n; ++i) values[start + i * stride] = line[i];
        }
    });
}

}  // namespace vesselbench
