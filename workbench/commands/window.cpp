#include <chrono>
#include <cstdio>
#include <filesystem>
#include <iostream>

#include <stdlib.h>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/whole_file.h"
#include "gpu/png.h"
#include "workbench/commands/commands.h"
#include "workbench/commands/console/crash_report.h"
#include "workbench/operations/table.h"
#include "workbench/window/case/user_folders.h"
#include "workbench/window/shell/glfw_shell.h"
#include "workbench/window/shell/offscreen_shell.h"

namespace vesselbench {

namespace {

using namespace std::chrono_literals;

constexpr auto kPatience = 10min;  ///< for a file to be opened

AppOptions app_options() {
    return {.session = {.find = find_operation}};
}

/// A folder for what the window writes while it is drawn once.
class ScratchFolder {
public:
    ScratchFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "vesselbench-XXXXXX").string();
        if (::mkdtemp(name.data()) == nullptr)
            throw IoError("cannot create a temporary folder in '" +
                          std::filesystem::temp_directory_path().string() + "'");
        path_ = name;
    }

    ~ScratchFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }

    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

struct PictureSize {
    int width = 0, height = 0;
};

PictureSize size_from(const std::string& text) {
    constexpr int kLeast = 320, kMost = 8192;
    PictureSize size;
    char rest = '\0';
    const int read = std::sscanf(text.c_str(), "%dx%d%c", &size.width, &size.height, &rest);
    if (read != 2 || size.width < kLeast || size.height < kLeast || size.width > kMost ||
        size.height > kMost)
        throw UsageError("--size '" + text +
                         "' is not allowed: it is WIDTHxHEIGHT in pixels, 320 to 8192 each");
    return size;
}

/// Larger pictures are for displays with smaller pixels.
double scale_for(int height) {
    return height > 1800 ? 2.0 : height > 1200 ? 1.5 : 1.0;
}

}  // namespace

void open_window(const WindowOptions& options, const std::stop_token& stop) {
    AppOptions app = app_options();
    if (const auto crash = untold_crash(state_folder()))
        app.notice = "The program crashed the last time. What it was doing is written to " +
                     crash->string() + ", which is sent nowhere.";
    run_window(std::move(app), options.file, stop);
}

void draw_screenshot(const WindowOptions& options) {
    if (options.theme != "dark" && options.theme != "light")
        throw UsageError("--theme '" + options.theme + "' is not allowed: it is dark or light");
    const PictureSize size = size_from(options.size);
    const ScratchFolder scratch;  // a picture leaves no project and no settings behind
    AppOptions app = app_options();
    app.settings = app.documents = scratch.path();
    app.display_scale = scale_for(size.height);
    std::string reported;
    DebugReport report;
    if (wants_debug_output()) report = [&](const std::string& text) { reported = text; };
    OffscreenShell shell(std::move(app), size.width, size.height, report);
    Settings& settings = shell.app().place().settings;
    settings.dark = options.theme == "dark";
    settings.scale = 1.0;
    shell.frame();
    if (!options.file.empty()) shell.app().place().open_bundled(options.file);
    if (!shell.settle(kPatience)) throw AlgorithmFailure("the file took too long to open");
    if (const auto& failure = shell.app().place().document.failure())
        throw InvalidInput(failure->text);
    if (!reported.empty()) throw GpuUnavailable("OpenGL reported: " + reported);
    write_file(options.screenshot, png(shell.picture()));
    std::cout << "wrote " << options.screenshot << "\n";
}

}  // namespace vesselbench
