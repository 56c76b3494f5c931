// The surface of the image follows the iso-value while it is slid.

#include "workbench/window/features/extraction/live_extraction.h"

#include <algorithm>

#include <catch2/catch.hpp>

#include "geometry/formats/image_file.h"
#include "geometry/kernel/measure.h"
#include "tests/support/image_shapes.h"
#include "tests/support/shapes.h"
#include "tests/window/walk_support.h"
#include "tests/window/window_support.h"
#include "workbench/operations/table.h"
#include "workbench/window/keys/keys.h"

using namespace vesselbench;
using namespace vesselbench::test;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;

namespace {

const LiveExtraction& extraction_of(Driver& window) {
    return window.app().place().extraction();
}

std::string text_in(Driver& window, const std::string& field) {
    return window.app().place().form()->field(field).text;
}

constexpr double kFall = 25.0;  // of the values each mm

/// Values that fall from 200 in the middle; with 110 voxels along each side, more than a coarse
/// image has. The ball fills little of it, so that a whole extraction is quick.
Image cone_image(int size) {
    const double middle = 0.2 * (size - 1) / 2.0;
    Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
    matrix.topLeftCorner<3, 3>() *= 0.2;
    return image_of({size, size, size}, matrix, [&](const Vec3& p) {
        return std::max(200.0 - kFall * (p - Vec3::Constant(middle)).norm(), 0.0);
    });
}

void open_extraction(Driver& window, int size = 110) {
    const std::string file = temporary_folder() + "/cone.mha";
    write_image(file, cone_image(size));
    open_file(window, file);
    choose(window, "source", "extract-surface");
}

bool wait_for_whole(Driver& window) {
    return window.run_until(
        [&] { return extraction_of(window).shown() && !extraction_of(window).outdated(); }, 60s);
}

/// Opens the tab, which begins to follow.
void begin(Driver& window) {
    REQUIRE(window.click_item("form.live"));
    REQUIRE(wait_for_whole(window));
    REQUIRE(window.has("extraction.histogram"));
}

/// The cursor's place of a share of the histogram.
Eigen::Vector2f at_share(Driver& window, float share) {
    const ScreenRect rect = window.app().ui().items().at("extraction.histogram").rect;
    return {rect.x + share * rect.width, rect.middle_y()};
}

void press_at(Driver& window, float share) {
    const Eigen::Vector2f at = at_share(window, share);
    window.move_mouse(at.x(), at.y());
    window.press(MouseButton::Left);
    window.frame();
}

void slide_to(Driver& window, float share) {
    const Eigen::Vector2f at = at_share(window, share);
    window.move_mouse(at.x(), at.y());
    window.frame();
}

double iso_of(Driver& window) {
    return number_of(*window.app().place().form(), "threshold").value_or(-1.0);
}

/// Volume of the ball above a value [mm^3].
double ball_above(double iso) {
    const double radius = (200.0 - iso) / kFall;
    return 4.18879 * radius * radius * radius;
}

void slide_and_apply(Driver& window) {
    open_extraction(window);
    const std::size_t before = edit_count(window);
    begin(window);
    CHECK(window.has("banner.live"));
    CHECK_FALSE(document_of(window).current()->surface);
    press_at(window, 0.7F);
    const double first = iso_of(window);
    REQUIRE(window.run_until(
        [&] {
            const auto& shown = extraction_of(window).shown();
            return shown && shown->state.threshold == first;
        },
        60s));
    slide_to(window, 0.8F);
    CHECK(iso_of(window) > first);
    window.release(MouseButton::Left);
    REQUIRE(wait_for_whole(window));
    const double iso = iso_of(window);
    const auto seen = extraction_of(window).shown();
    CHECK(seen->state.threshold == iso);
    CHECK(volume(seen->state.surface) == Approx(ball_above(iso)).epsilon(0.03));
    CHECK(edit_count(window) == before);
    apply_form(window);
    CHECK(edit_count(window) == before + 1);
    CHECK_FALSE(window.has("banner.live"));
    const Surface& applied = *document_of(window).shown()->surface;
    CHECK(applied.points() == seen->state.surface.points());
    CHECK(std::ranges::equal(applied.triangles(), seen->state.surface.triangles()));
}

}  // namespace

SCENARIO("The iso-value slides, and Apply enters what is seen", "[window][extraction]") {
    if (const auto window = window_on(Screen::None)) slide_and_apply(*window);
}

SCENARIO("The iso-value slides on a display", "[window][extraction][walk][display]") {
    if (const auto window = window_on(Screen::Display)) slide_and_apply(*window);
}

SCENARIO("Escape brings back the iso-value from before a drag",
         "[window][extraction][walk][display]") {
    const Screen screen = GENERATE(Screen::None, Screen::Display);
    const auto window = window_on(screen);
    if (!window) return;
    open_extraction(*window);
    begin(*window);
    const double decided = *extraction_of(*window).iso(*window->app().place().form());
    press_at(*window, 0.9F);
    CHECK(iso_of(*window) > decided);
    slide_to(*window, 0.6F);
    window->press_key(keys::kEscape);
    CHECK(text_in(*window, "threshold").empty());
    // The rest of the drag does nothing.
    slide_to(*window, 0.3F);
    window->release(MouseButton::Left);
    CHECK(text_in(*window, "threshold").empty());
    REQUIRE(wait_for_whole(*window));
    CHECK(extraction_of(*window).shown()->state.threshold == decided);
}

