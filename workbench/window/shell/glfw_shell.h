#pragma once

#include <filesystem>
#include <memory>
#include <stop_token>

#include "workbench/window/app/app.h"

namespace vesselbench {

/// The window on a display. One may exist at a time; it belongs to the main thread.
class GlfwShell {
public:
    /// \param options `wake`, `device` and `display_scale` are filled in
    /// \throw GpuUnavailable if there is no display or no OpenGL 4.3, with what was found
    explicit GlfwShell(AppOptions options);
    ~GlfwShell();

    GlfwShell(const GlfwShell&) = delete;
    GlfwShell& operator=(const GlfwShell&) = delete;

    [[nodiscard]] App& app();

    /// False once the user has closed the window.
    [[nodiscard]] bool is_open() const;

    /// Takes the input that has come, and draws a frame.
    void frame();

    /// Waits until a frame should be drawn: an idle window draws nothing.
    void wait();

    /// Where reports of the driver are wanted (debug builds, tests): \throw GpuUnavailable with the
    /// first one, if there was any
    void require_no_reports() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Opens the window and runs it until the user closes it, or a stop is requested.
/// \param options as of GlfwShell
/// \param file what to open at once; empty: the start screen
/// \throw as GlfwShell
void run_window(AppOptions options, const std::filesystem::path& file, const std::stop_token& stop);

}  // namespace vesselbench
