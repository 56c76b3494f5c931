#include "smoothing/filters/linear_filter.h"

#include <algorithm>
#include <utility>

#include "geometry/kernel/parallel.h"
#include "smoothing/filters/filter_settings.h"
#include "smoothing/filters/sweep_schedule.h"
#include "smoothing/filters/two_rings.h"

namespace vesselbench {

namespace {

using PackArray = LargeArray<PackRow>;

Pack* packs_of(const PackArray& array) {
    return reinterpret_cast<Pack*>(array.data());
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
    return std::ranges::any_of(steps, [](const LinearStep& step) { return step.start != 0.0; });
}

}  // namespace

std::shared_ptr<const NeighbourBlocks> blocks_for(const Topology& topology,
                                                  const FilterSettings& settings) {
    return std::make_shared<NeighbourBlocks>(settings.rings == 1 ? topology.rings()
                                                                 : two_rings(topology));
}

LinearRun::LinearRun(const Topology& topology, const Positions& positions,
                     std::span<const LinearStep> steps, const FilterSettings& settings,
                     std::shared_ptr<const NeighbourBlocks> blocks)
    : positions_(positions),
      settings_(settings),
      fixed_(checked_fixed_vertices(topology, positions, settings)),
      blocks_(std::move(blocks)),
      steps_(steps.begin(), steps.end()) {
    const std::size_t count = positions.size();
    for (PackArray& values : values_) values = PackArray(count);
    if (settings.constraint || any_uses_start(steps)) start_ = PackArray(count);
    const bool any_fixed = std::ranges::any_of(fixed_, [](std::uint8_t flag) { return flag != 0; });
    if (!settings.weights.empty() || any_fixed) weights_ = LargeArray<double>(count);
    if (steps.size() > 1 && !settings.weights.empty()) free_ = LargeArray<double>(count);
}

std::size_t LinearRun::end_of(std::size_t block) const {
    return std::min(positions_.size(), (block + 1) * NeighbourBlocks::kBlock);
}

std::size_t LinearRun::bytes_at_place() const {
    constexpr std::size_t kNeighbours = 6 * sizeof(std::uint32_t) + sizeof(std::uint16_t);
    return kNeighbours + 2 * sizeof(Pack) + (start_.size() > 0 ? sizeof(Pack) : 0) +
           (weights_.size() > 0 ? sizeof(double) : 0) + (free_.size() > 0 ? sizeof(double) : 0);
}

/// Fills the arrays for the block.
void LinearRun::bring_in(std::size_t block) const {
    Pack* packs = packs_of(values_[0]);
    const Positions& starts = start_of(positions_, settings_);
    for (std::size_t place = block * NeighbourBlocks::kBlock; place < end_of(block); ++place) {
        const std::size_t v = blocks_->vertex_at(place);
        const Vec3 &p = positions_[v], &o = starts[v];
        packs[place] = Pack{p.x(), p.y(), p.z(), 0.0};
        if (start_.size() > 0) packs_of(start_)[place] = Pack{o.x(), o.y(), o.z(), 0.0};
        if (free_.size() > 0) free_[place] = fixed_[v] != 0 ? 0.0 : 1.0;
        if (weights_.size() == 0) continue;
        const double weight = settings_.weights.empty() ? 1.0 : settings_.weights[v];
        weights_[place] = fixed_[v] != 0 ? 0.0 : weight;
    }
}

void LinearRun::take_step(std::size_t number, std::size_t block) const {
    const bool last = (number + 1) % steps_.size() == 0;
    const StepArrays arrays{.source = packs_of(values_[number % 2]),
                            .target = packs_of(values_[(number + 1) % 2]),
                            .start = packs_of(start_),
                            .share = last || free_.size() == 0 ? weights_.data() : free_.data()};
    take_linear_step(steps_[number % steps_.size()], arrays, *blocks_, block);
    if (last && settings_.constraint)
        constrain_block(*settings_.constraint, arrays, block * NeighbourBlocks::kBlock,
                        end_of(block));
}

/// Reads the block's positions after the given number of steps.
void LinearRun::bring_out(std::size_t number, std::size_t block, Positions& moved) const {
    const Pack* last = packs_of(values_[number % 2]);
    for (std::size_t place = block * NeighbourBlocks::kBlock; place < end_of(block); ++place) {
        const std::size_t v = blocks_->vertex_at(place);
        // Fixed vertices keep their bits: adding 0 would turn -0 into 0.
        const bool stays = weights_.size() > 0 && weights_[place] == 0.0;
        moved[v] = stays ? positions_[v] : Vec3(last[place][0], last[place][1], last[place][2]);
    }
}

void LinearRun::advance(int iterations, const Progress& progress, Positions* moved) {
    const std::size_t before = in_ ? 0 : 1;
    const std::size_t more = steps_.size() * static_cast<std::size_t>(iterations);
    // The sweep includes filling before the first step and reading after the last one, which saves
    // extra passes through the memory.
    sweep_blocks(
        *blocks_, before + more, bytes_at_place(),
        [&](std::size_t number, std::size_t block) {
            if (number < before) return bring_in(block);
            take_step(done_ + number - before, block);
            if (number + 1 == before + more && moved != nullptr)
                bring_out(done_ + more, block, *moved);
        },
        progress);
    in_ = true;
    done_ += more;
}

void LinearRun::write(Positions& moved) const {
    if (!in_) {
        moved = positions_;
        return;
    }
    moved.resize(positions_.size());
    for_each_vertex(blocks_->block_count(),
                    [&](std::size_t block) { bring_out(done_, block, moved); });
}

std::span<const PackRow> LinearRun::packs() {
    if (!in_) advance(0, {});
    return {values_[done_ % 2].data(), positions_.size()};
}

void LinearRun::continue_from(const LinearRun& other) {
    if (!other.in_) return;
    advance(0, {});
    done_ = other.done_;
    const Pack* from = packs_of(other.values_[done_ % 2]);
    Pack* to = packs_of(values_[done_ % 2]);
    for_each_vertex(positions_.size(), [&](std::size_t place) { to[place] = from[place]; });
}

Positions run_linear_filter(const Topology& topology, const Positions& positions,
                            std::span<const LinearStep> steps, const FilterSettings& settings,
                            const Progress& progress) {
    if (settings.iterations == 0) {
        static_cast<void>(checked_fixed_vertices(topology, positions, settings));
        return positions;
    }
    LinearRun run(topology, positions, steps, settings, blocks_for(topology, settings));
    Positions moved(positions.size());
    run.advance(settings.iterations, progress, &moved);
    return moved;
}

}  // namespace vesselbench
