#include <chrono>
#include <cstdio>
#include <iostream>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/whole_file.h"
#include "gpu/png.h"
#include "workbench/commands/commands.h"
#include "workbench/operations/table.h"
#include "workbench/window/shell/glfw_shell.h"
#include "workbench/window/shell/offscreen_shell.h"

namespace vesselbench {

namespace {

using namespace std::chrono_literals;

constexpr auto kPatience = 10min;  ///< for a file to be opened

AppOptions app_options() {
    return {.session = {.find = find_operation}};
}

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
    run_window(app_options(), options.file, stop);
}

void draw_screenshot(const WindowOptions& options) {
    if (options.theme != "dark" && options.theme != "light")
        throw UsageError("--theme '" + options.theme + "' is not allowed: it is dark or light");
    const PictureSize size = size_from(options.size);
    AppOptions app = app_options();
    app.display_scale = scale_for(size.height);
    OffscreenShell shell(std::move(app), size.width, size.height);
    Settings& settings = shell.app().place().settings;
    settings.dark = options.theme == "dark";
    settings.scale = 1.0;
    shell.frame();
    if (!options.file.empty()) shell.app().open(options.file);
    if (!shell.settle(kPatience)) throw AlgorithmFailure("the file took too long to open");
    if (const auto& failure = shell.app().place().document.failure())
        throw InvalidInput(failure->text);
    write_file(options.screenshot, png(shell.picture()));
    std::cout << "wrote " << options.screenshot << "\n";
}

}  // namespace vesselbench
