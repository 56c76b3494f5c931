#include "tests/window/walk_support.h"

#include <algorithm>
#include <fstream>

#include <catch2/catch.hpp>
#include <malloc.h>
#include <unistd.h>

#include "tests/window/window_support.h"
#include "workbench/case/parameter_texts.h"
#include "workbench/case/shell_text.h"
#include "workbench/window/drawing/screen_places.h"
#include "workbench/window/keys/keys.h"

namespace vesselbench::test {

using namespace std::chrono_literals;

const Document& document_of(Driver& window) {
    return window.app().place().document;
}

std::size_t edit_count(Driver& window) {
    return document_of(window).snapshot()->log.size();
}

void open_file(Driver& window, const std::string& file) {
    const Document& document = document_of(window);
    window.app().open(file);
    REQUIRE(window.wait_until_idle());
    INFO((document.failure() ? document.failure()->text : "no failure"));
    REQUIRE_FALSE(document.failure());
    REQUIRE(document.is_open());
    REQUIRE(window.settle());
}

void choose(Driver& window, const std::string& step, const std::string& operation) {
    INFO(step << ": " << operation);
    REQUIRE(window.click_item("rail." + step));
    REQUIRE(window.click_item("choose." + operation));
    REQUIRE(window.settle());
}

std::string apply_form(Driver& window) {
    const Document& document = document_of(window);
    const std::string command = window.app().place().command();
    INFO(command);
    const int entered = document.entered();
    REQUIRE(window.click_item("operation.apply"));
    REQUIRE(window.wait_until_idle());
    INFO((document.failure() ? document.failure()->text : "no failure"));
    REQUIRE(document.entered() == entered + 1);
    REQUIRE(window.settle());
    return command;
}

Eigen::Vector2f seen_at(Driver& window, const Vec3& point) {
    REQUIRE(window.has("view.area"));
    const PixelView screen =
        on_screen(window.app().camera(), window.app().ui().items().at("view.area").rect);
    const auto place = screen.place(point);
    REQUIRE(place);
    return place->cast<float>();
}

void point_at_view(Driver& window) {
    REQUIRE(window.has("view.area"));
    const ScreenRect rect = window.app().ui().items().at("view.area").rect;
    window.move_mouse(rect.middle_x(), rect.y + rect.height - 20);
}

void pick_end(Driver& window, const std::string& parameter, const Vec3& near) {
    const Workplace& place = window.app().place();
    if (place.armed() != parameter) REQUIRE(window.click_item("field." + parameter + ".pick"));
    REQUIRE(window.settle());
    const auto& tips = place.surface_places().tips;
    REQUIRE_FALSE(tips.empty());
    const Vec3 tip = std::ranges::min_element(tips, {}, [&](const NamedPlace& end) {
                         return (end.point - near).norm();
                     })->point;
    const Eigen::Vector2f at = seen_at(window, tip);
    window.click(at.x(), at.y());
    REQUIRE(window.run_until([&] { return place.armed().empty(); }, 10s));
    CHECK((place.form()->arguments().point(parameter) - near).norm() < 6.0);
}

void stroke(Driver& window, const Vec3& from, const Vec3& to) {
    const std::size_t before = edit_count(window);
    const Eigen::Vector2f start = seen_at(window, from), end = seen_at(window, to);
    window.move_mouse(start.x(), start.y());
    REQUIRE(window.settle());
    window.press(MouseButton::Left);
    REQUIRE(window.run_until([&] { return document_of(window).is_painting(); }, 10s));
    for (const float share : {0.25F, 0.5F, 0.75F, 1.0F}) {
        const Eigen::Vector2f at = start + share * (end - start);
        window.move_mouse(at.x(), at.y());
        window.frame();
    }
    window.release(MouseButton::Left);
    REQUIRE(window.run_until([&] { return edit_count(window) == before + 1; }, 60s));
    REQUIRE(window.settle());
}

std::string command_of(const LogEntry& edit, const std::string& project) {
    std::string command = "vesselbench apply " + shell_quoted(project) + " " + edit.edit.operation;
    for (const auto& [name, value] : edit.edit.given.values())
        command += " " + shell_quoted(name + "=" + to_text(value));
    command += " --step " + to_string(edit.edit.place.step);
    const std::string& variant = edit.edit.place.variant;
    return variant.empty() ? command : command + " --variant " + shell_quoted(variant);
}

void export_as(Driver& window, const std::string& name) {
    window.press_key(keys::letter('E'), {.control = true});
    REQUIRE(window.fill_item("file.name", name));
    REQUIRE(window.click_item("file.accept"));
    REQUIRE(window.wait_until_idle());
    CHECK_FALSE(document_of(window).failure());
    CHECK(std::filesystem::exists(document_of(window).project().parent_path() / name));
}

std::vector<LogEntry> stored_log(const std::filesystem::path& project) {
    return Session::open(project, session_options()).log();
}

double resident_megabytes() {
    ::malloc_trim(0);  // pages that the allocator holds for later are no growth
    std::ifstream file("/proc/self/statm");
    double whole = 0, resident = 0;
    file >> whole >> resident;
    return resident * static_cast<double>(::sysconf(_SC_PAGESIZE)) / 1e6;
}

}  // namespace vesselbench::test
