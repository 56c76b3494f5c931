#include "tests/window/driver.h"

#include <algorithm>
#include <thread>

#include "geometry/kernel/errors.h"
#include "tests/support/skip.h"
#include "tests/window/display_driver.h"
#include "tests/window/window_support.h"
#include "workbench/window/keys/keys.h"

namespace vesselbench::test {

namespace {

using namespace std::chrono_literals;

constexpr int kWidth = 1280, kHeight = 800;        ///< as the window opens
constexpr auto kShortest = 5ms, kLongest = 100ms;  ///< between the frames of a wait
constexpr int kMostNotches = 60;                   ///< to scroll through the longest list

class OffscreenDriver : public Driver {
public:
    explicit OffscreenDriver(AppOptions options)
        : shell_(std::move(options), kWidth, kHeight, fail_on_report) {}

    App& app() override { return shell_.app(); }

    void frame() override { shell_.frame(); }

    std::optional<Picture> picture() const override { return shell_.picture(); }

    void move_mouse(float x, float y) override { shell_.move_mouse(x, y); }

    void press(MouseButton button) override { shell_.press(button); }

    void release(MouseButton button) override { shell_.release(button); }

    void wheel(int notches) override { shell_.wheel(static_cast<float>(notches)); }

    void press_key(int key, HeldKeys held) override { shell_.press_key(key, held); }

    void type(const std::string& text) override { shell_.type(text); }

    void resize(int width, int height) override {
        shell_.resize(width, height);
        shell_.frame();
    }

private:
    OffscreenShell shell_;
};

std::string list_of(const std::string& item) {
    return item.substr(0, item.find('.') + 1);
}

}  // namespace

void Driver::click(float x, float y) {
    move_mouse(x, y);
    press(MouseButton::Left);
    release(MouseButton::Left);
    frame();
}

void Driver::drag(float from_x, float from_y, float to_x, float to_y, MouseButton button) {
    constexpr int kMoves = 8;
    move_mouse(from_x, from_y);
    press(button);
    for (int i = 1; i <= kMoves; ++i) {
        const float share = static_cast<float>(i) / kMoves;
        move_mouse(from_x + share * (to_x - from_x), from_y + share * (to_y - from_y));
    }
    release(button);
}

bool Driver::has(const std::string& item) {
    frame();
    return app().ui().items().contains(item);
}

bool Driver::is_enabled(const std::string& item) {
    return has(item) && app().ui().items().at(item).enabled;
}

bool Driver::reveal(const std::string& item) {
    if (has(item)) return true;
    const std::string list = list_of(item);
    const auto& items = app().ui().items();
    const auto near = items.lower_bound(list);
    if (near == items.end() || list_of(near->first) != list) return false;
    const ScreenRect rect = near->second.rect;
    move_mouse(rect.middle_x(), rect.middle_y());
    for (const int direction : {-1, 1})
        for (int i = 0; i < kMostNotches; ++i) {
            wheel(direction);
            if (has(item)) return true;
        }
    return false;
}

bool Driver::click_item(const std::string& item) {
    if (!reveal(item)) return false;
    const UiItem found = app().ui().items().at(item);
    if (found.enabled) click(found.rect.middle_x(), found.rect.middle_y());
    return found.enabled;
}

bool Driver::fill_item(const std::string& item, const std::string& text) {
    if (!click_item(item)) return false;
    if (const std::string option = item + "=" + text; has(option)) return click_item(option);
    press_key(keys::letter('A'), {.control = true});
    if (text.empty()) press_key(keys::kDelete);
    type(text);
    frame();
    return true;
}

bool Driver::run_until(const std::function<bool()>& condition, std::chrono::milliseconds time) {
    const auto end = std::chrono::steady_clock::now() + time;
    auto pause = kShortest;
    for (frame(); !condition(); frame()) {
        if (std::chrono::steady_clock::now() > end) return false;
        std::this_thread::sleep_for(pause);
        pause = std::min(2 * pause, kLongest);
    }
    return true;
}

bool Driver::wait_until_idle() {
    return run_until([this] { return !app().place().document.activity(); }, 120s);
}

bool Driver::settle() {
    const bool settled = run_until([this] { return app().is_settled(); }, 60s);
    frame();
    return settled;
}

std::unique_ptr<Driver> window_on(Screen screen, AppOptions options) {
    try {
        if (screen == Screen::Display) return window_on_display(std::move(options));
        return std::make_unique<OffscreenDriver>(std::move(options));
    } catch (const GpuUnavailable& error) {
        skip(error.what());
        return nullptr;
    }
}

std::unique_ptr<Driver> window_on(Screen screen) {
    return window_on(screen, app_options());
}

}  // namespace vesselbench::test
