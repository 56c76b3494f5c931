// The gallery of suggestions, and the spots that are inspected in it.

#include <cmath>

#include <catch2/catch.hpp>

#include "geometry/formats/surface_file.h"
#include "tests/support/paths.h"
#include "tests/support/program.h"
#include "tests/support/shapes.h"
#include "tests/window/walk_support.h"
#include "tests/window/window_support.h"
#include "workbench/operations/table.h"
#include "workbench/window/drawing/screen_places.h"
#include "workbench/window/features/compare/compare_feature.h"
#include "workbench/window/features/gallery/gallery_feature.h"
#include "workbench/window/features/gallery/suggestion_gallery.h"
#include "workbench/window/features/live/live_feature.h"
#include "workbench/window/keys/keys.h"
#include "workbench/worker/run_operation.h"

using namespace vesselbench;
using namespace vesselbench::test;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;

namespace {

/// A tube along z whose wall is rough.
std::string noisy_tube_file(int around) {
    const Surface tube = fine_tube(4.0, 30.0, around);
    Positions points = tube.points();
    for (std::size_t v = 0; v < points.size(); ++v) {
        const double noise = std::sin(12.9898 * static_cast<double>(v)) * 43758.5453;
        const Vec3 outward = Vec3(points[v].x(), points[v].y(), 0.0);
        if (outward.norm() > 3.9) points[v] += 0.08 * (noise - std::floor(noise)) * outward / 4.0;
    }
    const std::string file = temporary_folder() + "/noisy.stl";
    write_surface(tube.with_positions(points), file);
    return file;
}

SuggestionGallery& gallery_of(Driver& window) {
    return window.app().place().gallery();
}

void open_smooth(Driver& window, int around = 30) {
    open_file(window, noisy_tube_file(around));
    choose(window, "smoothing", "smooth");
    REQUIRE(window.click_item("form.live"));
}

bool knows_all(const SuggestionGallery& gallery) {
    return gallery.suggestion(SuggestionGallery::kCount - 1) != nullptr;
}

void wait_for_suggestions(Driver& window) {
    REQUIRE(window.run_until([&] { return knows_all(gallery_of(window)); }, 120s));
    REQUIRE(window.settle());
}

Eigen::Vector2f middle_of(Driver& window, const std::string& item) {
    REQUIRE(window.has(item));
    const ScreenRect rect = window.app().ui().items().at(item).rect;
    return {rect.middle_x(), rect.middle_y()};
}

void double_click(Driver& window, const std::string& item) {
    const Eigen::Vector2f at = middle_of(window, item);
    window.move_mouse(at.x(), at.y());
    for (int i = 0; i < 2; ++i) {
        window.press(MouseButton::Left);
        window.release(MouseButton::Left);
    }
    window.frame();
}

/// The form holds a suggestion's values, and the model follows it.
void check_taken(Driver& window, const PresetSuggestion& suggestion) {
    Workplace& place = window.app().place();
    CHECK(place.gallery().mode() == GalleryMode::Off);
    CHECK(place.form()->arguments() == suggestion.arguments);
    CHECK(place.live().follows());
}

void take_by_double_click(Driver& window) {
    double_click(window, "gallery.cell.1");
}

/// On a display, the second click of two may come too late.
void take_by_button(Driver& window) {
    REQUIRE(window.click_item("gallery.take.1"));
}

void take_and_apply(Driver& window, void (*take)(Driver&)) {
    open_smooth(window);
    REQUIRE(window.click_item("live.gallery"));
    wait_for_suggestions(window);
    const ViewCamera before = window.app().camera();
    const Eigen::Vector2f at = middle_of(window, "gallery.cell.2");
    window.drag(at.x(), at.y(), at.x() + 30, at.y() + 10);
    CHECK((window.app().camera().view - before.view).norm() > 0.05);
    const auto taken = gallery_of(window).suggestion(1);
    const Scene scene = *document_of(window).current();
    take(window);
    check_taken(window, *taken);
    apply_form(window);
    CHECK(edit_count(window) == 2);
    const Operation& smooth = find_operation("smooth");
    const Outcome made =
        run_without_figures(smooth, scene, checked_arguments(smooth, taken->arguments), {});
    const Positions& applied = document_of(window).shown()->surface->points();
    CHECK(applied == made.scene.surface->points());
    CHECK(applied == taken->surface.points());
    CHECK_FALSE(window.has("gallery.cell.0"));
}

/// Where the model's wall is seen from outside.
Eigen::Vector2f wall_at(Driver& window, double z) {
    const ViewCamera& camera = window.app().camera();
    const Vec3 towards(-camera.view.x(), -camera.view.y(), 0.0);
    const Vec3 point = 4.0 * towards.normalized() + Vec3(0, 0, z);
    ScreenRect rect = window.app().ui().items().at("view.area").rect;
    rect.width = window.app().ui().items().at("gallery.cell.0").rect.x - rect.x;
    const auto place = on_screen(camera, rect).place(point);
    REQUIRE(place);
    return place->cast<float>();
}

/// Pixels of a part of the window that are much darker than the second one beside them.
int lines_in(const Picture& picture, const ScreenRect& part) {
    constexpr int kMuch = 25;
    const auto green = [&](int x, int y) {
        return int(picture.rgb[3 * (y * picture.width + x) + 1]);
    };
    int count = 0;
    for (int y = int(part.y); y < int(part.y + part.height); ++y)
        for (int x = int(part.x); x < int(part.x + part.width); ++x)
            count += green(x + 2, y) - green(x, y) > kMuch ? 1 : 0;
    return count;
}

void add_spot(Driver& window, double z) {
    const SpotList& spots = gallery_of(window).spots;
    const std::size_t before = spots.all().size();
    if (before > 0) REQUIRE(window.click_item("spot.pick"));
    const Eigen::Vector2f at = wall_at(window, z);
    window.click(at.x(), at.y());
    REQUIRE(window.run_until([&] { return spots.all().size() == before + 1; }, 20s));
    REQUIRE(window.settle());
    const Spot& spot = spots.all().back();
    CHECK(spots.chosen() == &spot);
    CHECK(std::abs(spot.point.z() - z) < 0.6);
    CHECK(spot.normal.norm() == Approx(1.0));
    CHECK(spot.normal.dot(Vec3(spot.point.x(), spot.point.y(), 0.0)) > 0.0);
}

/// Three spots are kept, and are there when the project is opened again.
void keep_spots(Driver& window) {
    open_smooth(window);
    REQUIRE(window.click_item("live.spots"));
    for (const double z : {8.0, 15.0, 22.0}) add_spot(window, z);
    REQUIRE(window.settle());
    const SpotList& spots = gallery_of(window).spots;
    const std::vector<Spot> kept = spots.all();
    REQUIRE(kept.size() == 3);
    const std::filesystem::path project = document_of(window).project();
    window.app().place().close();
    REQUIRE(window.settle());
    CHECK(spots.all().empty());
    open_file(window, project.string());
    REQUIRE(window.run_until([&] { return spots.is_read(); }, 20s));
    CHECK(spots.all() == kept);
}

}  // namespace

