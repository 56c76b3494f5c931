#include "workbench/window/features/live/live_model.h"

#include <chrono>
#include <cmath>
#include <utility>
#include <vector>

#include "geometry/kernel/mean_curvature.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/parallel.h"
#include "geometry/kernel/statistics.h"
#include "geometry/kernel/triangle_quality.h"
#include "smoothing/context/staircases.h"
#include "workbench/operations/shared/stack_axis.h"

namespace vesselbench {

namespace {

using namespace std::chrono_literals;

/// The mouse rests: what takes longer may begin.
constexpr auto kRest = 150ms;

constexpr double kNearest = 0.98;     ///< of the vertices are within the colours' range [-]
constexpr double kLeastRange = 1e-6;  ///< of a deviation: smaller ones are rounding errors [mm]

/// The end of the colours for a size: 1, 2 or 5 times a power of ten, kept as long as sizes fill a
/// fair part of the colours, so that a value's are not those of another value in other colours.
double kept_full(double full, double size) {
    constexpr double kFilled = 0.3;
    if (full > 0.0 && size <= full && size >= kFilled * full) return full;
    const double ten = std::pow(10.0, std::floor(std::log10(std::max(size, kLeastRange))));
    for (const double step : {1.0, 2.0, 5.0})
        if (size <= step * ten) return step * ten;
    return 10.0 * ten;
}

/// The distances of the local error, negative where the surface has moved inward.
/// \param full the end of the colours of the last one
/// \param normals of the surface before
DeviationMap deviation_of(const LiveSmoother::State& state, const Positions& before,
                          const Positions& normals, double full) {
    DeviationMap map{.values = state.change->error.values};
    std::vector<double> sizes = map.values;
    map.full = kept_full(full, percentile(sizes, kNearest));
    const Positions& after = state.surface.points();
    for_each_vertex(map.values.size(), [&](std::size_t v) {
        if ((after[v] - before[v]).dot(normals[v]) < 0.0) map.values[v] = -map.values[v];
    });
    return map;
}

std::vector<double> values_of(ColouringKind kind, const LiveSmoother::State& state) {
    if (kind == ColouringKind::MeanCurvature) return mean_curvature(state.surface).values;
    if (kind == ColouringKind::TriangleQuality) return worst_triangle_quality(state.surface);
    if (state.weights) return *state.weights;
    return std::vector<double>(state.surface.vertex_count(), 1.0);
}

/// What the thread keeps between questions: the smoother of the last scene.
class LiveModelling final : public Answerer<LiveQuestion, LiveModel> {
public:
    explicit LiveModelling(LiveDevice device) : wanted_(std::move(device)) {}

    void answer(const LiveQuestion& question, const TaskTurn<LiveModel>& turn) override {
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
        scene_ = {};
        axes_.reset();
        full_deviation_ = 0.0;
    }

private:
    LiveSmoother& smoother_of(const LiveQuestion& question) {
        if (smoother_ && base_ == question.base) return *smoother_;
        if (!device_) device_ = choose_device(wanted_.choice, wanted_.source).device;
        forget();
        base_ = question.base;
        surface_ = surface_of(question.scene);
        normals_ = vertex_normals_of(surface_);
        scene_ = question.scene;
        smoother_ = std::make_unique<LiveSmoother>(question.scene, *device_);
        before_range_.reset();
        return *smoother_;
    }

    LiveModel coloured(std::uint64_t number, ColouringKind kind, const LiveSmoother::State& state) {
        LiveModel model{.question = number, .state = state, .reason = smoother_->reason()};
        if (!model.reason.empty()) device_->reset();  // nor is it asked for the next scene
        if (kind == ColouringKind::Deviation && state.change) {
            model.deviation = std::make_shared<const DeviationMap>(
                deviation_of(state, surface_.points(), *normals_, full_deviation_));
            full_deviation_ = model.deviation->full;
        } else if (kind != ColouringKind::Deviation && has_live_colours(kind))
            model.colours = std::make_shared<const ColourValues>(ColourValues{
                kind, values_of(kind, state), range_before(kind), sharpness_of(kind, state)});
        return model;
    }

    /// How sharp the steps still are.
    std::vector<double> sharpness_of(ColouringKind kind, const LiveSmoother::State& state) {
        const bool known = kind == ColouringKind::StaircaseWeight &&
                           state.resolved.flag("staircase") && state.resolved.has("stack_axis");
        if (!known) return {};
        const Value& axis = state.resolved.values().at("stack_axis");
        if (!axes_ || axis != axes_of_) {
            const auto choice =
                staircase_choice(scene_, *make_cpu_finder(surface_), state.resolved);
            if (!choice) return {};
            axes_ = choice->axes;
            axes_of_ = axis;
        }
        return orientation_change(*surface_.topology, state.surface.points(), *axes_);
    }

    ValueRange range_before(ColouringKind kind) {
        if (kind == ColouringKind::StaircaseWeight) return {};
        if (before_range_ && range_of_ == kind) return *before_range_;
        range_of_ = kind;
        before_range_ = shown_range(values_of(kind, {.surface = surface_}));
        return *before_range_;
    }

    LiveDevice wanted_;
    std::optional<std::optional<HeldDevice>> device_;  ///< none: not sought yet
    int base_ = 0;
    Surface surface_;                           ///< before
    std::shared_ptr<const Positions> normals_;  ///< of that
    Scene scene_;
    std::optional<StackAxes> axes_;  ///< of staircases
    Value axes_of_;                  ///< the argument that they follow from
    double full_deviation_ = 0.0;    ///< of the last colours [mm]
    std::unique_ptr<LiveSmoother> smoother_;
    std::optional<ValueRange> before_range_;
    ColouringKind range_of_ = ColouringKind::Patches;
};

}  // namespace

bool has_live_colours(ColouringKind kind) {
    return kind == ColouringKind::Deviation || kind == ColouringKind::MeanCurvature ||
           kind == ColouringKind::StaircaseWeight || kind == ColouringKind::TriangleQuality;
}

LiveModels::Maker live_modelling(const LiveDevice& device) {
    return [device] { return std::make_unique<LiveModelling>(device); };
}

}  // namespace vesselbench
