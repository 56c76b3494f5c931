#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include <catch2/catch.hpp>

#include "geometry/formats/surface_file.h"
#include "geometry/kernel/whole_file.h"
#include "geometry/kernel/wording.h"
#include "gpu/device.h"
#include "gpu/png.h"
#include "gpu/render/view_camera.h"
#include "tests/support/paths.h"
#include "tests/support/shapes.h"
#include "tests/support/stack_phantoms.h"
#include "tests/window/faulty_device.h"
#include "tests/window/window_support.h"
#include "workbench/window/drawing/screen_places.h"
#include "workbench/window/keys/keys.h"

using namespace vesselbench;
using namespace vesselbench::test;
using namespace std::chrono_literals;

namespace {

std::string capped_tube_file() {
    const std::string file = temporary_folder() + "/tube.vtp";
    write_surface(fine_tube(4.0, 30.0, 24), file);
    return file;
}

/// A window with the tube, and its settings.
struct Seen {
    explicit Seen(const std::string& file = capped_tube_file()) : shell(test_shell()) {
        if (shell) open_and_wait(*shell, file);
    }

    Workplace& place() { return shell->app().place(); }

    ScreenRect view() {
        REQUIRE(shell->has("view.area"));
        return shell->app().ui().items().at("view.area").rect;
    }

    void key(char letter) {
        shell->press_key(keys::letter(letter));
        REQUIRE(shell->settle(60s));
    }

    /// Where a point is seen in the window.
    Eigen::Vector2f at(const Vec3& point) {
        const auto place = on_screen(shell->app().camera(), view()).place(point);
        REQUIRE(place);
        return place->cast<float>();
    }

    void click(const Vec3& point) {
        const Eigen::Vector2f where = at(point);
        shell->click(where.x(), where.y());
        REQUIRE(shell->settle(30s));
    }

    /// The view's pixels around its middle, where no control is.
    std::vector<std::uint8_t> pixels() {
        const ScreenRect rect = view();
        const Picture picture = shell->picture();
        std::vector<std::uint8_t> found;
        for (int y = static_cast<int>(rect.middle_y()) - 40; y < rect.middle_y() + 40; ++y)
            for (int x = static_cast<int>(rect.middle_x()) - 60; x < rect.middle_x() + 60; ++x)
                for (int part = 0; part < 3; ++part)
                    found.push_back(
                        picture.rgb[static_cast<std::size_t>((y * picture.width + x) * 3 + part)]);
        return found;
    }

    std::unique_ptr<OffscreenShell> shell;
};

}  // namespace

SCENARIO("Colours are chosen in the view's options", "[window][view]") {
    Seen seen;
    if (!seen.shell) return;
    const auto plain = seen.pixels();
    REQUIRE(seen.shell->click_item("view.options"));
    REQUIRE(seen.shell->click_item("view.colours"));
    REQUIRE(seen.shell->click_item("view.colours=Mean curvature"));
    REQUIRE(seen.shell->settle(60s));
    seen.key('V');
    CHECK_FALSE(seen.shell->has("view.colours"));
    REQUIRE(seen.place().view_data().colours());
    const auto coloured = seen.pixels();
    CHECK(coloured != plain);
    WHEN("a range is typed") {
        seen.key('V');
        REQUIRE(seen.shell->fill_item("view.least", "0"));
        REQUIRE(seen.shell->fill_item("view.most", "1"));
        CHECK(seen.place().view.range() == ValueRange{0, 1});
        seen.shell->press_key(keys::kEnter);
        seen.shell->press_key(keys::kEscape);
        CHECK_FALSE(seen.shell->has("view.least"));
        const auto ranged = seen.pixels();
        CHECK(ranged != coloured);
        THEN("another quantity has its own range") {
            REQUIRE(seen.shell->click_item("view.deviation"));
            REQUIRE(seen.shell->click_item("view.deviation"));
            REQUIRE(seen.shell->settle(60s));
            seen.key('V');
            CHECK_FALSE(seen.place().view.range());
            seen.key('V');
            CHECK(seen.pixels() == coloured);
        }
    }
    WHEN("the colours are switched off and on") {
        REQUIRE(seen.shell->click_item("view.deviation"));
        REQUIRE(seen.shell->settle(60s));
        CHECK(seen.place().view.colouring == ColouringKind::Patches);
        CHECK(seen.pixels() == plain);
        REQUIRE(seen.shell->click_item("view.deviation"));
        CHECK(seen.place().view.colouring == ColouringKind::MeanCurvature);
    }
}

