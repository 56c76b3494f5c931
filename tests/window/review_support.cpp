#include "tests/window/review_support.h"

#include <tuple>
#include <utility>

#include <catch2/catch.hpp>

#include "geometry/kernel/whole_file.h"
#include "tests/window/window_support.h"
#include "workbench/operations/table.h"
#include "workbench/project/project.h"

namespace vesselbench::test {

using namespace std::chrono_literals;

ReviewFeature& feature_of(OffscreenShell& shell) {
    return shell.app().place().get<ReviewFeature>();
}

std::unique_ptr<OffscreenShell> reviewed_tube() {
    auto shell = test_shell();
    if (!shell) return nullptr;
    open_and_wait(*shell, tube_file());
    shell->app().place().document.apply("smooth", {{"iterations", Value(std::int64_t{2})}},
                                        find_operation("smooth").usual_step);
    REQUIRE(wait_until_idle(*shell));
    REQUIRE(shell->click_item("rail.review"));
    REQUIRE(shell->settle(60s));
    REQUIRE(feature_of(*shell).review());
    return shell;
}

void smooth_strongly(OffscreenShell& shell) {
    shell.app().place().document.apply(
        "smooth",
        {{"filter", Value(std::string("laplace"))}, {"iterations", Value(std::int64_t{200})}},
        Step::Smoothing);
    REQUIRE(wait_until_idle(shell));
    REQUIRE(shell.settle(60s));
}

ReviewStatus status_of_edit(OffscreenShell& shell, EditId id) {
    for (const ReviewedEdit& edit : feature_of(shell).review()->edits)
        if (edit.edit.id == id) return edit.status;
    FAIL("the model has no such edit");
    return ReviewStatus::Open;
}

void say_who(OffscreenShell& shell) {
    REQUIRE(reveal(shell, "review.keep_name"));
    REQUIRE(shell.fill_item("review.name", "A. Kern"));
    REQUIRE(shell.fill_item("review.role", "radiologist"));
    REQUIRE(shell.click_item("review.keep_name"));
}

bool reveal(OffscreenShell& shell, const std::string& item) {
    constexpr int kMost = 40;  // notches from one end of the panel to the other
    for (const float notch : {-1.0F, 1.0F})
        for (int i = 0; i < kMost && !shell.has(item); ++i) {
            shell.move_mouse(1280 - 40, 360);  // in the panel
            shell.wheel(notch);
            shell.frame();
        }
    return shell.has(item);
}

bool click_in_panel(OffscreenShell& shell, const std::string& item) {
    return reveal(shell, item) && shell.click_item(item);
}

void click_and_wait(OffscreenShell& shell, const std::string& item) {
    REQUIRE(click_in_panel(shell, item));
    REQUIRE(wait_until_idle(shell));
    REQUIRE(shell.settle(60s));
}

void answer_and_wait(OffscreenShell& shell, const std::filesystem::path& file) {
    shell.app().place().answer(file);
    REQUIRE(wait_until_idle(shell));
    REQUIRE(shell.settle(60s));
}

VerdictFile file_of_roth(OffscreenShell& shell) {
    VerdictFile file{.program = "page",
                     .reviewer = "B. Roth",
                     .role = "surgeon",
                     .written = "2020-01-01T00:00:00Z"};
    const auto origin =
        shell.app().place().document.runner()->submit([](Session& session, const Progress&) {
            return std::pair(session.project().id(), session.project().record_head());
        });
    std::tie(file.project, file.chain_head) = origin.result();
    file.project_name = "tube";
    for (const ReviewedEdit& edit : feature_of(shell).review()->edits)
        file.edits.push_back({.edit = edit.edit, .hash = edit.hash, .verdict = Verdict::Accept});
    file.edits[1].verdict = Verdict::Reject;
    file.edits[1].comment = "too smooth";
    file.edits[1].pins = {{.place = Vec3(4, 0, 5), .text = "here it shrinks"}};
    file.edits[1].distances = {distance_between(Vec3(4, 0, 5), Vec3(-4, 0, 5))};
    return file;
}

std::filesystem::path beside_project(OffscreenShell& shell, const std::string& name) {
    return shell.app().place().document.project().parent_path() / name;
}

void import_roth(OffscreenShell& shell) {
    const auto file = beside_project(shell, "verdicts.json");
    write_file(file, text_of(file_of_roth(shell)));
    REQUIRE(shell.click_item("review.import"));
    REQUIRE(shell.app().place().question() == FileQuestion::Verdicts);
    answer_and_wait(shell, file);
}

}  // namespace vesselbench::test
