#pragma once

#include <filesystem>
#include <string>

#include "workbench/window/app.h"

namespace vesselbench {

/// Opens the window and runs it until the user closes it. An idle window draws nothing.
/// \param file what to open at once; empty: the start screen
/// \param options `wake`, `device` and `display_scale` are filled in
/// \throw GpuUnavailable if there is no display or no OpenGL 4.3, with what was found
void run_window(AppOptions options, const std::filesystem::path& file);

}  // namespace vesselbench
