#include "workbench/window/features/compare/comparison.h"

#include <cmath>
#include <thread>

#include <catch2/catch.hpp>

#include "tests/support/shapes.h"
#include "tests/window/window_support.h"
#include "workbench/window/keys/keys.h"

using namespace vesselbench;
using namespace vesselbench::test;
using namespace std::chrono_literals;

namespace {

const Arguments kGentle = {{"iterations", Value(std::int64_t{3})}};

/// Polls until nothing runs. \return false after a minute
template <class Busy>
bool wait(const Busy& busy) {
    for (const auto end = std::chrono::steady_clock::now() + 60s;
         std::chrono::steady_clock::now() < end; std::this_thread::sleep_for(2ms))
        if (!busy()) return true;
    return false;
}

/// A document with a tube, smoothed: states 1 and 2.
std::unique_ptr<Document> smoothed_tube() {
    auto document = std::make_unique<Document>(
        DocumentOptions{.session = session_options(), .wake = {}, .documents = temporary_folder()});
    document->open({.path = tube_file()});
    const auto busy = [&] {
        document->poll();
        return document->busy();
    };
    REQUIRE(wait(busy));
    document->apply("smooth", kGentle, Step::Smoothing);
    REQUIRE(wait(busy));
    REQUIRE(document->snapshot()->history->current() == 2);
    return document;
}

bool settle(Comparison& comparison, Document& document) {
    return wait([&] {
        document.poll();
        comparison.update(document);
        return comparison.pending() || document.busy();
    });
}

/// Fraction of the pixels in which two pictures of a part of the window differ.
double changed_share(const Picture& a, const Picture& b, const ScreenRect& part) {
    int changed = 0, all = 0;
    for (int y = static_cast<int>(part.y); y < static_cast<int>(part.y + part.height); ++y)
        for (int x = static_cast<int>(part.x); x < static_cast<int>(part.x + part.width); ++x) {
            const auto at = (static_cast<std::size_t>(y) * a.width + x) * 3;
            ++all;
            changed += a.rgb[at] != b.rgb[at] || a.rgb[at + 1] != b.rgb[at + 1] ? 1 : 0;
        }
    return static_cast<double>(changed) / all;
}

ScreenRect half(const ScreenRect& view, int side) {
    return {view.x + static_cast<float>(side) * view.width / 2, view.y, view.width / 2,
            view.height};
}

/// The window on a tube that was smoothed strongly.
std::unique_ptr<OffscreenShell> shell_with_smoothed_tube() {
    auto shell = test_shell();
    if (!shell) return nullptr;
    open_and_wait(*shell, tube_file());
    shell->app().place().document.apply("smooth", {{"iterations", Value(std::int64_t{60})}},
                                        Step::Smoothing);
    REQUIRE(wait_until_idle(*shell));
    REQUIRE(shell->settle(60s));
    return shell;
}

}  // namespace

SCENARIO("A comparison measures what lies between two states", "[window][comparison]") {
    const auto document = smoothed_tube();
    const Scene shown = *document->shown();
    Comparison comparison(1);
    CHECK(comparison.scene() == nullptr);
    REQUIRE(settle(comparison, *document));
    REQUIRE(comparison.scene() != nullptr);
    REQUIRE(comparison.difference());
    const SceneDifference& difference = *comparison.difference();
    const ResultRecord& smooth = *document->snapshot()->log[1].result;
    CHECK(difference.change.largest_deviation == smooth.change.largest_deviation);
    CHECK(difference.change.volume_before == smooth.change.volume_before);
    REQUIRE(difference.map);
    CHECK(difference.map->values.size() == shown.surface->vertex_count());
    CHECK(document->snapshot()->history->current() == 2);
    WHEN("the shown state changes") {
        document->undo();
        REQUIRE(settle(comparison, *document));
        THEN("the difference follows") {
            CHECK(comparison.difference()->change.moved_vertices == 0);
            CHECK(comparison.scene()->surface->points() == document->shown()->surface->points());
        }
    }
    WHEN("the reference is the empty case") {
        Comparison empty(0);
        REQUIRE(settle(empty, *document));
        CHECK(empty.problem().empty());
        CHECK_FALSE(empty.difference()->map);
    }
}

