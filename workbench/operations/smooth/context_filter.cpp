#include "workbench/operations/smooth/context_filter.h"

#include <utility>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/freed_memory.h"
#include "gpu/filter_on_device.h"
#include "gpu/gpu_context_finder.h"
#include "workbench/operations/smooth/filter_choice.h"

namespace vesselbench {

namespace {

/// Share of the whole that the context takes.
constexpr double kContextShare = 0.1;

}  // namespace

/// A context and what it was found for.
struct ContextFilter::Found {
    Arguments asked;  ///< of the context
    bool on_gpu = false;
    SmoothingContext context;
    Arguments decided;  ///< of the context

    Found(const Scene& scene, ContextFinder& finder, const Arguments& arguments, bool gpu)
        : asked(context_arguments(arguments)), on_gpu(gpu) {
        Arguments resolved = arguments;
        context = smoothing_context(scene, finder, resolved);
        decided = context_arguments(resolved);
        release_freed_memory();
    }

    [[nodiscard]] FilterSettings settings(const Arguments& arguments) const {
        return {.iterations = static_cast<int>(arguments.integer("iterations")),
                .weights = context.weights,
                .fixed = context.fixed,
                .rings = static_cast<int>(arguments.integer("rings")),
                .constraint = context.constraint};
    }

    [[nodiscard]] Result result(Positions positions, const Arguments& arguments) const {
        Result result{std::move(positions), arguments, context.figures, "", on_gpu ? "gpu" : "cpu"};
        for (const auto& [name, value] : decided.values()) result.resolved.set(name, value);
        result.resolved.set("device", result.device);
        return result;
    }
};

ContextFilter::ContextFilter(Scene scene, DeviceSource source)
    : scene_(std::move(scene)), source_(std::move(source)) {}

ContextFilter::~ContextFilter() = default;

ContextFilter::Result ContextFilter::run(const Arguments& arguments, const Progress& progress) {
    if (device_choice_from(arguments.text("device")) != DeviceChoice::Gpu)
        return on_cpu(arguments, progress);
    ChosenDevice chosen = choose_device(DeviceChoice::Gpu, source_);
    if (chosen.device) try {
            return on_device(chosen.device->device, arguments, progress);
        } catch (const GpuUnavailable& error) {
            chosen.reason = error.what();
        }
    Result result = on_cpu(arguments, progress);
    result.reason = chosen.reason;
    return result;
}

ContextFilter::Result ContextFilter::on_cpu(const Arguments& arguments, const Progress& progress) {
    const Surface& surface = surface_of(scene_);
    progress.report(0.0, "finding the context");
    if (!is_found(arguments, false)) {
        if (!cpu_) cpu_ = make_cpu_finder(surface);
        found_ = std::make_shared<const Found>(scene_, *cpu_, arguments, false);
    }
    return found_->result(
        apply_filter(*surface.topology, *found_->context.start, filter_from(arguments),
                     found_->settings(arguments), progress.part(kContextShare, 1.0)),
        arguments);
}

ContextFilter::Result ContextFilter::on_device(const Device& device, const Arguments& arguments,
                                               const Progress& progress) {
    const auto there = std::make_shared<const DeviceSurface>(device, surface_of(scene_));
    progress.report(0.0, "finding the context");
    if (!is_found(arguments, true))
        found_ = std::make_shared<const Found>(scene_, *make_gpu_finder(there), arguments, true);
    return found_->result(
        filter_on_device(there, found_->context.start, filter_from(arguments),
                         found_->settings(arguments), progress.part(kContextShare, 1.0)),
        arguments);
}

bool ContextFilter::is_found(const Arguments& arguments, bool on_gpu) const {
    return found_ && found_->on_gpu == on_gpu && found_->asked == context_arguments(arguments);
}

}  // namespace vesselbench
