#include "tests/window/window_support.h"

#include <catch2/catch.hpp>

#include "geometry/formats/surface_file.h"
#include "geometry/kernel/errors.h"
#include "tests/support/paths.h"
#include "tests/support/shapes.h"
#include "tests/support/skip.h"
#include "workbench/operations/table.h"

namespace vesselbench::test {

using namespace std::chrono_literals;

SessionOptions session_options() {
    SessionOptions options{.author = "Ada", .find = find_operation};
    options.worker.command = {program_path(), "--worker"};
    return options;
}

AppOptions app_options() {
    const std::string folder = temporary_folder();
    return {.session = session_options(), .settings = folder, .documents = folder};
}

std::string tube_file(int around) {
    const std::string file = temporary_folder() + "/tube.stl";
    write_surface(fine_tube(4.0, 30.0, around), file);
    return file;
}

void fail_on_report(const std::string& text) {
    FAIL_CHECK("OpenGL reported: " << text);
}

std::unique_ptr<OffscreenShell> test_shell() {
    try {
        return std::make_unique<OffscreenShell>(app_options(), 1280, 720, fail_on_report);
    } catch (const GpuUnavailable& error) {
        skip(error.what());
        return nullptr;
    }
}

bool wait_until_idle(OffscreenShell& shell) {
    const Document& document = shell.app().place().document;
    return shell.run_until([&] { return !document.activity(); }, 120s);
}

void open_and_wait(OffscreenShell& shell, const std::string& file) {
    shell.app().open(file);
    REQUIRE(wait_until_idle(shell));
    REQUIRE(shell.app().place().document.is_open());
    REQUIRE(shell.settle(60s));
}

}  // namespace vesselbench::test
