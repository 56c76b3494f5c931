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

/// Values at other positions along one axis, in parallel.
/// \param count,step of the new positions: 0, step, 2 step ... [voxels]
/// \param sample gives sample(line, its length, position)
template <class Sample>
std::vector<float> resampled_lines(const std::vector<float>& values, const std::array<int, 3>& size,
                                   std::size_t axis, int count, double step, const Sample& sample) {
    std::size_t stride = 1;
    for (std::size_t a = 0; a < axis; ++a) stride *= static_cast<std::size_t>(size[a]);
    const auto n = static_cast<std::size_t>(size[axis]), m = static_cast<std::size_t>(count);
    const std::size_t lines = values.size() / n;
    std::vector<float> result(lines * m);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, lines, 64), [&](const auto& range) {
        std::vector<float> line(n);
        for (std::size_t l = range.begin(); l != range.end(); ++l) {
            const std::size_t block = l / stride, within = l % stride;
            for (std::size_t i = 0; i < n; ++i) line[i] = values[(block * n + i) * stride + within];
            for (std::size_t i = 0; i < m; ++i)
                result[(block * m + i) * stride + within] =
                    sample(line.data(), n, static_cast<double>(i) * step);
        }
    });
    return result;
}

}  // namespace vesselbench