SCENARIO("A suggestion of the gallery is taken by a double click", "[window][gallery]") {
    if (const auto window = window_on(Screen::None)) take_and_apply(*window, take_by_double_click);
}

SCENARIO("A suggestion of the gallery is taken on a display", "[window][gallery][walk][display]") {
    if (const auto window = window_on(Screen::Display)) take_and_apply(*window, take_by_button);
}

SCENARIO("Turning the view turns the three models alike", "[window][gallery]") {
    const auto shell = test_shell();
    if (!shell) return;
    open_and_wait(*shell, noisy_tube_file(30));
    shell->app().place().choose("smooth");
    shell->frame();
    shell->app().place().get<GalleryFeature>().show(GalleryMode::Models);
    REQUIRE(shell->run_until([&] { return knows_all(shell->app().place().gallery()); }, 120s));
    REQUIRE(shell->settle(60s));
    const auto parts = [&] {
        const Picture picture = shell->picture();
        std::vector<std::vector<std::uint8_t>> found;
        for (const int i : {0, 1, 2}) {
            const ScreenRect rect =
                shell->app().ui().items().at("gallery.cell." + std::to_string(i)).rect;
            std::vector<std::uint8_t>& pixels = found.emplace_back();
            const int left = static_cast<int>(rect.middle_x()) - 60;
            const int top = static_cast<int>(rect.middle_y()) - 60;
            for (int y = top; y < top + 120; ++y)
                for (int x = left; x < left + 120; ++x)
                    pixels.push_back(
                        picture.rgb[static_cast<std::size_t>(y * picture.width + x) * 3]);
        }
        return found;
    };
    shell->move_mouse(-1e4F, -1e4F);
    shell->frame();
    const auto before = parts();
    CHECK(before[0] != before[2]);
    const ScreenRect middle = shell->app().ui().items().at("gallery.cell.1").rect;
    shell->drag(middle.middle_x(), middle.middle_y(), middle.middle_x() + 70,
                middle.middle_y() + 20, MouseButton::Left);
    shell->move_mouse(-1e4F, -1e4F);
    REQUIRE(shell->settle(60s));
    const auto after = parts();
    for (const int i : {0, 1, 2}) CHECK(before[i] != after[i]);
}

