#include "geometry/kernel/finite_positions.h"

#include <atomic>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "geometry/kernel/diagnosed_error.h"

namespace vesselbench {

namespace {

bool all_finite(const Positions& positions) {
    std::atomic<bool> finite = true;
    const tbb::blocked_range<std::size_t> all(0, positions.size(), 16384);
    tbb::parallel_for(all, [&](const auto& range) {
        Vec3 sum = Vec3::Zero();  // a sum of zeros, or NaN
        for (std::size_t v = range.begin(); v != range.end(); ++v) sum += 0.0 * positions[v];
        if (!sum.allFinite()) finite = false;
    });
    return finite;
}

constexpr double kFarthest = 1e7;  ///< [mm]

}  // namespace

void require_finite(const Positions& positions) {
    if (all_finite(positions)) return;
    for (std::size_t v = 0; v < positions.size(); ++v)
        if (!positions[v].allFinite())
            throw DiagnosedInput(
                {.code = "vertex-not-finite", .figures = {{"vertex", static_cast<double>(v)}}});
}

void require_near(const Positions& positions) {
    require_finite(positions);
    for (std::size_t v = 0; v < positions.size(); ++v)
        if (positions[v].cwiseAbs().maxCoeff() > kFarthest)
            throw DiagnosedInput(
                {.code = "vertex-too-far", .figures = {{"vertex", static_cast<double>(v)}}});
}

}  // namespace vesselbench
