#pragma once

#include <string>

#include <catch2/catch.hpp>

#include "gpu/context.h"
#include "gpu/debug_output.h"

namespace vesselbench::test {

/// A context for the duration of a test; what its driver reports fails the test.
struct WatchedContext {
    OffscreenContext context{Sharing::None, true};
    DebugOutput reports{[](const std::string& text) { FAIL_CHECK("OpenGL reported: " << text); }};
};

}  // namespace vesselbench::test