SCENARIO("The button of a suggestion takes it, and the others stay known", "[window][gallery]") {
    const auto window = window_on(Screen::None);
    if (!window) return;
    open_smooth(*window);
    point_at_view(*window);
    window->press_key(keys::letter('G'));
    CHECK(gallery_of(*window).mode() == GalleryMode::Models);
    wait_for_suggestions(*window);
    const auto strong = gallery_of(*window).suggestion(2),
               little = gallery_of(*window).suggestion(0);
    CHECK(strong->curvature_percent <= little->curvature_percent);
    REQUIRE(window->click_item("gallery.take.2"));
    check_taken(*window, *strong);
    REQUIRE(window->click_item("live.gallery"));
    window->frame();
    CHECK(gallery_of(*window).suggestion(0) == little);
    CHECK_FALSE(gallery_of(*window).searches());
    THEN("Escape leaves the gallery, and keeps the form") {
        window->press_key(keys::kEscape);
        CHECK(gallery_of(*window).mode() == GalleryMode::Off);
        CHECK(window->app().place().form());
    }
    THEN("another filter has suggestions of its own") {
        REQUIRE(window->click_item("form.fields"));
        REQUIRE(window->fill_item("field.filter", "taubin"));
        window->frame();
        CHECK(gallery_of(*window).suggestion(0) != little);
        wait_for_suggestions(*window);
        CHECK(gallery_of(*window).suggestion(0)->arguments.text("filter") == "taubin");
    }
    THEN("a preview, a graph and a comparison take its place") {
        REQUIRE(window->click_item("operation.preview"));
        CHECK(gallery_of(*window).mode() == GalleryMode::Off);
        REQUIRE(window->wait_until_idle());
        window->app().place().get<GalleryFeature>().show(GalleryMode::Models);
        CHECK_FALSE(document_of(*window).previewed());
        window->app().place().get<LiveFeature>().begin_driving();
        CHECK(gallery_of(*window).mode() == GalleryMode::Off);
        window->app().place().end_drag();
        window->app().place().get<GalleryFeature>().show(GalleryMode::Models);
        window->app().place().get<CompareFeature>().compare(0);
        CHECK(gallery_of(*window).mode() == GalleryMode::Off);
        window->app().place().get<GalleryFeature>().show(GalleryMode::Models);
        CHECK_FALSE(window->app().place().comparison());
    }
}