SCENARIO("What the mouse has moved is drawn with smooth edges when it is let go",
         "[window][view]") {
    Seen seen;
    if (!seen.shell) return;
    OffscreenShell& shell = *seen.shell;
    const float x = seen.view().middle_x(), y = seen.view().middle_y();
    const auto differing_colours = [&] {
        const auto pixels = seen.pixels();
        std::set<std::array<std::uint8_t, 3>> colours;
        for (std::size_t i = 0; i < pixels.size(); i += 3)
            colours.insert({pixels[i], pixels[i + 1], pixels[i + 2]});
        return colours.size();
    };
    seen.place().settings.layers.edges = true;
    shell.move_mouse(x, y);
    shell.press(MouseButton::Left);
    shell.move_mouse(x + 60, y + 30);
    shell.frame();
    const std::size_t held = differing_colours();
    const int drawings = shell.app().drawings();
    shell.release(MouseButton::Left);
    REQUIRE(shell.settle(30s));
    // Where a graphics processor draws, edges are smooth all the time.
    CHECK(shell.app().drawings() == drawings + (draws_in_software() ? 1 : 0));
    if (draws_in_software()) CHECK(differing_colours() > held);
    const int rested = shell.app().drawings();
    shell.frame();
    CHECK(shell.app().drawings() == rested);
}

SCENARIO("A key shows the worst places of the colours in turn", "[window][view]") {
    Seen seen;
    if (!seen.shell) return;
    const auto newest = [&] { return seen.place().document.messages().back().text; };
    seen.key('X');
    CHECK_THAT(newest(), Catch::Contains("Choose colours first"));
    CHECK_FALSE(seen.place().looked_at());
    seen.place().view.choose(ColouringKind::TriangleQuality);
    REQUIRE(seen.shell->settle(60s));
    seen.key('X');
    REQUIRE(seen.place().looked_at());
    const Vec3 worst = *seen.place().looked_at();
    const auto& values = seen.place().view_data().colours()->values;
    CHECK_THAT(newest(), Catch::Contains(formatted(std::ranges::min(values))) &&
                             Catch::Contains("worst place 1 of 10"));
    seen.key('X');
    CHECK(*seen.place().looked_at() != worst);
    CHECK_THAT(newest(), Catch::Contains("worst place 2 of 10"));
    seen.shell->press_key(keys::letter('X'), {.shift = true});
    CHECK(*seen.place().looked_at() == worst);
    seen.shell->press_key(keys::letter('X'), {.shift = true});
    CHECK_THAT(newest(), Catch::Contains("worst place 10 of 10"));
}

SCENARIO("The view flies to a worst place, and turns to its outside", "[window][view]") {
    Seen seen;
    if (!seen.shell) return;
    const auto camera = [&] { return seen.shell->app().camera(); };
    seen.place().view.choose(ColouringKind::MeanCurvature);
    REQUIRE(seen.shell->settle(60s));
    const ViewCamera before = camera();
    seen.shell->press_key(keys::letter('X'));
    REQUIRE(seen.place().looked_at());
    const Vec3 place = *seen.place().looked_at(), outward = seen.place().looked_from();
    CHECK(outward.norm() == Approx(1.0));
    WHEN("it flies") {
        CHECK((camera().centre - before.centre).norm() < 0.5 * (place - before.centre).norm());
        THEN("it arrives where the place is seen from outside") {
            REQUIRE(seen.shell->settle(60s));
            CHECK((camera().centre - place).norm() < 1e-9);
            CHECK(camera().view.dot(outward) < -0.999);
            CHECK(camera().half_height < before.half_height);
        }
        THEN("a drag takes the camera over") {
            const float x = seen.view().middle_x(), y = seen.view().middle_y();
            seen.shell->drag(x, y, x + 30, y);
            REQUIRE(seen.shell->settle(60s));
            CHECK((camera().centre - place).norm() > 0.1);
        }
    }
    WHEN("the next one is asked for on the way") {
        seen.key('X');
        CHECK(*seen.place().looked_at() != place);
        CHECK((camera().centre - *seen.place().looked_at()).norm() < 1e-9);
    }
}

