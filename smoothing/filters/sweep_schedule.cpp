#include "smoothing/filters/sweep_schedule.h"

#include <algorithm>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace vesselbench {

namespace {

using Run = std::function<void(std::size_t, std::size_t)>;

constexpr std::size_t kCacheBytes = std::size_t{1} << 20;  // a typical second-level cache
constexpr std::size_t kPartsOfThread = 2;  // more: fewer steps per part; fewer: threads wait

/// Blocks [first, last) of the surface.
struct Part {
    std::size_t first = 0, last = 0;
    bool at_start = false, at_end = false;  ///< of the surface: no neighbour to wait for
};

/// All the work on a part that does not need its neighbours: with every step the part shrinks by
/// `reach` blocks on each side.
void run_inner(const Part& part, std::size_t first_step, std::size_t steps, std::size_t reach,
               const Run& run) {
    for (std::size_t front = part.first; front < part.last + (steps - 1) * reach; ++front)
        for (std::size_t k = 0; k < steps && front >= part.first + k * reach; ++k) {
            const std::size_t block = front - k * reach;
            const bool behind_start = part.at_start || block >= part.first + k * reach;
            const bool before_end = block + (part.at_end ? 0 : k * reach) < part.last;
            if (behind_start && before_end) run(first_step + k, block);
        }
}

/// The work that the two parts at a seam left out.
void run_seam(std::size_t seam, std::size_t first_step, std::size_t steps, std::size_t reach,
              const Run& run) {
    for (std::size_t k = 1; k < steps; ++k)
        for (std::size_t block = seam - k * reach; block < seam + k * reach; ++block)
            run(first_step + k, block);
}

}  // namespace

void sweep_blocks(const NeighbourBlocks& blocks, std::size_t steps, std::size_t bytes_at_place,
                  const Run& run, const Progress& progress) {
    const std::size_t count = blocks.block_count();
    const std::size_t reach = std::max<std::size_t>(1, blocks.reach());
    const auto threads = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
    const std::size_t aimed = threads == 1 ? 1 : kPartsOfThread * threads;
    const std::size_t fits = kCacheBytes / (reach * NeighbourBlocks::kBlock * bytes_at_place);
    const std::size_t at_once =
        std::max<std::size_t>(1, std::min({fits, count / (2 * reach * aimed), steps}));
    const std::size_t passes = (steps + at_once - 1) / at_once;
    for (std::size_t pass = 0, done = 0; pass < passes && count > 0; ++pass) {
        progress.report(static_cast<double>(done) / static_cast<double>(steps), "smoothing");
        const std::size_t now = steps * (pass + 1) / passes - done;
        const std::size_t parts = std::clamp<std::size_t>(count / (2 * now * reach), 1, aimed);
        const auto bound = [&](std::size_t i) { return count * i / parts; };
        tbb::parallel_for(std::size_t{0}, parts, [&](std::size_t i) {
            run_inner({bound(i), bound(i + 1), i == 0, i + 1 == parts}, done, now, reach, run);
        });
        tbb::parallel_for(std::size_t{1}, parts,
                          [&](std::size_t i) { run_seam(bound(i), done, now, reach, run); });
        done += now;
    }
}

}  // namespace vesselbench
