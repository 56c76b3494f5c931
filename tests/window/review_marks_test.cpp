#include <catch2/catch.hpp>

#include "geometry/formats/image_file.h"
#include "tests/support/image_shapes.h"
#include "tests/support/shapes.h"
#include "tests/window/review_support.h"
#include "tests/window/window_support.h"
#include "workbench/operations/table.h"
#include "workbench/project/project.h"
#include "workbench/window/drawing/screen_places.h"
#include "workbench/window/features/compare/compare_feature.h"
#include "workbench/window/features/review/review_words.h"
#include "workbench/window/features/slices/slices_feature.h"
#include "workbench/window/keys/keys.h"

using namespace vesselbench;
using namespace vesselbench::test;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;

namespace {

/// A click on the place of the model that is seen where a point is.
void click_at(OffscreenShell& shell, const Vec3& point) {
    REQUIRE(shell.has("view.area"));
    const ScreenRect view = shell.app().ui().items().at("view.area").rect;
    const auto at = on_screen(shell.app().camera(), view).place(point);
    REQUIRE(at);
    shell.click(static_cast<float>(at->x()), static_cast<float>(at->y()));
    REQUIRE(shell.settle(30s));
}

void press(OffscreenShell& shell, char upper, HeldKeys held = {}) {
    shell.press_key(keys::letter(upper), held);
    REQUIRE(wait_until_idle(shell));
    REQUIRE(shell.settle(60s));
}

ClickTool tool_of(OffscreenShell& shell) {
    return shell.app().place().view.tool;
}

/// The reviewed tube, whose edit 2 is judged by A. Kern.
std::unique_ptr<OffscreenShell> judged_tube() {
    auto shell = reviewed_tube();
    if (!shell) return nullptr;
    REQUIRE(click_in_panel(*shell, "review.edit.2"));
    say_who(*shell);
    REQUIRE(shell->settle(60s));
    return shell;
}

/// Distance from the axis of the tube [mm].
double from_axis(const Vec3& place) {
    return place.head<2>().norm();
}

const Vec3 kAbove(0, 0, 20), kBelow(0, 0, 10);  ///< on the tube's axis

}  // namespace

SCENARIO("Pins are placed on the surface and entered with the verdict", "[window][review]") {
    const auto shell = judged_tube();
    if (!shell) return;
    ReviewFeature& feature = feature_of(*shell);
    REQUIRE(click_in_panel(*shell, "review.place_pin"));
    click_at(*shell, kAbove);
    REQUIRE(feature.draft().pins.size() == 1);
    CHECK(from_axis(feature.draft().pins[0].place) == Approx(4).margin(0.3));
    CHECK(feature.draft().pins[0].place.z() == Approx(20).margin(1));
    CHECK(shell->has("view.draft.pin.0"));
    CHECK(feature.review()->files == 0);
    THEN("its text is typed at once") {
        shell->type("too thin");
        CHECK(feature.draft().pins[0].text == "too thin");
    }
    WHEN("another one is placed and the first one removed") {
        click_at(*shell, kBelow);
        REQUIRE(feature.draft().pins.size() == 2);
        REQUIRE(reveal(*shell, "review.draft.pin.1"));
        REQUIRE(shell->fill_item("review.draft.pin.1", "here"));
        REQUIRE(click_in_panel(*shell, "review.draft.pin.0.remove"));
        REQUIRE(feature.draft().pins.size() == 1);
        CHECK(feature.draft().pins[0].text == "here");
        THEN("the verdict has what is left") {
            click_and_wait(*shell, "review.accept");
            CHECK(status_of_edit(*shell, 2) == ReviewStatus::Accepted);
            REQUIRE(feature.chosen()->pins.size() == 1);
            CHECK(pin_words(feature.chosen()->pins[0]) == "A. Kern: here");
            CHECK(feature.draft().pins.empty());
            CHECK(shell->has("view.pin.2.0"));
            CHECK_FALSE(shell->has("view.draft.pin.0"));
        }
    }
    WHEN("the reviewer changes the verdict, pins that were entered stay") {
        click_and_wait(*shell, "review.unsure");
        click_and_wait(*shell, "review.accept");
        CHECK(feature.chosen()->pins.size() == 1);
    }
    WHEN("another edit is chosen, the draft waits") {
        REQUIRE(click_in_panel(*shell, "review.edit.1"));
        CHECK(feature.draft().pins.empty());
        CHECK(feature.has_draft(2));
        REQUIRE(click_in_panel(*shell, "review.edit.2"));
        CHECK(feature.draft().pins.size() == 1);
    }
    WHEN("the review is left, clicks place nothing") {
        REQUIRE(shell->click_item("rail.smoothing"));
        REQUIRE(shell->settle(60s));
        CHECK(tool_of(*shell) == ClickTool::None);
        CHECK_FALSE(shell->has("view.draft.pin.0"));
    }
    WHEN("the case is closed, the draft is gone") {
        shell->app().place().close();
        REQUIRE(shell->settle(60s));
        CHECK_FALSE(feature.has_draft(2));
    }
}