SCENARIO("Sliding the iso-value is interrupted in the middle", "[window][extraction]") {
    const auto window = window_on(Screen::None);
    if (!window) return;
    open_extraction(*window);
    begin(*window);
    press_at(*window, 0.9F);
    slide_to(*window, 0.6F);
    THEN("a form that is left takes the surface with it") {
        window->app().place().leave_form();
        window->frame();
        CHECK_FALSE(extraction_of(*window).shown());
        window->release(MouseButton::Left);
        REQUIRE(window->settle());
        CHECK_FALSE(window->has("banner.live"));
        CHECK_FALSE(document_of(*window).shown()->surface);
    }
    THEN("a case that is closed ends it") {
        window->app().place().close();
        window->release(MouseButton::Left);
        REQUIRE(window->settle());
        CHECK_FALSE(extraction_of(*window).shown());
    }
    THEN("Apply during the drag enters the value under the cursor") {
        const double iso = iso_of(*window);
        window->app().place().apply();
        REQUIRE(window->wait_until_idle());
        window->release(MouseButton::Left);
        REQUIRE(window->settle());
        REQUIRE(document_of(*window).shown()->surface);
        CHECK(volume(*document_of(*window).shown()->surface) ==
              Approx(ball_above(iso)).epsilon(0.03));
    }
}

SCENARIO("The surface follows other fields, and can be left alone", "[window][extraction]") {
    const auto window = window_on(Screen::None);
    if (!window) return;
    open_extraction(*window, 40);
    window->app().place().slices().show_row(false);
    begin(*window);
    const auto first = extraction_of(*window).shown();
    CHECK(window->app().place().slices().in_row());
    THEN("typed values are followed") {
        REQUIRE(window->click_item("form.fields"));
        REQUIRE(window->fill_item("field.threshold", "180"));
        REQUIRE(wait_for_whole(*window));
        CHECK(extraction_of(*window).shown()->state.threshold == 180.0);
        AND_THEN("a value that nothing has is explained, and the next one works") {
            REQUIRE(window->fill_item("field.threshold", "1000"));
            REQUIRE(
                window->run_until([&] { return !extraction_of(*window).problem().empty(); }, 60s));
            CHECK_THAT(extraction_of(*window).problem(), Contains("no voxel is inside"));
            REQUIRE(window->fill_item("field.threshold", "170"));
            REQUIRE(wait_for_whole(*window));
            CHECK(extraction_of(*window).problem().empty());
        }
    }
    THEN("the outline in the slices is that of the surface") {
        REQUIRE(window->settle());
        const auto& content = window->app().place().slices().content(SlicePlane::Axial);
        REQUIRE(content);
        CHECK_FALSE(content->outline.empty());
    }
    THEN("the box switches it off, and a new form does not") {
        REQUIRE(window->click_item("live.follow"));
        window->frame();
        CHECK_FALSE(extraction_of(*window).shown());
        REQUIRE(window->settle());
        CHECK(window->app().place().slices().content(SlicePlane::Axial)->outline.empty());
        CHECK(window->has("extraction.histogram"));
        choose(*window, "source", "extract-surface");
        window->frame();
        CHECK(extraction_of(*window).follows());
    }
    THEN("the slices are as they were when the form is left") {
        window->app().place().leave_form();
        CHECK_FALSE(window->app().place().slices().in_row());
    }
    THEN("an edit is followed on the image that it reads, also if others follow it") {
        apply_form(*window);
        const EditId edit = document_of(*window).snapshot()->log.back().edit.edit.id;
        window->app().place().choose_edit(edit);
        window->frame();
        CHECK(extraction_of(*window).can_follow());
        choose(*window, "smoothing", "smooth");
        apply_form(*window);
        window->app().place().choose_edit(edit);
        REQUIRE(window->settle());
        CHECK_FALSE(document_of(*window).current()->surface);
        CHECK(extraction_of(*window).can_follow());
        REQUIRE(wait_for_whole(*window));
    }
}

SCENARIO("Newer values end the work on older ones at once", "[window][extraction]") {
    ExtractionModels models({}, live_extracting());
    const Image image = cone_image(110);
    REQUIRE(image.voxel_count() > kCoarseVoxels);
    std::uint64_t last = 0, seen = 0;
    for (int i = 0; i < 40; ++i) {
        const auto arguments =
            checked_arguments(find_operation("extract-surface"), {{"threshold", 100.0 + i}});
        last = ask(models, ExtractionQuestion{image, {}, {}, i / 20, arguments});
        std::this_thread::sleep_for(2ms);
        if (!models.poll()) continue;
        REQUIRE(models.newest()->question >= seen);
        seen = models.newest()->question;
    }
    while (models.pending()) {
        std::this_thread::sleep_for(1ms);
        static_cast<void>(models.poll());
    }
    CHECK(models.newest()->question == last);
    CHECK(models.newest()->state.whole);
    CHECK(models.newest()->state.threshold == 139.0);
}
