#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>

#include "gpu/debug_output.h"
#include "gpu/picture.h"
#include "workbench/window/app/app.h"

namespace vesselbench {

enum class MouseButton { Left = 0, Right = 1, Middle = 2 };

/// Keys held with another one.
struct HeldKeys {
    bool control = false, shift = false;
};

/// What a frame took [s]: by the clock, and of the calling thread's work.
struct FrameTime {
    double clock = 0.0, work = 0.0;
};

/// The window without a display: draws into a framebuffer, and takes mouse, keys and texts from
/// calls. For tests and screenshots. One may exist at a time.
class OffscreenShell {
public:
    /// \param report receives OpenGL's errors; empty: nobody does
    /// \throw GpuUnavailable if there is no OpenGL 4.3
    OffscreenShell(AppOptions options, int width, int height, DebugReport report = {});
    ~OffscreenShell();

    OffscreenShell(const OffscreenShell&) = delete;
    OffscreenShell& operator=(const OffscreenShell&) = delete;

    [[nodiscard]] App& app();

    /// Draws one frame.
    void frame();

    /// Draws frames until a condition holds. \return false if it does not within the time
    bool run_until(const std::function<bool()>& condition, std::chrono::milliseconds time);

    /// Draws frames until nothing runs and everything shown is drawn. \return false as above
    bool settle(std::chrono::milliseconds time);

    /// Calls back after every frame.
    void watch_frames(std::function<void(const FrameTime&)> watch);

    [[nodiscard]] Picture picture() const;

    void resize(int width, int height);

    // --- input; each call draws the frames that make it take effect

    void move_mouse(float x, float y);
    void press(MouseButton button);
    void release(MouseButton button);
    void click(float x, float y);
    void wheel(float notches);
    void drag(float from_x, float from_y, float to_x, float to_y,
              MouseButton button = MouseButton::Left, HeldKeys held = {});
    void type(const std::string& text);
    void press_key(int key, HeldKeys held = {});

    // --- items by name (Ui)

    [[nodiscard]] bool has(const std::string& item);
    /// \return false if there is no such item, or it is disabled
    bool click_item(const std::string& item);
    /// Replaces the text of a field. \return as click_item
    bool fill_item(const std::string& item, const std::string& text);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace vesselbench
