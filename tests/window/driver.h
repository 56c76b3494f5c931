#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "workbench/window/shell/offscreen_shell.h"

namespace vesselbench::test {

/// Drives a window by mouse and keys, as a user does. Each call draws the frames that make its
/// input take effect.
class Driver {
public:
    virtual ~Driver() = default;

    [[nodiscard]] virtual App& app() = 0;
    virtual void frame() = 0;

    /// What the last frame drew; none on a display.
    [[nodiscard]] virtual std::optional<Picture> picture() const { return std::nullopt; }

    // --- the devices

    virtual void move_mouse(float x, float y) = 0;
    virtual void press(MouseButton button) = 0;
    virtual void release(MouseButton button) = 0;
    virtual void wheel(int notches) = 0;
    virtual void press_key(int key, HeldKeys held = {}) = 0;
    virtual void type(const std::string& text) = 0;
    virtual void resize(int width, int height) = 0;

    // --- what users do with them

    void click(float x, float y);
    void drag(float from_x, float from_y, float to_x, float to_y,
              MouseButton button = MouseButton::Left);

    [[nodiscard]] bool has(const std::string& item);
    [[nodiscard]] bool is_enabled(const std::string& item);

    /// Scrolls the list of an item until it is seen: the part of its name up to the first dot names
    /// the list. \return false if there is no such item
    bool reveal(const std::string& item);

    /// Scrolls to the item if needed. \return false if there is no such item, or it is disabled
    bool click_item(const std::string& item);

    /// Replaces the text of a field, or chooses among its options. \return as click_item
    bool fill_item(const std::string& item, const std::string& text);

    // --- waiting

    /// Draws frames until a condition holds. \return false if it does not within the time
    bool run_until(const std::function<bool()>& condition, std::chrono::milliseconds time);

    /// Until no request runs. \return false if that takes too long
    bool wait_until_idle();

    /// Until nothing runs and everything shown is drawn. \return false if that takes too long
    bool settle();
};

enum class Screen { None, Display };

/// A window of the real operations: drawn off-screen, or opened on a virtual display and driven by
/// the X server's events. Null where that cannot be: the scenario counts as skipped.
[[nodiscard]] std::unique_ptr<Driver> window_on(Screen screen, AppOptions options);
[[nodiscard]] std::unique_ptr<Driver> window_on(Screen screen);

}  // namespace vesselbench::test
