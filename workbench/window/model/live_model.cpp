#include "workbench/window/model/live_model.h"

#include <chrono>
#include <cmath>
#include <utility>
#include <vector>

#include "geometry/kernel/mean_curvature.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/triangle_quality.h"

namespace vesselbench {

namespace {

using namespace std::chrono_literals;

/// The mouse rests: what takes longer may begin.
constexpr auto kRest = 150ms;

constexpr double kLeastRange = 1e-6;  ///< of a deviation: smaller ones are rounding errors [mm]

/// The distances of the local error, negative where the surface has moved inward.
DeviationMap deviation_of(const LocalError& error, const Surface& before, const Surface& after) {
    DeviationMap map{.values = error.values};
    const auto normals = vertex_normals_of(before);
    for (std::size_t v = 0; v < map.values.size(); ++v)
        if ((after.points()[v] - before.points()[v]).dot((*normals)[v]) < 0.0)
            map.values[v] = -map.values[v];
    const ValueRange sizes = shown_range(error.values);
    map.full = std::max(sizes.most, kLeastRange);
    return map;
}

std::vector<double> values_of(ColouringKind kind, const LiveSmoother::State& state) {
    if (kind == ColouringKind::MeanCurvature) return mean_curvature(state.surface).values;
    if (kind == ColouringKind::TriangleQuality) return worst_triangle_quality(state.surface);
    if (state.weights) return *state.weights;
    return std::vector<double>(state.surface.vertex_count(), 1.0);
}

/// What the thread keeps between questions: the smoother of the last scene.
class LiveModelling final : public LiveModels::Work {
public:
    explicit LiveModelling(DeviceSource source) : source_(std::move(source)) {}

    void answer(const LiveQuestion& question, const LiveModels::Turn& turn) override {
        LiveSmoother& smoother = smoother_of(question);
        const auto show = [&](const LiveSmoother::State& state) {
            turn.send(coloured(turn.number, question.colouring, state));
        };
        const auto state = smoother.run(question.arguments, show, turn.progress);
        if (turn.rests(kRest)) show(smoother.exact(state, turn.progress));
    }

    void forget() override {
        smoother_.reset();
        surface_ = {};
    }

private:
    LiveSmoother& smoother_of(const LiveQuestion& question) {
        if (smoother_ && base_ == question.base) return *smoother_;
        if (!device_) device_ = choose_device(DeviceChoice::Auto, source_).device;
        forget();
        base_ = question.base;
        surface_ = surface_of(question.scene);
        smoother_ = std::make_unique<LiveSmoother>(question.scene, *device_);
        before_range_.reset();
        return *smoother_;
    }

    LiveModel coloured(std::uint64_t number, ColouringKind kind, const LiveSmoother::State& state) {
        LiveModel model{.question = number, .state = state};
        if (kind == ColouringKind::Deviation && state.change)
            model.deviation = std::make_shared<const DeviationMap>(
                deviation_of(state.change->error, surface_, state.surface));
        else if (kind != ColouringKind::Deviation && has_live_colours(kind))
            model.colours = std::make_shared<const ColourValues>(
                ColourValues{kind, values_of(kind, state), range_before(kind)});
        return model;
    }

    ValueRange range_before(ColouringKind kind) {
        if (kind == ColouringKind::StaircaseWeight) return {};
        if (before_range_ && range_of_ == kind) return *before_range_;
        range_of_ = kind;
        before_range_ = shown_range(values_of(kind, {.surface = surface_}));
        return *before_range_;
    }

    DeviceSource source_;
    std::optional<std::optional<HeldDevice>> device_;  ///< none: not sought yet
    int base_ = 0;
    Surface surface_;  ///< before
    std::unique_ptr<LiveSmoother> smoother_;
    std::optional<ValueRange> before_range_;
    ColouringKind range_of_ = ColouringKind::Patches;
};

}  // namespace

bool has_live_colours(ColouringKind kind) {
    return kind == ColouringKind::Deviation || kind == ColouringKind::MeanCurvature ||
           kind == ColouringKind::StaircaseWeight || kind == ColouringKind::TriangleQuality;
}

LiveModels::Maker live_modelling(const DeviceSource& source) {
    return [source] { return std::make_unique<LiveModelling>(source); };
}

}  // namespace vesselbench
