#include "gpu/gpu_engine.h"

#include <algorithm>
#include <utility>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "gpu/gpu_meter.h"
#include "gpu/gpu_smoother.h"
#include "gpu/gpu_weights.h"
#include "smoothing/quality/cpu_engine.h"

namespace vesselbench {

namespace {

Surface surface_of(const FilterGround& ground) {
    Surface surface;
    surface.topology = ground.topology;
    surface.positions = ground.start;
    surface.patch_labels = std::make_shared<const PatchLabels>(ground.topology->triangle_count(),
                                                               PatchLabels::value_type{0});
    return surface;
}

/// State shared by all runs.
struct Common {
    HeldDevice held;
    std::shared_ptr<const DeviceSurface> surface;
    GpuMeter meter;
    double radius = 0.0;  ///< of the surface [mm]
};

constexpr std::size_t kStates = 64;  // measured before their numbers are read

class GpuRun final : public FollowingRun {
public:
    GpuRun(std::shared_ptr<Common> common, GpuSmoother smoother)
        : common_(std::move(common)),
          smoother_(std::move(smoother)),
          references_(common_->meter.make_references()) {}

    GpuRun(const GpuRun& other)
        : FollowingRun(other),
          common_(other.common_),
          smoother_(other.smoother_.copy()),
          references_(common_->meter.copy_of(other.references_)) {}

    [[nodiscard]] int iterations() const override { return smoother_.iterations_done(); }

    [[nodiscard]] QualityMeasures measure() override {
        measure_as(0);
        const QualityMeasures measures = common_->meter.read().front().quality;
        require_bounded(measures, common_->radius);
        return measures;
    }

    [[nodiscard]] std::vector<QualityMeasures> measure_at(std::span<const int> iterations,
                                                          const Progress& progress) override {
        std::vector<QualityMeasures> measures;
        for (std::size_t first = 0; first < iterations.size(); first += kStates) {
            const std::size_t count = std::min(kStates, iterations.size() - first);
            for (std::size_t i = 0; i < count; ++i) {
                advance_to(iterations[first + i], progress);
                measure_as(i);
            }
            for (const DeviceMeasures& found : common_->meter.read(count)) {
                if (!is_bounded(found.quality, common_->radius)) return measures;
                measures.push_back(found.quality);
            }
        }
        return measures;
    }

    [[nodiscard]] std::unique_ptr<MeasuredRun> copy() const override {
        return std::make_unique<GpuRun>(*this);
    }

private:
    void smooth(int iterations, const Progress& progress) override {
        smoother_.run(iterations, progress);
    }

    void follow() override { common_->meter.follow(smoother_.shifts(), references_); }

    /// Measures the state as one of those that are read together.
    void measure_as(std::size_t state) {
        const bool follows = due();
        common_->meter.measure(smoother_.shifts(), references_, follows, state);
        if (follows) set_followed();
    }

    std::shared_ptr<Common> common_;
    GpuSmoother smoother_;
    PooledBuffer references_;
};

constexpr std::size_t kWeightsKept = 16;  // together they take as much memory as one run

class GpuEngine final : public SmoothingEngine {
public:
    GpuEngine(HeldDevice held, const FilterGround& ground, bool planes,
              std::optional<StaircaseGround> staircases)
        : staircases_(std::move(staircases)),
          common_(make_common(std::move(held), ground, planes)),
          prototype_(common_->surface, {.fixed = ground.fixed,
                                        .keep_boundary = ground.keep_boundary,
                                        .rings = ground.rings,
                                        .constraint = ground.constraint}),
          mean_edge_(mean_edge_length(common_->surface->surface())) {
        common_->meter.measure(common_->surface->shifts());
        original_ = common_->meter.read().front().quality;
        if (!staircases_) return;
        staircase_weights_.emplace(common_->surface);
        staircase_weights_->find_orientation_change(staircases_->stack_axes);
    }

