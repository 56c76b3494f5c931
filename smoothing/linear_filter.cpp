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

PackArray packed(const Positions& positions, const NeighbourBlocks& blocks) {
    PackArray array(positions.size());
    Pack* packs = packs_of(array);
    for_each_vertex(positions.size(), [&](std::size_t place) {
        const Vec3& p = positions[blocks.vertex_at(place)];
        packs[place] = Pack{p.x(), p.y(), p.z(), 0.0};
    });
    return array;
}

/// A per-vertex factor at every place; 0 at fixed vertices.
std::vector<double> shares(std::span<const double> weights, const std::vector<std::uint8_t>& fixed,
                           const NeighbourBlocks& blocks) {
    std::vector<double> result(fixed.size());
    for_each_vertex(result.size(), [&](std::size_t place) {
        const std::size_t v = blocks.vertex_at(place);
        const double weight = weights.empty() ? 1.0 : weights[v];
        result[place] = fixed[v] != 0 ? 0.0 : weight;
    });
    return result;
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

bool any_uses_start(std::span<const LinearStep> steps) {
    for (const LinearStep& step : steps)
        if (step.start != 0.0) return true;
    return false;
}

}  // namespace

Positions run_linear_filter(const Topology& topology, const Positions& positions,
                            std::span<const LinearStep> steps, const FilterSettings& settings,
                            const Progress& progress) {
    const auto fixed = checked_fixed_vertices(topology, positions, settings);
    const NeighbourBlocks blocks(settings.rings == 1 ? topology.rings() : two_rings(topology));
    const std::size_t count = positions.size();
    PackArray values[2] = {packed(positions, blocks), PackArray(count)};
    PackArray start;
    if (settings.constraint || any_uses_start(steps)) start = packed(positions, blocks);
    const std::vector<double> weights = shares(settings.weights, fixed, blocks);
    std::vector<double> free;
    if (steps.size() > 1 && !settings.weights.empty()) free = shares({}, fixed, blocks);

    const auto run = [&](std::size_t number, std::size_t block) {
        const bool last = (number + 1) % steps.size() == 0;
        const StepArrays arrays{.source = packs_of(values[number % 2]),
                                .target = packs_of(values[(number + 1) % 2]),
                                .start = packs_of(start),
                                .share = last || free.empty() ? weights.data() : free.data()};
        take_linear_step(steps[number % steps.size()], arrays, blocks, block);
        const std::size_t first = block * NeighbourBlocks::kBlock;
        if (last && settings.constraint)
            constrain_block(*settings.constraint, arrays, first,
                            std::min(count, first + NeighbourBlocks::kBlock));
    };
    const std::size_t all_steps = steps.size() * static_cast<std::size_t>(settings.iterations);
    constexpr std::size_t kBytesAtPlace = 2 * sizeof(Pack) + 7 * sizeof(std::uint32_t) + 8;
    sweep(blocks, all_steps, kBytesAtPlace, run, progress);

    Positions moved(count);
    const Pack* last = packs_of(values[all_steps % 2]);
    for_each_vertex(count, [&](std::size_t place) {
        const std::size_t v = blocks.vertex_at(place);
        // What stays, stays bit for bit: a sum with 0 turns -0 into 0.
        moved[v] = weights[place] == 0.0 ? positions[v]
                                         : Vec3(last[place][0], last[place][1], last[place][2]);
    });
    return moved;
}

}  // namespace vesselbench::detail