SCENARIO("The gallery is interrupted while it searches", "[window][gallery]") {
    const auto window = window_on(Screen::None);
    if (!window) return;
    open_smooth(*window, 96);
    REQUIRE(window->click_item("live.gallery"));
    window->frame();
    REQUIRE(gallery_of(*window).searches());
    THEN("a double click on what is not known yet does nothing") {
        double_click(*window, "gallery.cell.2");
        CHECK(gallery_of(*window).mode() == GalleryMode::Models);
        CHECK(window->app().place().form()->arguments() == Arguments());
    }
    THEN("the form is left") {
        window->press_key(keys::kEscape);
        window->press_key(keys::kEscape);
        CHECK_FALSE(window->app().place().form());
        REQUIRE(window->settle());
        CHECK_FALSE(gallery_of(*window).original());
    }
    THEN("the project is closed") {
        window->app().place().close();
        REQUIRE(window->settle());
        CHECK(gallery_of(*window).mode() == GalleryMode::Off);
    }
    THEN("another file is opened") {
        open_file(*window, tube_file());
        CHECK(gallery_of(*window).mode() == GalleryMode::Off);
    }
    THEN("a value is changed, and the last one counts") {
        window->app().place().set_field("filter", "taubin");
        window->frame();
        window->app().place().set_field("filter", "laplace");
        wait_for_suggestions(*window);
        CHECK(gallery_of(*window).suggestion(2)->arguments.text("filter") == "laplace");
    }
    THEN("the form is applied as it is") {
        apply_form(*window);
        CHECK(edit_count(*window) == 2);
        CHECK(gallery_of(*window).mode() == GalleryMode::Off);
    }
}

SCENARIO("Spots are kept with the project on a display",
         "[window][gallery][spots][walk][display]") {
    if (const auto window = window_on(Screen::Display)) keep_spots(*window);
}

SCENARIO("The gallery is left while it searches on a display", "[window][gallery][walk][display]") {
    const auto window = window_on(Screen::Display);
    if (!window) return;
    open_smooth(*window, 96);
    REQUIRE(window->click_item("live.gallery"));
    window->press_key(keys::kEscape);
    CHECK(gallery_of(*window).mode() == GalleryMode::Off);
    window->press_key(keys::kEscape);
    CHECK_FALSE(window->app().place().form());
    REQUIRE(window->settle());
    CHECK_FALSE(gallery_of(*window).original());
    CHECK(edit_count(*window) == 1);
}

SCENARIO("Spots are kept with the project", "[window][gallery][spots]") {
    const auto window = window_on(Screen::None);
    if (!window) return;
    open_smooth(*window);
    REQUIRE(window->click_item("live.spots"));
    const SpotList& spots = gallery_of(*window).spots;
    CHECK(gallery_of(*window).picks());
    for (const double z : {8.0, 15.0, 22.0}) add_spot(*window, z);
    CHECK_FALSE(gallery_of(*window).picks());
    wait_for_suggestions(*window);
    REQUIRE(window->fill_item("spot.name.1", "narrowing"));
    REQUIRE(window->settle());
    const std::vector<Spot> kept = spots.all();
    REQUIRE(kept.size() == 3);
    CHECK(kept[1].name == "narrowing");
    const std::filesystem::path project = document_of(*window).project();
    CHECK(stored_spots(project) == kept);
    THEN("a click on a mark chooses its spot") {
        const Eigen::Vector2f at = wall_at(*window, kept[0].point.z());
        window->click(at.x(), at.y());
        CHECK(spots.chosen()->name == "Spot 1");
    }
    THEN("one is removed, and its name is free again") {
        REQUIRE(window->click_item("spot.remove.0"));
        REQUIRE(window->settle());
        CHECK(stored_spots(project).size() == 2);
        add_spot(*window, 8.0);
        CHECK(spots.all().back().name == "Spot 1");
    }
    THEN("they come back after an edit, its undo, and when the project is opened again") {
        double_click(*window, "gallery.cell.0");
        apply_form(*window);
        CHECK(spots.all() == kept);
        REQUIRE(window->click_item("tool.undo"));
        REQUIRE(window->wait_until_idle());
        CHECK(spots.all() == kept);
        window->app().place().close();
        REQUIRE(window->settle());
        CHECK(spots.all().empty());
        open_file(*window, project.string());
        REQUIRE(window->run_until([&] { return spots.is_read(); }, 20s));
        CHECK(spots.all() == kept);
        CHECK(stored_log(project).size() == 1);
    }
    THEN("what was changed last is stored, although the project is closed at once") {
        window->app().place().gallery().spots.rename(2, "last");
        window->app().place().close();
        CHECK(stored_spots(project)[2].name == "last");
    }
    THEN("Escape ends picking first, then the view of spots") {
        REQUIRE(window->click_item("spot.pick"));
        CHECK(gallery_of(*window).picks());
        window->press_key(keys::kEscape);
        CHECK_FALSE(gallery_of(*window).picks());
        CHECK(gallery_of(*window).mode() == GalleryMode::Spots);
        window->press_key(keys::kEscape);
        CHECK(gallery_of(*window).mode() == GalleryMode::Off);
        CHECK(window->app().place().form());
    }
    THEN("the original's wireframe is drawn over the suggestion") {
        window->move_mouse(2, 2);
        REQUIRE(window->settle());
        const auto& items = window->app().ui().items();
        const Picture picture = window->picture().value();
        const Eigen::Vector2f lower = wall_at(*window, 17.0), upper = wall_at(*window, 20.0);
        ScreenRect plain{lower.x() - 20, upper.y(), 40, lower.y() - upper.y()};
        CHECK(lines_in(picture, plain) == 0);
        ScreenRect spot = items.at("gallery.cell.1").rect;
        plain = {spot.middle_x() - 20, spot.y + 0.25F * spot.height, 40, 0.25F * spot.height};
        CHECK(lines_in(picture, plain) > 100);
    }
    THEN("the wheel magnifies a spot, and leaves the camera alone") {
        const ViewCamera camera = window->app().camera();
        const int drawings = window->app().drawings();
        const Eigen::Vector2f at = middle_of(*window, "gallery.cell.1");
        window->move_mouse(at.x(), at.y());
        window->wheel(3);
        window->drag(at.x(), at.y(), at.x() + 40, at.y() + 20);
        REQUIRE(window->settle());
        CHECK(window->app().camera() == camera);
        CHECK(window->app().drawings() > drawings);
    }
}