SCENARIO("Distances are placed by two clicks", "[window][review]") {
    const auto shell = judged_tube();
    if (!shell) return;
    ReviewFeature& feature = feature_of(*shell);
    REQUIRE(click_in_panel(*shell, "review.place_distance"));
    click_at(*shell, kAbove);
    CHECK(feature.first_point());
    CHECK(feature.draft().distances.empty());
    WHEN("the second place is clicked") {
        click_at(*shell, kBelow);
        REQUIRE(feature.draft().distances.size() == 1);
        CHECK(feature.draft().distances[0].length == Approx(10).margin(1));
        CHECK(shell->has("view.draft.distance.0"));
        shell->type("the neck");
        click_and_wait(*shell, "review.accept");
        THEN("it is in the verdict, in the view and in the list") {
            REQUIRE(feature.chosen()->distances.size() == 1);
            CHECK_THAT(distance_words(feature.chosen()->distances[0]),
                       Contains("A. Kern: ") && Contains(" mm, the neck"));
            CHECK(shell->has("view.distance.2.0"));
            REQUIRE(click_in_panel(*shell, "review.distance.0"));
            CHECK(shell->app().place().looked_at().value().z() == Approx(15).margin(1));
        }
        THEN("the project has its measured length") {
            const auto project = shell->app().place().document.project();
            shell->app().place().close();
            REQUIRE(shell->settle(60s));
            const Session session = Session::open(project, session_options());
            const ReviewedDistance stored = review_of(session).edits.at(1).distances.at(0).distance;
            CHECK(stored.length == Approx((stored.to - stored.from).norm()));
        }
    }
    WHEN("Esc is pressed, nothing is placed") {
        shell->press_key(keys::kEscape);
        CHECK(tool_of(*shell) == ClickTool::None);
        shell->frame();
        CHECK_FALSE(feature.first_point());
        click_at(*shell, kBelow);
        CHECK(feature.draft().distances.empty());
    }
    WHEN("a click misses the model, the first end still waits") {
        const ScreenRect view = shell->app().ui().items().at("view.area").rect;
        shell->click(view.x + view.width - 60, view.middle_y());
        REQUIRE(shell->settle(30s));
        CHECK(feature.first_point());
        CHECK(feature.draft().distances.empty());
    }
}

SCENARIO("Imported marks are in the view and in the list", "[window][review]") {
    const auto shell = reviewed_tube();
    if (!shell) return;
    import_roth(*shell);
    CHECK(shell->has("view.pin.2.0"));
    CHECK(shell->has("view.distance.2.0"));
    CHECK(shell->has("view.distance.2.0.from"));
    REQUIRE(click_in_panel(*shell, "review.edit.2"));
    REQUIRE(click_in_panel(*shell, "review.distance.0"));
    CHECK(shell->app().place().looked_at() == Vec3(0, 0, 5));
    REQUIRE(shell->click_item("rail.smoothing"));
    CHECK_FALSE(shell->has("view.distance.2.0"));
}