SCENARIO("The two of a comparison blink by time or by hand", "[window][comparison]") {
    const auto document = smoothed_tube();
    Comparison comparison(1);
    REQUIRE(settle(comparison, *document));
    comparison.blink(100.0);
    CHECK_FALSE(comparison.blinks_reference());
    CHECK_FALSE(comparison.next_blink(100.0));
    comparison.set_mode(CompareMode::Blink);
    CHECK(comparison.blinks_reference());
    comparison.blink(100.0);
    CHECK(comparison.next_blink(100.1).value() == Approx(Comparison::kBlinkTime - 0.1));
    comparison.blink(100.1);
    CHECK(comparison.blinks_reference());
    comparison.blink(100.0 + Comparison::kBlinkTime);
    CHECK_FALSE(comparison.blinks_reference());
    comparison.switch_by_hand();
    CHECK(comparison.blinks_reference());
    comparison.blink(200.0);
    CHECK(comparison.blinks_reference());
    CHECK_FALSE(comparison.next_blink(200.0));
}

SCENARIO("Two states are seen side by side from one direction", "[window][comparison]") {
    const auto shell = shell_with_smoothed_tube();
    if (!shell) return;
    const ScreenRect view = shell->app().ui().items().at("view.area").rect;
    const Picture alone = shell->picture();
    REQUIRE(shell->click_item("history.compare.1"));
    REQUIRE(shell->settle(60s));
    REQUIRE(shell->app().place().comparison());
    const Picture both = shell->picture();
    CHECK(changed_share(alone, both, half(view, 0)) > 0.05);
    WHEN("the mouse drags in the reference") {
        const ViewCamera before = shell->app().camera();
        const float x = view.x + view.width * 0.2F, y = view.middle_y();
        shell->drag(x, y, x + 60, y + 30);
        THEN("both turn") {
            CHECK((shell->app().camera().view - before.view).norm() > 0.1);
            const Picture turned = shell->picture();
            CHECK(changed_share(both, turned, half(view, 0)) > 0.02);
            CHECK(changed_share(both, turned, half(view, 1)) > 0.02);
        }
    }
    WHEN("nothing happens") {
        const int drawings = shell->app().drawings();
        for (int i = 0; i < 100; ++i) shell->frame();
        THEN("nothing is drawn again") {
            CHECK(shell->app().drawings() == drawings);
        }
    }
    WHEN("Esc is pressed") {
        shell->press_key(keys::kEscape);
        THEN("the comparison ends") {
            CHECK_FALSE(shell->app().place().comparison());
            CHECK_FALSE(shell->has("compare.close"));
        }
    }
}

SCENARIO("Two states blink in the same place", "[window][comparison]") {
    const auto shell = shell_with_smoothed_tube();
    if (!shell) return;
    REQUIRE(shell->click_item("history.compare.1"));
    REQUIRE(shell->settle(60s));
    REQUIRE(shell->click_item("compare.blink"));
    const Comparison& comparison = *shell->app().place().comparison();
    const int drawings = shell->app().drawings();
    CHECK(comparison.blinks_reference());
    CHECK(shell->app().next_change().value() <= Comparison::kBlinkTime);
    for (int i = 0; i < 100; ++i) shell->frame();  // more than a second, less than three blinks
    CHECK(shell->app().drawings() - drawings >= 1);
    CHECK(shell->app().drawings() - drawings <= 3);
    const bool reference = comparison.blinks_reference();
    shell->press_key(keys::kSpace);
    CHECK(comparison.blinks_reference() != reference);
    CHECK_FALSE(shell->app().next_change());
}

SCENARIO("The deviation from a state colours the shown one", "[window][comparison]") {
    const auto shell = shell_with_smoothed_tube();
    if (!shell) return;
    const ScreenRect view = shell->app().ui().items().at("view.area").rect;
    REQUIRE(shell->click_item("history.compare.1"));
    REQUIRE(shell->click_item("compare.blink"));
    REQUIRE(shell->click_item("compare.deviation"));
    REQUIRE(shell->settle(60s));
    const Picture coloured = shell->picture();
    REQUIRE(shell->click_item("compare.close"));
    REQUIRE(shell->settle(60s));
    CHECK(changed_share(coloured, shell->picture(), view) > 0.05);
    REQUIRE(shell->click_item("history.compare.1"));
    CHECK(shell->app().place().comparison()->mode() == CompareMode::Deviation);
    REQUIRE(shell->click_item("history.compare.1"));
    CHECK_FALSE(shell->app().place().comparison());
}