SCENARIO("Staircases are ranked by their sharpness, not by their weights", "[window][view]") {
    const std::string file = temporary_folder() + "/steps.vtp";
    write_surface(of_mask(vessel_in_slices()), file);
    Seen seen(file);
    if (!seen.shell) return;
    seen.place().view.choose(ColouringKind::StaircaseWeight);
    REQUIRE(seen.shell->settle(60s));
    REQUIRE(seen.place().view_data().colours());
    const ColourValues& colours = *seen.place().view_data().colours();
    // As many as there are of these, the first of them would be no better than any other.
    CHECK(std::ranges::count(colours.values, std::ranges::max(colours.values)) > 10);
    REQUIRE(colours.sharpness.size() == colours.values.size());
    seen.key('X');
    REQUIRE(seen.place().looked_at());
    const auto sharpest = std::ranges::max_element(colours.sharpness) - colours.sharpness.begin();
    const Scene* scene = seen.place().document.shown();
    CHECK(*seen.place().looked_at() ==
          scene->surface->points()[static_cast<std::size_t>(sharpest)]);
    CHECK_THAT(seen.place().document.messages().back().text,
               Catch::Contains("change of orientation"));
}

SCENARIO("A colouring that needs something else says what", "[window][view]") {
    Seen seen;
    if (!seen.shell) return;
    seen.place().view.choose(ColouringKind::NeighbourDistance);
    REQUIRE(seen.shell->settle(60s));
    CHECK_FALSE(seen.place().view_data().colours());
    CHECK_FALSE(seen.place().view_data().colours_problem().empty());
}

SCENARIO("A clip plane cuts the model and is dragged", "[window][view]") {
    Seen seen;
    if (!seen.shell) return;
    const auto whole = seen.pixels();
    seen.key('C');
    REQUIRE(seen.shell->has("clip.place"));
    const auto cut = seen.pixels();
    CHECK(cut != whole);
    WHEN("its slider is dragged") {
        const ScreenRect slider = seen.shell->app().ui().items().at("clip.place").rect;
        const float y = slider.middle_y();
        seen.shell->drag(slider.middle_x(), y, slider.x + 0.9F * slider.width, y);
        CHECK(seen.place().view.clip.place > 0.8);
        CHECK(seen.pixels() != cut);
    }
    WHEN("the other half is shown") {
        CHECK(seen.place().view.clip.flipped);  // seen from the front, the back half is shown
        REQUIRE(seen.shell->click_item("clip.flip"));
        CHECK_FALSE(seen.place().view.clip.flipped);
        CHECK(seen.pixels() != cut);
    }
    WHEN("it is across the side") {
        REQUIRE(seen.shell->click_item("clip.axis"));
        REQUIRE(seen.shell->click_item("clip.axis=Sagittal"));
        seen.shell->frame();
        CHECK(seen.place().view.clip.axis == ClipAxis::Sagittal);
        CHECK(seen.pixels() != cut);
    }
    REQUIRE(seen.shell->click_item("clip.close"));
    seen.shell->frame();
    CHECK(seen.pixels() == whole);
}

SCENARIO("Overlays are switched by keys", "[window][view]") {
    Seen seen;
    if (!seen.shell) return;
    const auto plain = seen.pixels();
    seen.key('L');
    CHECK(seen.place().view_data().centerlines());
    CHECK(seen.pixels() != plain);
    seen.key('N');
    CHECK(seen.shell->has("view.name.inlet"));
    CHECK(seen.shell->has("view.name.outlet_1"));
    seen.key('L');
    CHECK(seen.pixels() == plain);
    CHECK(seen.place().settings.layers.names);
}

SCENARIO("What the view shows is remembered", "[window][view]") {
    const std::string folder = temporary_folder();
    Settings settings(folder);
    CHECK(settings.layers == ShownLayers{});
    settings.layers = {.flat = true, .anchors = true};
    REQUIRE(settings.save());
    CHECK(Settings(folder).layers == settings.layers);
}

SCENARIO("The source's wireframe and the places of edits are shown", "[window][view]") {
    Seen seen;
    if (!seen.shell) return;
    Document& document = seen.place().document;
    document.apply("brush-inflate", {{"at", Value(Vec3(0, -4, 15))}, {"radius", Value(3.0)}},
                   Step::LocalRepair);
    REQUIRE(wait_until_idle(*seen.shell));
    REQUIRE_FALSE(document.failure());
    REQUIRE(seen.shell->settle(60s));
    seen.key('A');
    CHECK(seen.shell->has("view.anchor.0"));
    const auto plain = seen.pixels();
    seen.key('W');
    REQUIRE(document.source());
    CHECK(document.source()->points() != document.shown()->surface->points());
    CHECK(seen.pixels() != plain);
}

