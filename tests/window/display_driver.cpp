#include "tests/window/display_driver.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <vector>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <catch2/catch.hpp>

#include "tests/support/child_process.h"
#include "tests/support/commands.h"
#include "tests/support/skip.h"
#include "workbench/window/keys/keys.h"
#include "workbench/window/shell/glfw_shell.h"

namespace vesselbench::test {

namespace {

constexpr const char* kServer = "/usr/bin/Xvfb";
/// It reports the first free number, and complains of those in use.
constexpr const char* kOptions =
    " -displayfd 1 -screen 0 2000x1400x24 -dpi 96 -nolisten tcp -noreset 2>/dev/null";

/// Sends events as if they came from the display's mouse and keyboard.
void send(const std::vector<std::string>& words) {
    const auto run = run_command("xdotool", words);
    REQUIRE(run);
    INFO(run->output);
    REQUIRE(run->exit_code == 0);
}

std::string key_name(int key) {
    static const std::map<int, std::string> names = {{keys::kSpace, "space"},
                                                     {keys::kLeftBracket, "bracketleft"},
                                                     {keys::kEscape, "Escape"},
                                                     {keys::kRightBracket, "bracketright"},
                                                     {keys::kEnter, "Return"},
                                                     {keys::kTab, "Tab"},
                                                     {keys::kBackspace, "BackSpace"},
                                                     {keys::kDelete, "Delete"},
                                                     {keys::kRight, "Right"},
                                                     {keys::kLeft, "Left"},
                                                     {keys::kDown, "Down"},
                                                     {keys::kUp, "Up"},
                                                     {keys::kPageUp, "Prior"},
                                                     {keys::kPageDown, "Next"},
                                                     {keys::kHome, "Home"},
                                                     {keys::kEnd, "End"},
                                                     {keys::kF1, "F1"}};
    if (const auto found = names.find(key); found != names.end()) return found->second;
    const bool letter = key >= keys::kA && key < keys::kA + 26;
    return {static_cast<char>(letter ? key - 'A' + 'a' : key)};
}

std::string button_number(MouseButton button) {
    switch (button) {
        case MouseButton::Middle:
            return "2";
        case MouseButton::Right:
            return "3";
        default:
            return "1";
    }
}

class DisplayDriver : public Driver {
public:
    explicit DisplayDriver(AppOptions options) : shell_(std::move(options)) {
        for (int i = 0; i < 3; ++i) frame();
    }

    App& app() override { return shell_.app(); }

    void frame() override {
        update_origin();
        shell_.frame();
        CHECK_NOTHROW(shell_.require_no_reports());
    }

    void move_mouse(float x, float y) override {
        act({"mousemove", std::to_string(std::lround(x) + x_),
             std::to_string(std::lround(y) + y_)});
    }

    void press(MouseButton button) override { act({"mousedown", button_number(button)}); }

    void release(MouseButton button) override { act({"mouseup", button_number(button)}); }

    void wheel(int notches) override {
        act({"click", "--repeat", std::to_string(std::abs(notches)), "--delay", "1",
             notches > 0 ? "4" : "5"});
    }

    void press_key(int key, HeldKeys held) override {
        std::vector<std::string> down, up = {"keyup", key_name(key)};
        const auto hold = [&](const char* name) {
            down.emplace_back("keydown");
            down.emplace_back(name);
            up.emplace_back("keyup");
            up.emplace_back(name);
        };
        if (held.control) hold("ctrl");
        if (held.shift) hold("shift");
        down.emplace_back("keydown");
        down.push_back(key_name(key));
        act(down);
        act(up);
    }

    void type(const std::string& text) override {
        if (!text.empty()) act({"type", "--delay", "1", "--", text});
    }

    void resize(int width, int height) override {
        act({"search", "--name", "vesselbench", "windowsize", std::to_string(width),
             std::to_string(height)});
        frame();
    }

private:
    void act(const std::vector<std::string>& words) {
        send(words);
        frame();
    }

    /// Asks the server where the window is. It answers after the events that were sent before.
    void update_origin() { glfwGetWindowPos(glfwGetCurrentContext(), &x_, &y_); }

    GlfwShell shell_;
    int x_ = 0, y_ = 0;
};

/// The server of this program, and its name in the environment.
class VirtualDisplay {
public:
    VirtualDisplay() : server_("/bin/sh", {"-c", std::string("exec ") + kServer + kOptions}) {
        const std::string number = server_.line();
        running_ = !number.empty();
        if (running_) ::setenv("DISPLAY", (":" + number).c_str(), 1);
    }

    [[nodiscard]] bool running() const { return running_; }

private:
    ChildProcess server_;
    bool running_ = false;
};

}  // namespace

bool start_display() {
    if (!std::filesystem::exists(kServer)) {
        skip("Xvfb is not installed");
        return false;
    }
    static const VirtualDisplay display;
    if (!display.running()) skip("Xvfb does not start");
    return display.running() && run_command("xdotool", {"version"});
}

std::unique_ptr<Driver> window_on_display(AppOptions options) {
    if (!start_display()) return nullptr;
    ::setenv("VESSELBENCH_GL_DEBUG", "1", 1);
    return std::make_unique<DisplayDriver>(std::move(options));
}

}  // namespace vesselbench::test