    [[nodiscard]] std::unique_ptr<MeasuredRun> start(const SmoothingChoice& choice) const override {
        GpuSmoother smoother = prototype_.another();
        if (choice.staircase && staircases_)
            smoother.set_weights(made(choice.staircase->values));
        else if (const SharedWeights weights = weights_of(choice))
            smoother.set_weights(uploaded(weights));
        smoother.start(choice.filter);
        return std::make_unique<GpuRun>(common_, std::move(smoother));
    }

    [[nodiscard]] const QualityMeasures& original() const override { return original_; }

    [[nodiscard]] double mean_edge() const override { return mean_edge_; }

    [[nodiscard]] bool weighs_staircases() const override { return staircases_.has_value(); }

    [[nodiscard]] bool concurrent() const override { return false; }

    [[nodiscard]] std::size_t run_bytes() const override {
        return common_->surface->vertex_count() * 56;
    }

private:
    /// Weights on the device; a search has few of them, with many runs each.
    struct KnownWeights {
        SharedWeights from;                 ///< uploaded from the CPU, or
        std::optional<StaircaseValues> of;  ///< computed on the device
        Buffer buffer;
    };

    const Buffer& keep(KnownWeights weights) const {
        if (weights_.size() >= kWeightsKept) weights_.erase(weights_.begin());
        weights_.push_back(std::move(weights));
        return weights_.back().buffer;
    }

    const Buffer& uploaded(const SharedWeights& weights) const {
        const auto known = std::ranges::find(weights_, weights, &KnownWeights::from);
        if (known != weights_.end()) return known->buffer;
        return keep({weights, {}, GpuSmoother::upload_weights(*common_->surface, *weights)});
    }

    const Buffer& made(const StaircaseValues& values) const {
        const auto known = std::ranges::find(weights_, std::optional(values), &KnownWeights::of);
        if (known != weights_.end()) return known->buffer;
        staircase_weights_->restart();
        staircase_weights_->multiply_staircases({.tau_theta = values.tau_theta,
                                                 .tau_max = values.tau_max,
                                                 .beta_min = values.beta_min,
                                                 .scaling = staircases_->scaling,
                                                 .caps = staircases_->caps});
        if (staircases_->others) staircase_weights_->multiply(uploaded(staircases_->others));
        const std::size_t bytes = common_->surface->vertex_count() * sizeof(float);
        Buffer buffer = make_storage(common_->surface->device(), bytes, "weights");
        copy_storage(common_->surface->device(), staircase_weights_->weights(), buffer, bytes);
        return keep({nullptr, values, std::move(buffer)});
    }

    static std::shared_ptr<Common> make_common(HeldDevice held, const FilterGround& ground,
                                               bool planes) {
        auto surface = std::make_shared<const DeviceSurface>(held.device, surface_of(ground));
        GpuMeter meter(surface, kStates, planes);
        return std::make_shared<Common>(Common{std::move(held), std::move(surface),
                                               std::move(meter), radius_of(*ground.start)});
    }

    std::optional<StaircaseGround> staircases_;
    std::shared_ptr<Common> common_;
    GpuSmoother prototype_;
    mutable std::optional<GpuWeights> staircase_weights_;  ///< with `staircases_`
    mutable std::vector<KnownWeights> weights_;            ///< oldest first
    double mean_edge_ = 0.0;
    QualityMeasures original_;
};

/// The GPU's engine, with the CPU's as fallback.
class SafeEngine final : public SmoothingEngine, public std::enable_shared_from_this<SafeEngine> {
public:
    SafeEngine(std::shared_ptr<const SmoothingEngine> gpu, FilterGround ground, bool planes)
        : gpu_(std::move(gpu)), ground_(std::move(ground)), planes_(planes) {}

    [[nodiscard]] std::unique_ptr<MeasuredRun> start(const SmoothingChoice& choice) const override;

    [[nodiscard]] const QualityMeasures& original() const override { return gpu_->original(); }

    [[nodiscard]] double mean_edge() const override { return gpu_->mean_edge(); }

    [[nodiscard]] bool weighs_staircases() const override { return gpu_->weighs_staircases(); }

    [[nodiscard]] bool concurrent() const override { return false; }

    [[nodiscard]] std::size_t run_bytes() const override { return gpu_->run_bytes(); }