SCENARIO("The camera flies through the vessel and comes back", "[window][view]") {
    Seen seen;
    if (!seen.shell) return;
    const ViewCamera outside = seen.shell->app().camera();
    seen.key('E');
    const auto eye = [&] { return eye_of(seen.shell->app().camera()); };
    REQUIRE(seen.shell->has("flight.place"));
    CHECK(seen.shell->app().camera().perspective);
    CHECK(seen.shell->app().camera().field_of_view_deg > 80);
    CHECK(eye().head<2>().norm() < 1);
    CHECK(eye().z() < 3);
    WHEN("the wheel is turned") {
        const ScreenRect view = seen.view();
        seen.shell->move_mouse(view.middle_x(), view.middle_y());
        seen.shell->wheel(4);
        seen.shell->frame();
        CHECK(eye().z() > 5);
        CHECK(eye().head<2>().norm() < 1);
        THEN("dragging looks around without moving") {
            const Vec3 before = eye();
            const Vec3 view_before = seen.shell->app().camera().view;
            seen.shell->drag(view.middle_x(), view.middle_y(), view.middle_x() + 80,
                             view.middle_y());
            CHECK((eye() - before).norm() < 1e-6);
            CHECK(seen.shell->app().camera().view.dot(view_before) < 0.999);
        }
    }
    WHEN("it is played") {
        REQUIRE(seen.shell->click_item("flight.play"));
        REQUIRE(seen.shell->run_until([&] { return eye().z() > 6; }, 60s));
        REQUIRE(seen.shell->click_item("flight.play"));
        const double stopped = eye().z();
        for (int i = 0; i < 5; ++i) seen.shell->frame();
        CHECK(eye().z() == stopped);
    }
    seen.shell->press_key(keys::kEscape);
    CHECK_FALSE(seen.shell->has("flight.place"));
    CHECK(seen.shell->app().camera() == outside);
}

SCENARIO("Two clicks measure a distance", "[window][view]") {
    Seen seen;
    if (!seen.shell) return;
    const ViewCamera before = seen.shell->app().camera();
    seen.key('M');
    REQUIRE(seen.shell->has("measure.close"));
    const auto plain = seen.pixels();
    seen.click({0, -4, 10});
    seen.click({0, -4, 20});
    CHECK(seen.pixels() != plain);
    CHECK(seen.shell->app().camera() == before);
    CHECK(seen.place().view.tool == ClickTool::Distance);
    REQUIRE(seen.shell->click_item("measure.clear"));
    seen.shell->frame();
    CHECK(seen.pixels() == plain);
    seen.shell->press_key(keys::kEscape);
    CHECK(seen.place().view.tool == ClickTool::None);
}

SCENARIO("A click measures a vessel's diameter", "[window][view]") {
    Seen seen;
    if (!seen.shell) return;
    seen.key('D');
    const auto plain = seen.pixels();
    seen.click({0, -4, 15});
    CHECK(seen.pixels() != plain);
}

SCENARIO("Every click measures a diameter, also before the last one is known", "[window][view]") {
    Seen seen;
    if (!seen.shell) return;
    seen.key('D');
    {
        const SlowDevice slow;
        for (const double z : {10.0, 15.0, 20.0}) {
            const Eigen::Vector2f where = seen.at({0, -4, z});
            seen.shell->click(where.x(), where.y());
        }
    }
    REQUIRE(seen.shell->settle(30s));
    for (const int number : {0, 1, 2})
        CHECK(seen.shell->has("measure.diameter." + std::to_string(number)));
    CHECK_FALSE(seen.shell->has("measure.diameter.3"));
}

