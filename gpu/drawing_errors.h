#pragma once

#include <string>

namespace vesselbench {

// Errors of drawing commands of the current context. Asking a driver for them may wait for its
// thread, so it is done once an upload or picture, not once a command.

/// Forgets those of earlier commands.
void forget_drawing_errors();

/// True if a command since the last look has failed.
[[nodiscard]] bool drawing_has_failed();

/// \param what follows "the driver refused" or "the device is out of memory for"
/// \throw GpuUnavailable if a command since the last look has failed
void require_drawn(const std::string& what);

}  // namespace vesselbench
