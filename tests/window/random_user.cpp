#include "tests/window/random_user.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <iterator>

#include "workbench/window/keys/keys.h"

namespace vesselbench::test {

namespace {

constexpr std::size_t kNoted = 25;

constexpr std::array kTexts = {
    "3",   "0.5", "-1",    "1e9",    "nan", "abc", "1,2,3",
    "0,0", "",    "7,7,7", "\u00b5", "a b", "\"",  "99999999999999999999"};

constexpr std::array kKeys = {
    keys::kEscape,     keys::kEscape,      keys::kEnter,        keys::kDelete,
    keys::kBackspace,  keys::kTab,         keys::kF1,           keys::kHome,
    keys::kLeft,       keys::kRight,       keys::kUp,           keys::kDown,
    keys::kPageDown,   keys::kLeftBracket, keys::kRightBracket, keys::letter('A'),
    keys::letter('E'), keys::letter('F'),  keys::letter('O'),   keys::letter('P'),
    keys::letter('Y'), keys::letter('Z'),  keys::letter('Z'),   keys::k0 + 1,
    keys::k0 + 3,      keys::k0 + 5,       keys::k0 + 7,        keys::kSpace};

/// Items by which files could be written elsewhere.
constexpr std::array kForbidden = {"file.up", "file.folder"};

bool holds(const ScreenRect& rect, float x, float y) {
    return x >= rect.x && y >= rect.y && x <= rect.x + rect.width && y <= rect.y + rect.height;
}

}  // namespace

RandomUser::RandomUser(OffscreenShell& shell, unsigned seed,
                       std::vector<std::filesystem::path> files)
    : shell_(shell), random_(seed), files_(std::move(files)) {}

void RandomUser::act() {
    const int kind = below(100);
    if (kind < 45) return click_item();
    if (kind < 58) return click_anywhere();
    if (kind < 68) return drag();
    if (kind < 74) return turn_wheel();
    if (kind < 85) return press_key();
    if (kind < 94) return type();
    if (kind < 97) return wait();
    if (kind < 98) return resize();
    drop_file();
}

std::string RandomUser::latest() const {
    std::string text;
    for (const std::string& what : latest_) text += "  " + what + "\n";
    return text;
}

void RandomUser::note(const std::string& what) {
    latest_.push_back(what);
    if (latest_.size() > kNoted) latest_.pop_front();
}

int RandomUser::below(int limit) {
    return static_cast<int>(random_() % static_cast<unsigned>(limit));
}

bool RandomUser::is_safe(float x, float y) {
    const auto& items = shell_.app().ui().items();
    return std::ranges::none_of(kForbidden, [&](const char* name) {
        const auto found = items.find(name);
        return found != items.end() && holds(found->second.rect, x, y);
    });
}

HeldKeys RandomUser::held() {
    return {.control = chance(25), .shift = chance(25)};
}

void RandomUser::click(const std::string& what, float x, float y) {
    const int clicks = chance(15) ? 2 : 1;
    note((clicks == 2 ? "double click " : "click ") + what);
    for (int i = 0; i < clicks; ++i)
        if (is_safe(x, y)) shell_.click(x, y);
}

void RandomUser::click_item() {
    const auto items = shell_.app().ui().items();
    if (items.empty()) return shell_.frame();
    const auto item = std::next(items.begin(), below(static_cast<int>(items.size())));
    const ScreenRect& rect = item->second.rect;
    click(item->first, rect.middle_x(), rect.middle_y());
}

void RandomUser::click_anywhere() {
    const auto x = static_cast<float>(below(width_)), y = static_cast<float>(below(height_));
    click("at " + std::to_string(static_cast<int>(x)) + "," + std::to_string(static_cast<int>(y)),
          x, y);
}

void RandomUser::drag() {
    const auto x = static_cast<float>(below(width_)), y = static_cast<float>(below(height_));
    const auto to_x = x + static_cast<float>(below(300) - 150);
    const auto to_y = y + static_cast<float>(below(300) - 150);
    if (!is_safe(x, y) || !is_safe(to_x, to_y)) return;
    note("drag at " + std::to_string(static_cast<int>(x)) + "," +
         std::to_string(static_cast<int>(y)));
    const std::array buttons = {MouseButton::Left, MouseButton::Left, MouseButton::Left,
                                MouseButton::Middle, MouseButton::Right};
    shell_.drag(x, y, to_x, to_y, one_of(buttons), held());
}

void RandomUser::turn_wheel() {
    note("wheel");
    shell_.move_mouse(static_cast<float>(below(width_)), static_cast<float>(below(height_)));
    const int notches = 1 + below(5);
    for (int i = 0; i < notches; ++i) shell_.wheel(chance(50) ? 1.0F : -1.0F);
}

void RandomUser::press_key() {
    const int key = one_of(kKeys);
    // The next field may be the folder of the file dialog.
    if (key == keys::kTab && shell_.app().place().question() != FileQuestion::None) return;
    const HeldKeys keys_held = held();
    note("key " + std::to_string(key) + (keys_held.control ? " with Ctrl" : "") +
         (keys_held.shift ? " with Shift" : ""));
    shell_.press_key(key, keys_held);
}

void RandomUser::type() {
    const std::string text = one_of(kTexts);
    note("type '" + text + "'");
    if (chance(50)) shell_.press_key(keys::letter('A'), {.control = true});
    shell_.type(text);
}

void RandomUser::drop_file() {
    if (files_.empty()) return;
    const std::filesystem::path file = one_of(files_);
    note("drop " + file.filename().string());
    shell_.app().open(file);
    shell_.frame();
}

void RandomUser::resize() {
    const bool tiny = chance(10);  // some window managers ignore the least size
    width_ = tiny ? 1 + below(300) : 800 + below(800);
    height_ = tiny ? 1 + below(200) : 560 + below(400);
    note("resize to " + std::to_string(width_) + " x " + std::to_string(height_));
    shell_.resize(width_, height_);
    shell_.frame();
}

void RandomUser::wait() {
    note("wait");
    const int frames = 1 + below(20);
    for (int i = 0; i < frames; ++i) shell_.frame();
}

void live_in(const std::filesystem::path& folder) {
    for (const char* name : {"HOME", "XDG_CONFIG_HOME", "XDG_DOCUMENTS_DIR"})
        ::setenv(name, folder.c_str(), 1);
}

}  // namespace vesselbench::test