SCENARIO("Openings have the colours of reports", "[window][view]") {
    Seen seen;
    if (!seen.shell) return;
    const auto colour_at = [&](const Vec3& point) {
        const Eigen::Vector2f where = seen.at(point);
        const Picture picture = seen.shell->picture();
        const auto first = static_cast<std::size_t>(
            (static_cast<int>(where.y()) * picture.width + static_cast<int>(where.x())) * 3);
        return std::vector<int>(picture.rgb.begin() + static_cast<std::ptrdiff_t>(first),
                                picture.rgb.begin() + static_cast<std::ptrdiff_t>(first) + 3);
    };
    const ScreenRect view = seen.view();
    seen.shell->move_mouse(view.middle_x(), view.y + view.height - 40);
    seen.shell->press_key(keys::k0 + 7, {.control = true});
    REQUIRE(seen.shell->settle(30s));
    const auto inlet = colour_at({1.5, 0, 0});  // seen from below
    CHECK(inlet[1] > inlet[0] + 30);
    CHECK(inlet[1] > inlet[2] + 30);
    seen.shell->press_key(keys::k0 + 7);
    REQUIRE(seen.shell->settle(30s));
    const auto outlet = colour_at({1.5, 0, 30});
    CHECK(outlet[2] > outlet[0] + 30);
}

SCENARIO("Pictures of the view are larger, on white, or on nothing", "[window][view]") {
    Seen seen;
    if (!seen.shell) return;
    const ScreenRect view = seen.view();
    const auto saved = [&](const std::string& size, const std::string& background) {
        if (!seen.shell->has("view.picture.size")) REQUIRE(seen.shell->click_item("view.options"));
        REQUIRE(seen.shell->click_item("view.picture.size"));
        REQUIRE(seen.shell->click_item("view.picture.size=" + size));
        REQUIRE(seen.shell->click_item("view.picture.background"));
        REQUIRE(seen.shell->click_item("view.picture.background=" + background));
        const std::string file = temporary_folder() + "/view.png";
        seen.place().ask(FileQuestion::Picture);
        seen.place().answer(file);
        REQUIRE(seen.shell->settle(30s));
        const auto picture = picture_from_png(file_content(file));
        REQUIRE(picture);
        return *picture;
    };
    const auto pixel = [](const ClearPicture& picture, int x, int y) {
        const auto first = picture.rgba.begin() + 4 * (std::ptrdiff_t{y} * picture.width + x);
        return std::vector<int>(first, first + 4);
    };
    const ClearPicture white = saved("2\u00D7", "White");
    CHECK(white.width == 2 * static_cast<int>(view.width));
    CHECK(white.height == 2 * static_cast<int>(view.height));
    CHECK(pixel(white, 0, 0) == std::vector{255, 255, 255, 255});
    CHECK(pixel(white, white.width / 2, white.height / 2) != std::vector{255, 255, 255, 255});
    const ClearPicture clear = saved("1\u00D7", "Transparent");
    CHECK(clear.width == static_cast<int>(view.width));
    CHECK(pixel(clear, 0, 0)[3] == 0);
    CHECK(pixel(clear, clear.width / 2, clear.height / 2)[3] == 255);
}

SCENARIO("A picture of the view is saved", "[window][view]") {
    Seen seen;
    if (!seen.shell) return;
    seen.shell->press_key(keys::kF12);
    CHECK(seen.place().question() == FileQuestion::Picture);
    REQUIRE(seen.shell->click_item("file.accept"));
    REQUIRE(seen.shell->settle(30s));
    const auto file = seen.place().document.project().parent_path() / "tube.png";
    REQUIRE(std::filesystem::exists(file));
    CHECK(file_content(file).starts_with("\x89PNG"));
    CHECK(std::filesystem::file_size(file) > 5000);
    THEN("the next one gets another name") {
        seen.shell->press_key(keys::kF12);
        REQUIRE(seen.shell->click_item("file.accept"));
        REQUIRE(seen.shell->settle(30s));
        CHECK(std::filesystem::exists(file.parent_path() / "tube-2.png"));
    }
}

SCENARIO("The surface before is a wireframe over the model that is smoothed live",
         "[window][view][live]") {
    Seen seen;
    if (!seen.shell) return;
    seen.place().choose("smooth");
    seen.place().set_field("iterations", "30");
    seen.shell->frame();
    seen.place().live().follow(true);
    REQUIRE(seen.shell->run_until(
        [&] { return seen.place().live().shown() && !seen.place().live().outdated(); }, 60s));
    REQUIRE(seen.shell->settle(60s));
    const auto plain = seen.pixels();
    seen.key('W');
    CHECK(seen.pixels() != plain);
    THEN("it goes with the live model") {
        seen.place().leave_form();
        REQUIRE(seen.shell->settle(60s));
        const auto with = seen.pixels();
        seen.key('W');
        CHECK(seen.pixels() == with);
    }
}
