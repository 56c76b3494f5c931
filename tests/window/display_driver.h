#pragma once

#include <memory>

#include "tests/window/driver.h"

namespace vesselbench::test {

/// Starts a virtual display for this program and those it starts, once. \return false where Xvfb or
/// xdotool is missing: the scenario counts as skipped
[[nodiscard]] bool start_display();

/// The window on that display, which takes its input from the X server. Null where there is none.
/// \throw GpuUnavailable as GlfwShell
[[nodiscard]] std::unique_ptr<Driver> window_on_display(AppOptions options);

}  // namespace vesselbench::test
