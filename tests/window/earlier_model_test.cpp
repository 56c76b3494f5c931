// The model that an edit runs on is shown, and worked on, while its form is open.

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <functional>
#include <thread>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "geometry/formats/surface_file.h"
#include "geometry/kernel/measure.h"
#include "tests/support/paths.h"
#include "tests/support/program.h"
#include "tests/support/shapes.h"
#include "tests/window/window_support.h"
#include "tests/window/workplace_updates.h"
#include "workbench/window/features/brush/brush_feature.h"
#include "workbench/window/features/gallery/gallery_feature.h"
#include "workbench/window/features/openings/openings_feature.h"
#include "workbench/window/workplace/workplace.h"

using namespace vesselbench;
using namespace vesselbench::test;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;

namespace fs = std::filesystem;

namespace {

/// What is done to an input.
using Edits = std::vector<std::pair<std::string, Arguments>>;

/// A workplace without a window, on a case that was made and opened.
struct Desk {
    Desk(const std::string& input, const Edits& edits)
        : place({.session = session_options(), .documents = temporary_folder()},
                Settings(temporary_folder()), {.choice = DeviceChoice::Cpu}) {
        const fs::path project = fs::path(temporary_folder()) / "case.vbench";
        {
            Session session = Session::create(project, session_options());
            session.apply("load-surface", {{"file", input}, {"units", std::string("mm")}});
            loaded = *session.scene().surface;
            for (const auto& [operation, given] : edits) session.apply(operation, given);
        }
        place.open(project);
        REQUIRE(run_until([&] { return document.is_open(); }));
        settle();
    }

    bool run_until(const std::function<bool()>& done) { return update_until(place, done); }

    void settle() {
        REQUIRE(run_until([&] { return !document.busy() && !place.searches_places(); }));
        INFO((document.failure() ? document.failure()->text : "no failure"));
        REQUIRE_FALSE(document.failure());
    }

    void apply() {
        REQUIRE(place.can_apply());
        place.apply();
        settle();
    }

    void run_pending() {
        document.run_pending();
        settle();
        CHECK(pending_count(*document.snapshot(), document.variant()) == 0);
        CHECK_FALSE(first_stale(*document.snapshot(), document.variant()));
    }

    [[nodiscard]] const Surface& surface() const { return *document.current()->surface; }

    [[nodiscard]] std::size_t triangles() const { return surface().triangle_count(); }

    Workplace place;
    Document& document = place.document;
    Surface loaded;  ///< the source
};

constexpr EditId kSmooth = 2, kSubdivide = 3;

/// A tube that was smoothed (edit 2) and subdivided (edit 3).
Desk smoothed_and_subdivided() {
    return {tube_file(),
            {{"smooth", {{"iterations", Value(std::int64_t{4})}}}, {"subdivide", Arguments()}}};
}

std::string capped_tube_file() {
    const std::string file = temporary_folder() + "/tube.vtp";
    write_surface(fine_tube(4.0, 30.0, 24), file);
    return file;
}

/// A tube with caps that was lengthened and filled.
Desk filled_tube() {
    return {capped_tube_file(), {{"extrude-opening", {}}, {"tetrahedralize", {}}}};
}

/// The closed surface of the phantom with three vessels that meet.
std::string y_file() {
    const std::string folder = temporary_folder();
    REQUIRE(run_program(program_path(), {"phantom", "y", "--out", folder}).exit_code == 0);
    return folder + "/exact.vtp";
}

/// Picks the vessel end of the least x.
void pick_left_end(Desk& desk) {
    REQUIRE(desk.place.armed() == "tip");
    const auto& tips = desk.place.surface_places().tips;
    REQUIRE(tips.size() == 3);
    const auto left = [](const NamedPlace& tip) { return tip.point.x(); };
    desk.place.pick(std::ranges::min_element(tips, {}, left)->point);
}

/// The edit of the current state that was made last.
LogEntry newest_edit_of(const Document& document) {
    return *std::ranges::max_element(document.snapshot()->log, {},
                                     [](const LogEntry& entry) { return entry.edit.edit.id; });
}

}  // namespace

