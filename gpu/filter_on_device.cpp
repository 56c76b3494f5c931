#include "gpu/filter_on_device.h"

#include "geometry/errors.h"
#include "gpu/gpu_smoother.h"

namespace vesselbench {

namespace {

Positions run_on(const Device& device, const Surface& surface, const FilterParameters& parameters,
                 const FilterSettings& settings, const Progress& progress) {
    GpuSmoother smoother(std::make_shared<const DeviceSurface>(device, surface), settings);
    smoother.start(parameters);
    smoother.run(settings.iterations, progress);
    return smoother.positions();
}

}  // namespace

DeviceRun apply_filter_on(DeviceChoice choice, const Surface& surface,
                          const FilterParameters& parameters, const FilterSettings& settings,
                          const Progress& progress, const DeviceSource& source) {
    ChosenDevice chosen = choose_device(choice, source);
    if (chosen.device) try {
            const Device& device = chosen.device->device;
            return {run_on(device, surface, parameters, settings, progress), true,
                    device.limits.renderer, ""};
        } catch (const GpuUnavailable& error) {
            chosen.reason = error.what();
        }
    return {apply_filter(*surface.topology, surface.points(), parameters, settings, progress),
            false, "", chosen.reason};
}

}  // namespace vesselbench