SCENARIO("Spots of a project that cannot be written say so", "[window][gallery][spots]") {
    const auto window = window_on(Screen::None);
    if (!window) return;
    const std::string project = temporary_folder() + "/held.vbench";
    REQUIRE(run_program(program_path(), {"new", project, noisy_tube_file(30)}).exit_code == 0);
    store_spots(project, {{.name = "old", .point = Vec3(0, -4, 0)}});
    const Session other = Session::open(project, session_options());
    open_file(*window, project);
    REQUIRE_FALSE(document_of(*window).snapshot()->read_only_reason.empty());
    choose(*window, "smoothing", "smooth");
    REQUIRE(window->click_item("form.live"));
    REQUIRE(window->click_item("live.spots"));
    const SpotList& spots = gallery_of(*window).spots;
    REQUIRE(window->run_until([&] { return spots.is_read(); }, 20s));
    CHECK(spots.all().size() == 1);
    CHECK_THAT(spots.not_stored(), Contains("read-only"));
    add_spot(*window, 20.0);
    CHECK(spots.all().size() == 2);
    window->app().place().close();
    REQUIRE(window->settle());
    CHECK(stored_spots(project).size() == 1);
}

SCENARIO("A change of the spots that cannot be stored is told at the end",
         "[window][gallery][spots]") {
    const std::string folder = temporary_folder(), project = folder + "/gone.vbench";
    REQUIRE(run_program(program_path(), {"new", project, noisy_tube_file(30)}).exit_code == 0);
    SpotList spots({});
    spots.open(project, "");
    while (!spots.is_read()) static_cast<void>(spots.update());
    static_cast<void>(spots.update());
    std::filesystem::remove(project);
    spots.add(Vec3::Zero(), Vec3::UnitX());
    CHECK_THAT(spots.close(), Contains("gone.vbench"));
    CHECK(spots.all().empty());
    CHECK(spots.close().empty());
}

SCENARIO("Stored spots that cannot be read are not written over", "[window][gallery][spots]") {
    const std::string project = temporary_folder() + "/no_project.vbench";
    SpotList spots({});
    spots.open(project, "");
    while (!spots.is_read()) static_cast<void>(spots.update());
    static_cast<void>(spots.update());
    CHECK_THAT(spots.not_stored(), Contains("cannot be read"));
    spots.add(Vec3::Zero(), Vec3::UnitX());
    CHECK(spots.all().size() == 1);
    CHECK_FALSE(spots.pending());
    spots.remove(0);
    CHECK(spots.chosen() == nullptr);
}