SCENARIO("The whole model is judged in the review step", "[window][review]") {
    const auto shell = reviewed_tube();
    if (!shell) return;
    ReviewFeature& feature = feature_of(*shell);
    REQUIRE(click_in_panel(*shell, "review.whole"));
    say_who(*shell);
    CHECK(feature.judges_whole());
    CHECK_FALSE(shell->has("review.place_pin"));
    CHECK_FALSE(click_in_panel(*shell, "review.reject"));
    WHEN("it is rejected with a reason") {
        REQUIRE(reveal(*shell, "review.comment"));
        REQUIRE(shell->fill_item("review.comment", "a branch is missing"));
        click_and_wait(*shell, "review.reject");
        CHECK(status_of_whole(*feature.review()) == ReviewStatus::Rejected);
        CHECK(remark_of(feature.review()->overall) == "A. Kern: a branch is missing");
        CHECK(status_of_edit(*shell, 2) == ReviewStatus::Open);
        CHECK(shell->app().place().document.messages().back().text == "Rejected the whole model");
    }
    WHEN("it is accepted") {
        click_and_wait(*shell, "review.accept");
        CHECK(status_of_whole(*feature.review()) == ReviewStatus::Accepted);
        THEN("a change of an edit makes that outdated") {
            shell->app().place().document.change(2, {{"iterations", Value(std::int64_t{3})}});
            REQUIRE(wait_until_idle(*shell));
            REQUIRE(shell->settle(60s));
            CHECK(status_of_whole(*feature.review()) == ReviewStatus::Outdated);
        }
    }
}

SCENARIO("The review step has the keys of the review page", "[window][review][keys]") {
    const auto shell = reviewed_tube();
    if (!shell) return;
    ReviewFeature& feature = feature_of(*shell);
    const auto judged = [&] { return feature.chosen() == nullptr ? 0 : feature.chosen()->edit.id; };
    press(*shell, 'J');
    CHECK(judged() == 1);
    say_who(*shell);
    press(*shell, 'J');
    CHECK(judged() == 2);
    WHEN("the list ends, the whole model is the last") {
        press(*shell, 'J');
        CHECK(feature.judges_whole());
        press(*shell, 'J');
        CHECK(feature.judges_whole());
        press(*shell, 'K');
        CHECK(judged() == 2);
    }
    WHEN("verdicts are given") {
        press(*shell, 'A', {.shift = true});
        CHECK(status_of_edit(*shell, 2) == ReviewStatus::Accepted);
        press(*shell, 'U');
        CHECK(feature.chosen()->verdicts.at(0).verdict == Verdict::Unsure);
    }
    WHEN("a rejection has no reason, its field gets the keyboard") {
        press(*shell, 'R');
        shell->type("too smooth");
        CHECK(feature.draft().comment == "too smooth");
        shell->press_key(keys::kEnter);
        press(*shell, 'R');
        CHECK(status_of_edit(*shell, 2) == ReviewStatus::Rejected);
    }
    WHEN("a comment is asked for") {
        press(*shell, 'C', {.shift = true});
        shell->type("ruja");
        CHECK(feature.draft().comment == "ruja");
        CHECK(judged() == 2);
        CHECK(status_of_edit(*shell, 2) == ReviewStatus::Open);
    }
    WHEN("marks are placed") {
        press(*shell, 'P');
        CHECK(tool_of(*shell) == ClickTool::ReviewPin);
        press(*shell, 'D', {.shift = true});
        CHECK(tool_of(*shell) == ClickTool::ReviewDistance);
        press(*shell, 'D', {.shift = true});
        CHECK(tool_of(*shell) == ClickTool::None);
    }
    WHEN("another step is shown, they do nothing") {
        REQUIRE(shell->click_item("rail.smoothing"));
        press(*shell, 'U');
        press(*shell, 'P');
        press(*shell, 'J');
        CHECK(judged() == 2);
        CHECK(tool_of(*shell) == ClickTool::None);
        CHECK(feature.review()->files == 0);
    }
    THEN("without an edit they do nothing") {
        REQUIRE(click_in_panel(*shell, "review.edit.2"));
        REQUIRE(judged() == 0);
        press(*shell, 'U');
        press(*shell, 'P');
        press(*shell, 'B');
        CHECK(tool_of(*shell) == ClickTool::None);
        CHECK(feature.review()->files == 0);
    }
}

