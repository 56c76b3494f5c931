#include "smoothing/filters/filter_run.h"

#include <utility>

#include "geometry/kernel/parallel.h"
#include "smoothing/filters/linear_filter.h"
#include "smoothing/filters/linear_steps.h"

namespace vesselbench {

namespace {

using Steps = std::vector<LinearStep>;

/// The steps of one iteration of a linear filter; empty for other filters.
struct StepsOf {
    Steps operator()(const LaplaceParameters& p) const { return linear_steps(p); }

    Steps operator()(const LaplaceHcParameters& p) const { return linear_steps(p); }

    Steps operator()(const TaubinParameters& p) const { return linear_steps(p); }

    template <class Other>
    Steps operator()(const Other&) const {
        return {};
    }
};

FilterSettings settings_for(const FilterGround& ground,
                            const std::shared_ptr<const std::vector<double>>& weights) {
    FilterSettings settings{.iterations = 0,
                            .fixed = ground.fixed,
                            .keep_boundary = ground.keep_boundary,
                            .rings = ground.rings,
                            .constraint = ground.constraint};
    if (weights) settings.weights = *weights;
    return settings;
}

}  // namespace

class FilterRun::Ground : public FilterGround {
public:
    explicit Ground(FilterGround ground) : FilterGround(std::move(ground)) {}

    std::shared_ptr<const NeighbourBlocks> blocks;
};

std::shared_ptr<const FilterRun::Ground> FilterRun::prepare(FilterGround ground) {
    auto prepared = std::make_shared<Ground>(std::move(ground));
    prepared->blocks = blocks_for(*prepared->topology, settings_for(*prepared, nullptr));
    return prepared;
}

struct FilterRun::Linear {
    FilterSettings settings;  ///< of the time before the run, which refers to them
    LinearRun run;

    Linear(const Ground& ground, const Steps& steps, const FilterSettings& all)
        : settings(all), run(*ground.topology, *ground.start, steps, settings, ground.blocks) {}
};

FilterRun::FilterRun(std::shared_ptr<const Ground> ground, const FilterParameters& parameters,
                     std::shared_ptr<const std::vector<double>> weights)
    : ground_(std::move(ground)), parameters_(parameters), weights_(std::move(weights)) {
    const Steps steps = std::visit(StepsOf{}, parameters_);
    const FilterSettings settings = settings_for(*ground_, weights_);
    if (!steps.empty()) {
        linear_ = std::make_unique<Linear>(*ground_, steps, settings);
        return;
    }
    now_ = apply_filter(*ground_->topology, *ground_->start, parameters_, settings);
    pack_now();
}

FilterRun::FilterRun(const FilterRun& other)
    : FilterRun(other.ground_, other.parameters_, other.weights_) {
    iterations_ = other.iterations_;
    now_ = other.now_;
    packs_ = other.packs_;
    if (linear_) linear_->run.continue_from(other.linear_->run);
}

FilterRun::~FilterRun() = default;

void FilterRun::advance(int iterations, const Progress& progress) {
    if (linear_) {
        linear_->run.advance(iterations, progress);
    } else {
        FilterSettings settings = settings_for(*ground_, weights_);
        settings.iterations = iterations;
        settings.earlier = {ground_->start.get(), iterations_};
        now_ = apply_filter(*ground_->topology, now_, parameters_, settings, progress);
        pack_now();
    }
    iterations_ += iterations;
}

void FilterRun::pack_now() {
    packs_.resize(now_.size());
    for_each_vertex(now_.size(), [&](std::size_t place) {
        const Vec3& p = now_[ground_->blocks->vertex_at(place)];
        packs_[place] = {{p.x(), p.y(), p.z(), 0.0}};
    });
}

std::span<const PackRow> FilterRun::packs() {
    return linear_ ? linear_->run.packs() : packs_;
}

const FilterGround& FilterRun::ground_of(const Ground& ground) {
    return ground;
}

std::span<const VertexId> FilterRun::order_of(const Ground& ground) {
    return ground.blocks->order();
}

void FilterRun::write_positions(Positions& positions) const {
    if (linear_)
        linear_->run.write(positions);
    else
        positions = now_;
}

}  // namespace vesselbench
