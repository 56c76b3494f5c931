#include "smoothing/linear_filter.h"

#include <algorithm>
#include <vector>

#include "geometry/large_array.h"
#include "smoothing/filter_support.h"
#include "smoothing/sweep_schedule.h"

namespace vesselbench::detail {

namespace {

using PackArray = LargeArray<PackRow>;

Pack* packs_of(const PackArray& array) {
    return reinterpret_cast<Pack*>(array.data());
}

/// Everything a run reads and writes; one element a place.
struct Run {
    const NeighbourBlocks& blocks;
    const Positions& positions;
    std::span<const LinearStep> steps;
    const FilterSettings& settings;
    const std::vector<std::uint8_t>& fixed;
    PackArray values[2], start;
    /// Per-vertex factors, 0 at fixed vertices: of the last step of an iteration, and of those
    /// before it. Empty where all are 1.
    LargeArray<double> weights, free;

    void bring_in(std::size_t block) const;
    void take_step(std::size_t number, std::size_t block) const;
    void bring_out(std::size_t number, std::size_t block, Positions& moved) const;

    [[nodiscard]] std::size_t end_of(std::size_t block) const {
        return std::min(positions.size(), (block + 1) * NeighbourBlocks::kBlock);
    }
};

/// Fills the block's part of the arrays.
void Run::bring_in(std::size_t block) const {
    Pack* packs = packs_of(values[0]);
    for (std::size_t place = block * NeighbourBlocks::kBlock; place < end_of(block); ++place) {
        const std::size_t v = blocks.vertex_at(place);
        const Vec3& p = positions[v];
        packs[place] = Pack{p.x(), p.y(), p.z(), 0.0};
        if (start.size() > 0) packs_of(start)[place] = packs[place];
        if (free.size() > 0) free[place] = fixed[v] != 0 ? 0.0 : 1.0;
        if (weights.size() == 0) continue;
        const double weight = settings.weights.empty() ? 1.0 : settings.weights[v];
        weights[place] = fixed[v] != 0 ? 0.0 : weight;
    }
}

void constrain_block(const PositionConstraint& constraint, const StepArrays& arrays,
                     std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
        const Pack& start = arrays.start[i];
        Pack& moved = arrays.target[i];
        const Vec3 inside = constraint.clamped(Vec3(start[0], start[1], start[2]),
                                               Vec3(moved[0], moved[1], moved[2]));
        moved = Pack{inside.x(), inside.y(), inside.z(), 0.0};
    }
}

void Run::take_step(std::size_t number, std::size_t block) const {
    const bool last = (number + 1) % steps.size() == 0;
    const StepArrays arrays{.source = packs_of(values[number % 2]),
                            .target = packs_of(values[(number + 1) % 2]),
                            .start = packs_of(start),
                            .share = last || free.size() == 0 ? weights.data() : free.data()};
    take_linear_step(steps[number % steps.size()], arrays, blocks, block);
    if (last && settings.constraint)
        constrain_block(*settings.constraint, arrays, block * NeighbourBlocks::kBlock,
                        end_of(block));
}

/// Takes the block's positions after so many steps.
void Run::bring_out(std::size_t number, std::size_t block, Positions& moved) const {
    const Pack* last = packs_of(values[number % 2]);
    for (std::size_t place = block * NeighbourBlocks::kBlock; place < end_of(block); ++place) {
        const std::size_t v = blocks.vertex_at(place);
        // What stays, stays bit for bit: a sum with 0 turns -0 into 0.
        const bool stays = weights.size() > 0 && weights[place] == 0.0;
        moved[v] = stays ? positions[v] : Vec3(last[place][0], last[place][1], last[place][2]);
    }
}

bool any_uses_start(std::span<const LinearStep> steps) {
    return std::ranges::any_of(steps, [](const LinearStep& step) { return step.start != 0.0; });
}

/// A run whose arrays have their lengths and are not filled yet.
Run make_run(const NeighbourBlocks& blocks, const Positions& positions,
             std::span<const LinearStep> steps, const FilterSettings& settings,
             const std::vector<std::uint8_t>& fixed) {
    const std::size_t count = positions.size();
    Run run{.blocks = blocks,
            .positions = positions,
            .steps = steps,
            .settings = settings,
            .fixed = fixed,
            .values = {PackArray(count), PackArray(count)},
            .start = {},
            .weights = {},
            .free = {}};
    if (settings.constraint || any_uses_start(steps)) run.start = PackArray(count);
    const bool any_fixed = std::ranges::any_of(fixed, [](std::uint8_t flag) { return flag != 0; });
    if (!settings.weights.empty() || any_fixed) run.weights = LargeArray<double>(count);
    if (steps.size() > 1 && !settings.weights.empty()) run.free = LargeArray<double>(count);
    return run;
}

std::size_t bytes_at_place(const Run& run) {
    constexpr std::size_t kNeighbours = 6 * sizeof(std::uint32_t) + sizeof(std::uint16_t);
    return kNeighbours + 2 * sizeof(Pack) + (run.start.size() > 0 ? sizeof(Pack) : 0) +
           (run.weights.size() > 0 ? sizeof(double) : 0) +
           (run.free.size() > 0 ? sizeof(double) : 0);
}

}  // namespace

Positions run_linear_filter(const Topology& topology, const Positions& positions,
                            std::span<const LinearStep> steps, const FilterSettings& settings,
                            const Progress& progress) {
    const auto fixed = checked_fixed_vertices(topology, positions, settings);
    if (settings.iterations == 0) return positions;
    const NeighbourBlocks blocks(settings.rings == 1 ? topology.rings() : two_rings(topology));
    const Run run = make_run(blocks, positions, steps, settings, fixed);
    Positions moved(positions.size());
    const std::size_t all = steps.size() * static_cast<std::size_t>(settings.iterations);
    // What comes before the first step and after the last one belongs to the sweep, too: so it
    // passes through the memory no extra time.
    sweep(
        blocks, all + 1, bytes_at_place(run),
        [&](std::size_t number, std::size_t block) {
            if (number == 0) return run.bring_in(block);
            run.take_step(number - 1, block);
            if (number == all) run.bring_out(all, block, moved);
        },
        progress);
    return moved;
}

}  // namespace vesselbench::detail
