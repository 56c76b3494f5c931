#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "geometry/kernel/surface.h"
#include "gpu/context.h"
#include "gpu/debug_output.h"
#include "gpu/device_choice.h"
#include "gpu/device_surface.h"

namespace vesselbench::test {

/// A context for the duration of a test.
struct TestDevice {
    OffscreenContext context{Sharing::None, true};
    Device device = current_device();
    /// What the driver reports fails the test; reset it before an error that is provoked.
    std::unique_ptr<DebugOutput> reports;
};

/// Empty without usable OpenGL: the scenario counts as skipped.
[[nodiscard]] std::optional<TestDevice> test_device();

/// offscreen_device(), of which what the driver reports fails the test, too.
[[nodiscard]] HeldDevice watched_device();

/// The surface on the device.
[[nodiscard]] std::shared_ptr<const DeviceSurface> uploaded(const TestDevice& test,
                                                            const Surface& surface);

/// A surface and its name.
struct NamedSurface {
    std::string name;
    Surface surface;
};

/// A noisy sphere far from the origin, an open tube, and repaired surfaces from ../shared/data if
/// present.
[[nodiscard]] std::vector<NamedSurface> varied_surfaces();

/// Distances of corresponding vertices over the diagonal of the first one's bounding box,
/// ascending.
[[nodiscard]] std::vector<double> relative_distances(const Positions& a, const Positions& b);

}  // namespace vesselbench::test
