#include "workbench/operations/smooth/live_smoother.h"

#include <algorithm>
#include <utility>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/stopwatch.h"
#include "gpu/filter_on_device.h"
#include "smoothing/filters/divergence.h"
#include "smoothing/filters/new_crossings.h"
#include "workbench/operations/smooth/filter_choice.h"

namespace vesselbench {

namespace {

constexpr int kMostAtOnce = 1 << 12;           // iterations
constexpr double kSendEvery = 0.1;             // of what is done so far [s]
constexpr double kLookEvery = 0.02;            // at the clock [s]
constexpr double kMeasureWhileWaiting = 0.08;  // a measurement that takes longer follows [s]

/// Those on which a run of the filter depends, apart from its iterations.
Arguments run_arguments(const Arguments& resolved) {
    static const std::vector<Parameter> table = filter_parameter_table();
    Arguments own = arguments_in(table, resolved);
    own.remove("iterations");
    own.remove("preset");
    return own;
}

bool same(const std::optional<PositionConstraint>& a, const std::optional<PositionConstraint>& b) {
    if (!a || !b) return !a && !b;
    return a->cell == b->cell && a->axes == b->axes && a->size == b->size;
}

bool same_ground(const FilterGround& a, const SmoothingContext& context, int rings) {
    return a.start == context.start && a.fixed == context.fixed &&
           same(a.constraint, context.constraint) && a.rings == rings;
}

}  // namespace

/// A context, what it was found for, and its decisions.
struct LiveSmoother::Found {
    Arguments asked, decided;
    SmoothingContext context;
    std::shared_ptr<const std::vector<double>> weights;
};

struct LiveSmoother::OnDevice {
    HeldDevice held;
    std::shared_ptr<const DeviceSurface> surface;
};

LiveSmoother::LiveSmoother(Scene scene, std::optional<HeldDevice> device)
    : scene_(std::move(scene)), finder_(make_cpu_finder(surface_of(scene_))) {
    if (device) device_ = std::make_unique<OnDevice>(OnDevice{std::move(*device), nullptr});
}

LiveSmoother::~LiveSmoother() = default;

// --- the context

/// Keeps what was decided on staircases: deciding looks at all triangles.
void LiveSmoother::find_context(Arguments& arguments) {
    const Arguments asked = context_arguments(arguments);
    if (!found_ || found_->asked != asked) {
        Arguments resolved = arguments;
        const bool staircase = arguments.flag("staircase");
        if (staircase)
            for (const auto& [name, value] : pinned_.values())
                if (!resolved.has(name)) resolved.set(name, value);
        auto found = std::make_shared<Found>();
        found->asked = asked;
        found->context = smoothing_context(scene_, *finder_, resolved);
        found->decided = context_arguments(resolved);
        if (!found->context.weights.empty())
            found->weights =
                std::make_shared<const std::vector<double>>(std::move(found->context.weights));
        for (const char* name : {"stack_axis", "tau_theta", "tau_max"})
            if (staircase && !arguments.has(name) && !pinned_.has(name))
                pinned_.set(name, resolved.values().at(name));
        found_ = std::move(found);
    }
    for (const auto& [name, value] : found_->decided.values()) arguments.set(name, value);
}

void LiveSmoother::prepare_ground(const Arguments& arguments) {
    const int rings = static_cast<int>(arguments.integer("rings"));
    if (ground_ && same_ground(FilterRun::ground_of(*ground_), found_->context, rings)) return;
    ground_ = FilterRun::prepare({.topology = surface_of(scene_).topology,
                                  .start = found_->context.start,
                                  .fixed = found_->context.fixed,
                                  .constraint = found_->context.constraint,
                                  .rings = rings});
    run_.reset();
}

LiveSmoother::State LiveSmoother::begun(const CheckedArguments& given) {
    State state{.resolved = given};
    resolve_filter(scene_, state.resolved);
    find_context(state.resolved);
    state.weights = found_->weights;
    return state;
}

// --- running

LiveSmoother::State LiveSmoother::run(const CheckedArguments& given, const Receiver& receive,
                                      const Progress& progress) {
    State state = begun(given);
    progress.check_cancelled();
    if (!smooth_on_device(state, progress)) smooth_on_cpu(state, receive, progress);
    state.whole = true;
    state.change.reset();
    if (measure_seconds_ > kMeasureWhileWaiting) receive(state);
    progress.check_cancelled();
    measure(state);
    receive(state);
    return state;
}

LiveSmoother::State LiveSmoother::exact(State state, const Progress& progress) {
    if (state.device != "cpu") smooth_on_cpu(state, nullptr, progress);
    Positions moved = state.surface.points();
    const TakenBack back = take_back_crossings(surface_of(scene_), moved, progress);
    const bool changed = back.vertices > 0 || state.device != "cpu";
    state.device = "cpu";
    state.exact = true;
    if (changed) state.surface = state.surface.with_positions(std::move(moved));
    progress.check_cancelled();
    measure_exactly(state);
    return state;
}

/// The figures of the surface, which may have been measured for another one before.
void LiveSmoother::measure(State& state) {
    if (!meter_) meter_.emplace(surface_of(scene_));
    const Stopwatch watch;
    state.change = meter_->measure(state.surface);
    measure_seconds_ = watch.seconds();
}

/// As the report of `smooth` has them.
void LiveSmoother::measure_exactly(State& state) {
    if (!exact_meter_) exact_meter_.emplace(surface_of(scene_), no_cache_);
    state.change = exact_meter_->measure(state.surface);
}

/// \return false if the CPU has to
bool LiveSmoother::smooth_on_device(State& state, const Progress& progress) {
    if (!device_) return false;
    try {
        const Surface& surface = surface_of(scene_);
        if (!device_->surface)
            device_->surface = std::make_shared<const DeviceSurface>(device_->held.device, surface);
        const int iterations = static_cast<int>(state.resolved.integer("iterations"));
        FilterSettings settings{.iterations = iterations,
                                .fixed = found_->context.fixed,
                                .rings = static_cast<int>(state.resolved.integer("rings")),
                                .constraint = found_->context.constraint};
        if (state.weights) settings.weights = *state.weights;
        state.surface = surface.with_positions(
            filter_on_device(device_->surface, found_->context.start, filter_from(state.resolved),
                             settings, progress));
        state.iterations = iterations;
        state.device = "gpu";
        return true;
    } catch (const GpuUnavailable& error) {
        reason_ = error.what();
        device_.reset();
        return false;
    }
}

/// The last run, if it can be continued; else a new one.
FilterRun& LiveSmoother::run_to_continue(const Arguments& resolved, int iterations) {
    prepare_ground(resolved);
    const Arguments own = run_arguments(resolved);
    const bool same = run_ && run_of_ == found_ && run_arguments_ == own;
    if (same && run_->iterations() <= iterations) return *run_;
    run_ = std::make_unique<FilterRun>(ground_, filter_from(resolved), found_->weights);
    run_arguments_ = own;
    run_of_ = found_;
    return *run_;
}

void LiveSmoother::take_positions(State& state) {
    Positions moved = *found_->context.start;
    if (run_->iterations() > 0) run_->write_positions(moved);
    require_bounded(*found_->context.start, moved);
    state.surface = surface_of(scene_).with_positions(std::move(moved));
    state.iterations = run_->iterations();
}

/// A portion of iterations is not interrupted: what is done so far can be continued, also for the
/// next value.
void LiveSmoother::advance(int iterations) {
    const Stopwatch watch;
    try {
        run_->advance(std::min(portion_, iterations));
    } catch (...) {
        run_.reset();
        throw;
    }
    const bool slow = watch.seconds() > kLookEvery;
    portion_ = slow ? std::max(1, portion_ / 2) : std::min(2 * portion_, kMostAtOnce);
}

void LiveSmoother::smooth_on_cpu(State& state, const Receiver& receive, const Progress& progress) {
    const int wanted = static_cast<int>(state.resolved.integer("iterations"));
    const FilterRun& run = run_to_continue(state.resolved, wanted);
    Stopwatch since_sent;
    while (run.iterations() < wanted) {
        progress.check_cancelled();
        advance(wanted - run.iterations());
        if (!receive || run.iterations() == wanted || since_sent.seconds() < kSendEvery) continue;
        progress.check_cancelled();
        take_positions(state);
        if (meter_ && measure_seconds_ < kMeasureWhileWaiting) measure(state);
        receive(state);
        since_sent = {};
    }
    take_positions(state);
}

}  // namespace vesselbench