SCENARIO("The models before and after an edit blink", "[window][review]") {
    const auto shell = reviewed_tube();
    if (!shell) return;
    smooth_strongly(*shell);
    ReviewFeature& feature = feature_of(*shell);
    Workplace& place = shell->app().place();
    const std::size_t newest = place.document.shown()->surface->vertex_count();
    const Positions last = place.document.shown()->surface->points();
    REQUIRE(click_in_panel(*shell, "review.edit.2"));
    press(*shell, 'B');
    REQUIRE(place.comparison());
    REQUIRE(place.comparison()->mode() == CompareMode::Blink);
    REQUIRE(place.comparison()->scene() != nullptr);
    const auto result = [&](EditId id) {
        return place.document.runner()
            ->submit([id](Session& session, const Progress& progress) {
                return session.scene_after(id, progress);
            })
            .result();
    };
    THEN("they are those of this edit, without later ones") {
        CHECK(place.comparison()->scene()->surface->points() == result(1).surface->points());
        CHECK(place.document.shown()->surface->points() == result(2).surface->points());
        CHECK(place.document.shown()->surface->points() != last);
        CHECK(place.document.shown()->surface->vertex_count() == newest);
    }
    WHEN("the key is pressed again, the newest model is shown") {
        press(*shell, 'B');
        CHECK_FALSE(place.comparison());
        CHECK(place.document.shown()->surface->points() == last);
    }
    WHEN("Esc is pressed") {
        shell->press_key(keys::kEscape);
        REQUIRE(shell->settle(60s));
        CHECK_FALSE(place.comparison());
        CHECK(place.document.shown()->surface->points() == last);
    }
    WHEN("another edit is chosen") {
        REQUIRE(click_in_panel(*shell, "review.edit.3"));
        REQUIRE(shell->settle(60s));
        CHECK_FALSE(place.comparison());
        CHECK(place.document.shown()->surface->points() == last);
    }
    WHEN("the edit's form is opened, its input is shown") {
        REQUIRE(click_in_panel(*shell, "review.correct"));
        REQUIRE(shell->settle(60s));
        CHECK_FALSE(place.comparison());
        CHECK(place.document.shown()->surface->points() == result(1).surface->points());
    }
    THEN("the first edit has no model before it") {
        REQUIRE(click_in_panel(*shell, "review.edit.1"));
        CHECK(feature.blink().why_not(1) == "no model precedes it");
        CHECK_FALSE(click_in_panel(*shell, "review.blink"));
    }
}

SCENARIO("Marks are seen in the slices that they lie in", "[window][review][slices]") {
    const auto shell = test_shell();
    if (!shell) return;
    const Eigen::Matrix4d matrix = oblique_matrix({1, 1, 1.5}, {-20, 0, -60});
    const Image image = image_of({24, 20, 16}, matrix, [](const Vec3& p) { return p.z(); });
    const std::string path = temporary_folder() + "/image.mha";
    write_image(path, image);
    open_and_wait(*shell, path);
    REQUIRE(shell->click_item("rail.review"));
    REQUIRE(shell->settle(60s));
    ImageSlices& slices = shell->app().place().slices();
    const Vec3 place = slices.cross(), step = slices.grid().step;
    ReviewFeature& feature = feature_of(*shell);
    feature.choose(1);
    feature.draft().pins = {{.place = place + Vec3(0.3 * step.x(), 0, 0), .text = "here"}};
    feature.draft().distances = {distance_between(place, place + Vec3(0, 3 * step.y(), 0))};
    const auto shows = [&](const std::string& item) {
        REQUIRE(shell->settle(60s));
        return shell->has(item);
    };
    CHECK(shows("slice.axial.draft.pin.0"));
    CHECK(shows("slice.sagittal.draft.pin.0"));
    THEN("a distance is seen where one of its ends is") {
        CHECK(shows("slice.axial.draft.distance.0"));
        CHECK(shows("slice.axial.draft.distance.0.from"));
        CHECK(shows("slice.coronal.draft.distance.0.from"));
        CHECK_FALSE(shows("slice.coronal.draft.distance.0"));
    }
    WHEN("the slice is another one, its marks are not seen") {
        slices.step(SlicePlane::Sagittal, 1);
        slices.step(SlicePlane::Axial, -1);
        CHECK_FALSE(shows("slice.sagittal.draft.pin.0"));
        CHECK_FALSE(shows("slice.axial.draft.pin.0"));
        CHECK(shows("slice.coronal.draft.pin.0"));
    }
}
