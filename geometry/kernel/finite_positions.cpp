#include "geometry/kernel/finite_positions.h"

#include <atomic>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "geometry/kernel/diagnosed_error.h"

namespace vesselbench {

namespace {

constexpr double kFarthest = 1e7;  ///< [mm]; what lies beyond 10 km comes from a damaged file

bool all_near(const Positions& positions) {
    std::atomic<bool> near = true;
    const tbb::blocked_range<std::size_t> all(0, positions.size(), 16384);
    tbb::parallel_for(all, [&](const auto& range) {
        Vec3 sum = Vec3::Zero();  // a sum of zeros, or NaN
        Vec3 farthest = Vec3::Zero();
        for (std::size_t v = range.begin(); v != range.end(); ++v) {
            sum += 0.0 * positions[v];
            farthest = farthest.cwiseMax(positions[v].cwiseAbs());
        }
        if (!sum.allFinite() || farthest.maxCoeff() > kFarthest) near = false;
    });
    return near;
}

}  // namespace

void require_finite(const Positions& positions) {
    if (all_near(positions)) return;
    for (std::size_t v = 0; v < positions.size(); ++v) {
        const bool finite = positions[v].allFinite();
        if (finite && positions[v].cwiseAbs().maxCoeff() <= kFarthest) continue;
        throw DiagnosedInput({.code = finite ? "vertex-too-far" : "vertex-not-finite",
                              .figures = {{"vertex", static_cast<double>(v)}}});
    }
}

}  // namespace vesselbench
