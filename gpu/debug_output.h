#pragma once

#include <functional>
#include <memory>
#include <string>

namespace vesselbench {

/// Receives what a driver reports, at once and on the thread whose call caused it. It must not
/// throw.
using DebugReport = std::function<void(const std::string&)>;

/// While it lives, the current context reports its errors, and everything of high severity
/// (KHR_debug). That context must be current when it ends.
class DebugOutput {
public:
    explicit DebugOutput(DebugReport report);
    ~DebugOutput();

    DebugOutput(const DebugOutput&) = delete;
    DebugOutput& operator=(const DebugOutput&) = delete;

private:
    DebugReport report_;
};

/// True in builds with assertions, and where the environment has VESSELBENCH_GL_DEBUG=1: windows
/// then report what the driver reports.
[[nodiscard]] bool wants_debug_output();

}  // namespace vesselbench
