#include "gpu/filter_on_device.h"

#include <utility>

#include "geometry/kernel/errors.h"
#include "gpu/gpu_context_finder.h"
#include "gpu/gpu_smoother.h"

namespace vesselbench {

namespace {

FilterStart prepared(const FilterPreparation& prepare, const Surface& surface,
                     const std::unique_ptr<ContextFinder>& finder) {
    return prepare ? prepare(*finder) : FilterStart{surface.positions, {}};
}

Positions run_on(const Device& device, const Surface& surface, const FilterParameters& parameters,
                 const FilterPreparation& prepare, const Progress& progress) {
    auto there = std::make_shared<const DeviceSurface>(device, surface);
    const FilterStart start = prepared(prepare, surface, make_gpu_finder(there));
    if (start.positions != surface.positions) {
        Surface moved = surface;
        moved.positions = start.positions;
        there = std::make_shared<const DeviceSurface>(device, std::move(moved));
    }
    GpuSmoother smoother(std::move(there), start.settings);
    smoother.start(parameters);
    smoother.run(start.settings.iterations, progress);
    return smoother.positions();
}

}  // namespace

DeviceRun apply_filter_on(DeviceChoice choice, const Surface& surface,
                          const FilterParameters& parameters, const FilterPreparation& prepare,
                          const Progress& progress, const DeviceSource& source) {
    ChosenDevice chosen = choose_device(choice, source);
    if (chosen.device) try {
            const Device& device = chosen.device->device;
            return {run_on(device, surface, parameters, prepare, progress), true,
                    device.limits.renderer, ""};
        } catch (const GpuUnavailable& error) {
            chosen.reason = error.what();
        }
    const FilterStart start = prepared(prepare, surface, make_cpu_finder(surface));
    return {apply_filter(*surface.topology, *start.positions, parameters, start.settings, progress),
            false, "", chosen.reason};
}

}  // namespace vesselbench