    /// A run on the CPU that continues from another one's state; it never returns to the GPU.
    [[nodiscard]] std::unique_ptr<MeasuredRun> cpu_run(const SmoothingChoice& choice,
                                                       int iterations) const {
        if (!cpu_) cpu_ = make_cpu_engine(ground_, planes_);
        auto run = cpu_->start(choice);
        run->advance_to(iterations, {});
        return run;
    }

private:
    std::shared_ptr<const SmoothingEngine> gpu_;
    FilterGround ground_;
    bool planes_;
    mutable std::shared_ptr<const SmoothingEngine> cpu_;  ///< set once the device has failed
};

class SafeRun final : public MeasuredRun {
public:
    SafeRun(std::shared_ptr<const SafeEngine> engine, SmoothingChoice choice,
            std::unique_ptr<MeasuredRun> run)
        : engine_(std::move(engine)), choice_(std::move(choice)), run_(std::move(run)) {}

    void advance_to(int iterations, const Progress& progress) override {
        try {
            run_->advance_to(iterations, progress);
        } catch (const GpuUnavailable&) {
            take_over(done_);
            run_->advance_to(iterations, progress);
        }
        done_ = run_->iterations();
    }

    [[nodiscard]] int iterations() const override { return done_; }

    [[nodiscard]] QualityMeasures measure() override {
        try {
            return run_->measure();
        } catch (const GpuUnavailable&) {
            take_over(done_);
            return run_->measure();
        }
    }

    [[nodiscard]] std::vector<QualityMeasures> measure_at(std::span<const int> iterations,
                                                          const Progress& progress) override {
        std::vector<QualityMeasures> measures;
        try {
            measures = run_->measure_at(iterations, progress);
        } catch (const GpuUnavailable&) {
            take_over(done_);
            measures = run_->measure_at(iterations, progress);
        }
        done_ = run_->iterations();
        return measures;
    }

    [[nodiscard]] std::unique_ptr<MeasuredRun> copy() const override {
        std::unique_ptr<MeasuredRun> other;
        try {
            other = run_->copy();
        } catch (const GpuUnavailable&) {
            other = engine_->cpu_run(choice_, done_);
        }
        auto safe = std::make_unique<SafeRun>(engine_, choice_, std::move(other));
        safe->done_ = done_;
        return safe;
    }

private:
    void take_over(int iterations) { run_ = engine_->cpu_run(choice_, iterations); }

    std::shared_ptr<const SafeEngine> engine_;
    SmoothingChoice choice_;
    std::unique_ptr<MeasuredRun> run_;
    int done_ = 0;
};

std::unique_ptr<MeasuredRun> SafeEngine::start(const SmoothingChoice& choice) const {
    std::unique_ptr<MeasuredRun> run;
    if (!cpu_) try {
            run = gpu_->start(choice);
        } catch (const GpuUnavailable&) {
        }
    if (!run) run = cpu_run(choice, 0);
    return std::make_unique<SafeRun>(shared_from_this(), choice, std::move(run));
}

}  // namespace

std::shared_ptr<const SmoothingEngine> make_gpu_engine(HeldDevice device,
                                                       const FilterGround& ground, bool planes,
                                                       std::optional<StaircaseGround> staircases) {
    return std::make_shared<GpuEngine>(std::move(device), ground, planes, std::move(staircases));
}

ChosenEngine make_engine(DeviceChoice choice, const FilterGround& ground, bool planes,
                         const DeviceSource& source, std::optional<StaircaseGround> staircases) {
    ChosenDevice chosen = choose_device(choice, source);
    if (chosen.device) try {
            const std::string name = chosen.device->device.limits.renderer;
            auto gpu =
                make_gpu_engine(std::move(*chosen.device), ground, planes, std::move(staircases));
            return {std::make_shared<SafeEngine>(std::move(gpu), ground, planes), true, name, ""};
        } catch (const GpuUnavailable& error) {
            chosen.reason = error.what();
        }
    return {make_cpu_engine(ground, planes), false, "", chosen.reason};
}

}  // namespace vesselbench
