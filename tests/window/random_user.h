#pragma once

#include <deque>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "workbench/window/shell/offscreen_shell.h"

namespace vesselbench::test {

/// Someone who clicks, drags, types, presses keys and drops files at random; the same seed makes
/// the same choices. Never changes the folder of the file dialog by hand, so that files are written
/// to the project's folder and to the home folder only.
class RandomUser {
public:
    /// \param files that are dropped on the window at times
    RandomUser(OffscreenShell& shell, unsigned seed, std::vector<std::filesystem::path> files);

    /// One input, and the frames that make it take effect.
    void act();

    /// The latest inputs, oldest first, for messages.
    [[nodiscard]] std::string latest() const;

private:
    void note(const std::string& what);
    [[nodiscard]] int below(int limit);

    template <class Options>
    [[nodiscard]] auto one_of(const Options& options) {
        return options.at(static_cast<std::size_t>(below(static_cast<int>(options.size()))));
    }

    [[nodiscard]] bool chance(int percent) { return below(100) < percent; }

    [[nodiscard]] bool is_safe(float x, float y);
    [[nodiscard]] HeldKeys held();
    void click(const std::string& what, float x, float y);
    void click_item();
    void click_anywhere();
    void drag();
    void turn_wheel();
    void press_key();
    void type();
    void drop_file();
    void resize();
    void wait();

    OffscreenShell& shell_;
    std::mt19937 random_;
    std::vector<std::filesystem::path> files_;
    int width_ = 1280, height_ = 720;
    std::deque<std::string> latest_;
};

/// Makes a folder the home, settings and documents folder of this process, which has its own
/// temporary folder otherwise.
void live_in(const std::filesystem::path& folder);

}  // namespace vesselbench::test