SCENARIO("The form of an earlier edit shows what the edit runs on", "[window][earlier]") {
    Desk desk = smoothed_and_subdivided();
    const Positions& loaded = desk.loaded.points();
    const std::size_t newest = desk.triangles();
    REQUIRE(newest == 4 * desk.loaded.triangle_count());
    REQUIRE(desk.document.stands_before() == nullptr);
    desk.place.choose_edit(kSmooth);
    desk.settle();
    CHECK(desk.surface().points() == loaded);
    REQUIRE(desk.document.stands_before() != nullptr);
    CHECK(desk.document.stands_before()->site.edit == kSmooth);
    CHECK(input_text(*desk.document.stands_before(), "smooth") == "Before edit 2, Smooth");
    REQUIRE(desk.document.newest() != nullptr);
    CHECK(desk.document.newest()->surface->triangle_count() == newest);
    CHECK(desk.document.figures().volume == Approx(volume(desk.surface())));
    WHEN("the form is left") {
        desk.place.leave_form();
        THEN("the newest model is shown at once, and what was measured of it is known") {
            CHECK_FALSE(desk.document.is_reading());
            CHECK(desk.triangles() == newest);
            CHECK(desk.document.stands_before() == nullptr);
            CHECK(desk.document.figures().volume == Approx(volume(desk.surface())));
        }
        THEN("opening it again reads nothing") {
            desk.place.choose_edit(kSmooth);
            CHECK_FALSE(desk.document.is_reading());
            CHECK(desk.surface().points() == loaded);
        }
    }
    WHEN("another edit's form is opened instead") {
        desk.place.choose_edit(kSubdivide);
        desk.settle();
        CHECK(desk.triangles() == newest / 4);
        CHECK(desk.surface().points() != loaded);
        CHECK_FALSE(desk.document.stands_before()->has_later);
    }
    WHEN("it is changed") {
        desk.place.set_field("iterations", "8");
        desk.apply();
        THEN("the form closes, its result is the newest model, and later edits are run as asked") {
            CHECK(desk.document.stands_before() == nullptr);
            CHECK(desk.triangles() == newest / 4);
            CHECK(pending_count(*desk.document.snapshot(), "cfd") == 1);
            desk.run_pending();
            CHECK(desk.triangles() == newest);
        }
        THEN("the form of an edit behind pending ones says that they have to be run") {
            desk.place.choose("decimate");
            desk.settle();
            CHECK(desk.document.stands_before() == nullptr);
            CHECK_THAT(desk.document.why_not_input(), Contains("pending"));
            desk.run_pending();
            CHECK(desk.document.why_not_input().empty());
        }
    }
    WHEN("the edit is undone while its form is open") {
        desk.document.undo();
        desk.settle();
        desk.document.undo();
        desk.settle();
        CHECK(desk.document.stands_before() == nullptr);
        CHECK(desk.surface().points() == loaded);
    }
}

SCENARIO("The form that loads the source shows the newest model", "[window][earlier]") {
    Desk desk = smoothed_and_subdivided();
    const std::size_t newest = desk.triangles();
    desk.place.choose_edit(1);
    desk.settle();
    CHECK(desk.document.stands_before() == nullptr);
    CHECK(desk.triangles() == newest);
}

SCENARIO("A model that arrives after its form was left is dropped", "[window][earlier]") {
    Desk desk = smoothed_and_subdivided();
    const std::size_t newest = desk.triangles();
    desk.place.choose_edit(kSmooth);
    REQUIRE(desk.document.is_reading());
    CHECK(desk.triangles() == newest);  // what is seen stays until the other is there
    desk.place.update();
    while (!desk.document.runner()->idle()) std::this_thread::sleep_for(2ms);
    WHEN("the form is left") {
        desk.place.leave_form();
        desk.settle();
        CHECK(desk.triangles() == newest);
        CHECK(desk.document.stands_before() == nullptr);
    }
    WHEN("another form is opened") {
        desk.place.choose_edit(kSubdivide);
        desk.settle();
        CHECK(desk.triangles() == newest / 4);
        CHECK(desk.surface().points() != desk.loaded.points());
    }
}

SCENARIO("A point is picked only on the model that the edit runs on", "[window][earlier]") {
    Desk desk = filled_tube();
    desk.place.choose("brush-smooth");
    desk.place.arm("at");
    const Vec3 side(4, 0, 15);
    REQUIRE(desk.document.is_reading());
    desk.place.pick(side);
    CHECK(desk.place.form()->field("at").text.empty());
    desk.settle();
    desk.place.pick(side);
    CHECK(desk.place.form()->field("at").text == "4,0,15");
}

