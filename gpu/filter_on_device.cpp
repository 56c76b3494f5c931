#include "gpu/filter_on_device.h"

#include <utility>

#include "gpu/gpu_smoother.h"

namespace vesselbench {

namespace {

/// The surface on the device with other positions.
std::shared_ptr<const DeviceSurface> moved_to(const std::shared_ptr<const DeviceSurface>& there,
                                              const std::shared_ptr<const Positions>& positions) {
    if (positions == there->surface().positions) return there;
    Surface moved = there->surface();
    moved.positions = positions;
    return std::make_shared<const DeviceSurface>(there->device(), std::move(moved));
}

}  // namespace

Positions filter_on_device(const std::shared_ptr<const DeviceSurface>& there,
                           const std::shared_ptr<const Positions>& start,
                           const FilterParameters& parameters, const FilterSettings& settings,
                           const Progress& progress) {
    GpuSmoother smoother(moved_to(there, start), settings);
    smoother.start(parameters);
    smoother.run(settings.iterations, progress);
    return smoother.positions();
}

}  // namespace vesselbench
