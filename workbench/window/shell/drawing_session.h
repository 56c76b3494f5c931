#pragma once

#include "workbench/window/app/app.h"

namespace vesselbench {

/// An ImGui context with its OpenGL 4.3 part, current as long as it lives. The OpenGL context of
/// construction must be current whenever it is used or destroyed.
class DrawingSession {
public:
    DrawingSession();
    ~DrawingSession();
    DrawingSession(const DrawingSession&) = delete;
    DrawingSession& operator=(const DrawingSession&) = delete;

    /// One frame of the app between two calls of the shell: fonts, ImGui's frame, the app. What is
    /// to be seen is drawn by render(). If the app throws, it recovers: no error closes the window.
    void draw(App& app);

    /// Into the bound framebuffer.
    void render();
};

/// The name of the current context's device. \throw GpuUnavailable if it is not OpenGL 4.3, with
/// what it is
[[nodiscard]] std::string checked_device();

}  // namespace vesselbench