SCENARIO("A forgotten branch is removed after the model was filled", "[window][earlier]") {
    Desk desk(y_file(), {{"clip-opening", {{"tip", Value(Vec3(0, 0, -20))}}},
                         {"clip-opening", {{"tip", Value(Vec3(11.5, 0, 16.4))}}},
                         {"remesh", {{"edge", 0.5}}},
                         {"tetrahedralize", {}}});
    REQUIRE(desk.document.current()->volume_mesh);
    REQUIRE(bounds(desk.surface()).min.x() < -10.0);
    desk.place.choose("remove-branch");
    desk.settle();
    REQUIRE(desk.document.stands_before() != nullptr);
    CHECK(desk.document.stands_before()->has_later);
    CHECK_FALSE(desk.document.current()->volume_mesh);
    CHECK(desk.surface().patches.size() == 1);
    pick_left_end(desk);
    desk.apply();
    CHECK(newest_edit_of(desk.document).edit.place.step == Step::Branches);
    CHECK(newest_edit_of(desk.document).status == EditStatus::Done);
    desk.run_pending();
    CHECK(desk.document.current()->volume_mesh);
    CHECK(desk.surface().patches.size() == 3);
    CHECK(bounds(desk.surface()).min.x() > -4.0);
}

SCENARIO("A removed branch takes its opening and its extension along", "[window][earlier]") {
    Desk desk(y_file(),
              {{"clip-opening", {}}, {"extrude-opening", {}}, {"remesh", {{"edge", 0.5}}}});
    REQUIRE(desk.surface().patches.size() == 4);
    const double low = bounds(desk.surface()).min.z();
    REQUIRE(low < -22.0);
    desk.place.choose("remove-branch");
    desk.settle();
    pick_left_end(desk);
    desk.apply();
    desk.run_pending();
    CHECK(desk.surface().patches.size() == 3);
    CHECK(bounds(desk.surface()).min.x() > -4.0);
    CHECK(bounds(desk.surface()).min.z() == Approx(low).margin(3.0));
    CHECK(std::ranges::any_of(desk.document.snapshot()->log, [](const LogEntry& entry) {
        return entry.result &&
               std::ranges::count(entry.result->warnings, "opening-gone", &Diagnostic::code) == 1;
    }));
}

SCENARIO("An extension of all openings takes those that there are", "[window][earlier]") {
    Desk desk(y_file(), {{"clip-opening", {}}, {"extrude-opening", {}}});
    REQUIRE(desk.surface().patches.size() == 4);
    REQUIRE(bounds(desk.surface()).max.x() > 14.0);
    desk.place.choose_edit(2);
    desk.settle();
    desk.place.set_field("closed", "11.8,0,16.9");
    desk.apply();
    desk.run_pending();
    CHECK(desk.surface().patches.size() == 3);
    CHECK(bounds(desk.surface()).max.x() < 13.5);
    CHECK(bounds(desk.surface()).min.x() < -14.0);
}

SCENARIO("The other end of a filled model becomes the inlet", "[window][earlier]") {
    Desk desk = filled_tube();
    const auto openings = measure_patches(desk.surface());
    const auto other = std::ranges::find(openings, PatchKind::Outlet, &PatchMeasures::kind);
    REQUIRE(other != openings.end());
    desk.place.get<OpeningsFeature>().click(*other);
    REQUIRE(desk.place.get<OpeningsFeature>().role_question());
    desk.place.get<OpeningsFeature>().give_role(PatchKind::Inlet);
    desk.settle();
    REQUIRE(desk.document.stands_before() != nullptr);
    CHECK(desk.document.stands_before()->site.step == Step::Openings);
    desk.apply();
    desk.run_pending();
    CHECK(desk.document.current()->volume_mesh);
    for (const PatchMeasures& opening : measure_patches(desk.surface()))
        if (opening.kind == PatchKind::Inlet)
            CHECK((opening.centroid - other->centroid).norm() < 0.1);
}

SCENARIO("A cap that becomes the inlet changes the edit that opened the ends",
         "[window][earlier][openings]") {
    Desk desk(y_file(), {{"clip-opening", {}}, {"extrude-opening", {}}});
    const auto openings = measure_patches(desk.surface());
    const auto second = std::ranges::find(openings, std::string("outlet_2"), &PatchMeasures::name);
    REQUIRE(second != openings.end());
    auto& feature = desk.place.get<OpeningsFeature>();
    feature.click(*second);
    REQUIRE(feature.role_question());
    feature.give_role(PatchKind::Inlet);
    CHECK_FALSE(desk.place.can_apply());  // its ends are not known yet
    REQUIRE(desk.run_until([&] {
        return !feature.pending() && desk.place.form() &&
               !desk.place.form()->field("inlet").text.empty();
    }));
    CHECK(desk.place.form()->edit() == 2);
    REQUIRE(desk.run_until([&] { return !feature.pending(); }));
    desk.apply();
    desk.run_pending();
    CHECK(desk.document.snapshot()->log.size() == 3);
    for (const PatchMeasures& opening : measure_patches(desk.surface()))
        if (opening.kind == PatchKind::Inlet)
            CHECK((opening.centroid - second->centroid).norm() < 0.5);
}

SCENARIO("A brush paints in the step that it was chosen in", "[window][earlier]") {
    Desk desk = filled_tube();
    desk.place.choose("brush-inflate", Step::LocalRepair);
    desk.place.get<BrushFeature>().set_tip({.radius = 2.0, .strength = 0.5});
    CHECK_FALSE(desk.place.get<BrushFeature>().can_paint());  // the filled model is still seen
    desk.settle();
    REQUIRE(desk.place.get<BrushFeature>().can_paint());
    CHECK(bounds(desk.surface()).max.z() == Approx(30.0));
    for (int stroke = 1; stroke <= 2; ++stroke) {
        const Positions before = desk.surface().points();
        desk.place.get<BrushFeature>().begin_stroke({});
        desk.document.add_dab({.point = {4, 0, 15}, .normal = {1, 0, 0}});
        REQUIRE(desk.run_until([&] { return !desk.document.take_moves().empty(); }));
        desk.document.end_stroke();
        desk.settle();
        CHECK(newest_edit_of(desk.document).edit.place.step == Step::LocalRepair);
        CHECK(desk.surface().points().size() == before.size());
        CHECK(desk.surface().points() != before);
        REQUIRE(desk.document.stands_before() != nullptr);
        CHECK(desk.place.get<BrushFeature>().can_paint());
    }
    desk.place.leave_form();
    desk.run_pending();
    CHECK(desk.document.current()->volume_mesh);
}

SCENARIO("An earlier edit that smooths is followed live, and has its gallery and graphs",
         "[window][earlier][live]") {
    Desk desk = smoothed_and_subdivided();
    desk.place.choose_edit(kSubdivide);
    desk.settle();
    const Surface smoothed = desk.surface();
    desk.place.choose_edit(kSmooth);
    desk.settle();
    LiveSmoothing& live = desk.place.live();
    REQUIRE(live.can_follow());
    THEN("the live model is what the edit makes of its input") {
        live.follow(true);
        REQUIRE(desk.run_until(
            [&] { return live.shown() && !live.outdated() && live.shown()->state.exact; }));
        CHECK(difference_text(live.shown()->state.surface, smoothed).empty());
    }
    THEN("the gallery and its spots are about the input") {
        desk.place.get<GalleryFeature>().show(GalleryMode::Spots);
        REQUIRE(desk.run_until([&] { return desk.place.gallery().original() != nullptr; }));
        CHECK(desk.place.gallery().mode() == GalleryMode::Spots);
        CHECK(desk.place.gallery().original()->positions == desk.surface().positions);
        REQUIRE(desk.run_until([&] { return desk.place.gallery().picks(); }));
        desk.place.gallery().add_spot({4, 0, 15}, {1, 0, 0});
        CHECK(desk.place.gallery().spots.all().size() == 1);
    }
    THEN("the graphs are those of the input") {
        REQUIRE(desk.run_until([&] {
            desk.place.quality().want();
            return desk.place.quality().answer() != nullptr;
        }));
        CHECK(desk.place.quality().can_analyse());
    }
}
