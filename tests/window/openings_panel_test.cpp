// All vessel ends at once in the form of clip-opening: what is planned, and what the user wants.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <functional>
#include <optional>
#include <set>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/formats/surface_file.h"
#include "geometry/kernel/cross_section.h"
#include "geometry/kernel/measure.h"
#include "geometry/phantoms/exact_surface.h"
#include "geometry/phantoms/field.h"
#include "gpu/picture.h"
#include "tests/support/paths.h"
#include "tests/support/program.h"
#include "tests/support/shapes.h"
#include "tests/window/window_support.h"
#include "tests/window/workplace_updates.h"
#include "workbench/phantoms/phantom_json.h"
#include "workbench/window/drawing/pixel_view.h"
#include "workbench/window/features/handles/cut_handles.h"
#include "workbench/window/features/openings/end_markers.h"
#include "workbench/window/features/openings/opening_roles.h"
#include "workbench/window/features/openings/openings_feature.h"
#include "workbench/window/keys/keys.h"
#include "workbench/window/workplace/workplace.h"

using namespace vesselbench;
using namespace vesselbench::test;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;

namespace fs = std::filesystem;

namespace {

/// A project with the exact surface of a built-in phantom. \param edge of its triangles [mm]
fs::path project_of(const std::string& phantom, double edge) {
    const fs::path folder = temporary_folder();
    const PhantomField field(builtin_phantom(phantom).parts);
    write_surface(exact_surface(field, field.bounds(), edge), folder / "vessel.vtp");
    Session session = Session::create(folder / "vessel.vbench", session_options());
    session.apply("load-surface",
                  {{"file", (folder / "vessel.vtp").string()}, {"units", std::string("mm")}});
    return folder / "vessel.vbench";
}

/// A parent vessel that ends below, and two branches that end above: ends 1, 2 and 3.
fs::path furcation() {
    return project_of("y", 0.4);
}

/// A sac, which stays closed, an inlet, two outlets and two stubs.
fs::path aneurysm() {
    return project_of("aneurysm", 0.3);
}

/// A window without drawing, with the form that opens vessel ends.
struct Openings {
    explicit Openings(const fs::path& project)
        : place({.session = session_options(), .documents = temporary_folder()},
                Settings(temporary_folder())) {
        place.open(project);
        REQUIRE(until([&] { return place.document.is_open() && !place.document.busy(); }));
        place.choose("clip-opening");
        settle();
    }

    [[nodiscard]] bool until(const std::function<bool()>& done) {
        return update_until(place, done);
    }

    void settle() {
        place.update();
        REQUIRE(until([&] { return !place.openings().pending() && !place.document.busy(); }));
        place.update();
    }

    [[nodiscard]] const OpeningsModel& ends() const { return place.openings(); }

    [[nodiscard]] EndRow row(int number) const {
        const EndRow* found = ends().row(number);
        REQUIRE(found != nullptr);
        return *found;
    }

    [[nodiscard]] std::string text(const std::string& parameter) const {
        return place.form()->field(parameter).text;
    }

    void wish(int number, EndWish wished) {
        place.fill_form(ends().wish_texts(*place.form(), number, wished));
    }

    /// Applies the form. \return the surface
    [[nodiscard]] Surface apply() {
        settle();
        REQUIRE(place.can_apply());
        place.apply();
        REQUIRE(until([&] { return !place.document.busy(); }));
        INFO((place.document.failure() ? place.document.failure()->text : "no failure"));
        REQUIRE_FALSE(place.form());
        return *place.document.current()->surface;
    }

    Workplace place;
};

std::vector<EndWish> wishes_of(const std::vector<EndRow>& rows) {
    std::vector<EndWish> wishes;
    for (const EndRow& row : rows) wishes.push_back(row.wish);
    return wishes;
}

/// The opening of a surface nearest to a point.
PatchMeasures opening_near(const Surface& surface, const Vec3& point) {
    auto patches = measure_patches(surface);
    std::erase_if(patches, [](const PatchMeasures& p) { return p.kind == PatchKind::Wall; });
    REQUIRE_FALSE(patches.empty());
    return *std::ranges::min_element(
        patches, {}, [&](const PatchMeasures& p) { return (p.centroid - point).norm(); });
}

bool is_opening_near(const Surface& surface, const Vec3& point, double reach) {
    return (opening_near(surface, point).centroid - point).norm() < reach;
}

}  // namespace

SCENARIO("The table has the ends and the numbers of vesselbench ends", "[window][openings]") {
    const fs::path project = aneurysm();
    const ProgramRun listed = run_program(program_path(), {"ends", project.string(), "--json"});
    REQUIRE(listed.exit_code == 0);
    const Openings window(project);
    const auto ends = nlohmann::json::parse(listed.out).at("ends");
    REQUIRE(window.ends().rows().size() == ends.size());
    for (const auto& end : ends) {
        const EndRow row = window.row(end.at("number").get<int>());
        const auto at = end.at("place_mm").get<std::vector<double>>();
        CHECK((row.place - Vec3(at[0], at[1], at[2])).norm() < 1e-9);
        CHECK(row.share == Approx(end.at("flow_share").get<double>()));
        CHECK(row.why == end.at("why").get<std::string>());
        const auto& opening = end.at("opening");
        const std::string wish = opening.is_null()    ? "Closed"
                                 : opening == "inlet" ? "Inlet"
                                                      : "Outlet";
        CHECK(to_string(row.wish) == wish);
        CHECK(row.cut.has_value() == !opening.is_null());
    }
    CHECK(summary_of(window.ends().rows()) == "5 of 6 ends open, 1 in doubt");
}

SCENARIO("A role has one colour: of its cap, in the table and on its marker",
         "[window][openings]") {
    Openings window(aneurysm());
    window.place.fill_form({{"accept_doubts", "true"}});
    window.settle();
    const std::vector<EndRow> rows = window.ends().rows();
    const Surface made = window.apply();
    const std::vector<Colour> caps = patch_colours(made);
    for (const EndRow& row : rows) {
        if (!row.is_open()) continue;
        const PatchMeasures opening = opening_near(made, row.cut->place.plane.point);
        const PixelColour cap = pixel_colour(caps[opening.row]);
        CAPTURE(row.number);
        CHECK(end_colour(dark_theme(), row) ==
              paint(std::uint32_t{cap[0]} << 16U | std::uint32_t{cap[1]} << 8U | cap[2]));
    }
    THEN("a sac differs from another closed end, and both from openings") {
        std::set<Paint> colours;
        for (const EndWish wish : {EndWish::Inlet, EndWish::Outlet, EndWish::Closed})
            colours.insert(end_colour(dark_theme(), {.wish = wish}));
        colours.insert(end_colour(dark_theme(), {.wish = EndWish::Closed, .sac = true}));
        CHECK(colours.size() == 4);
        CHECK(rows.front().sac);
    }
}

SCENARIO("Ends that the odds would decide otherwise stay what an edit made of them",
         "[window][openings]") {
    Openings window(aneurysm());
    window.place.fill_form({{"accept_doubts", "true"}});
    window.settle();
    std::vector<EndRow> rows = window.ends().rows();
    std::ranges::sort(rows, {}, &EndRow::number);
    REQUIRE(rows[0].wish == EndWish::Closed);
    REQUIRE(rows[2].wish == EndWish::Outlet);
    static_cast<void>(window.apply());
    const Snapshot& now = *window.place.document.snapshot();
    const EditId edit = now.log.back().edit.edit.id;
    for (EndRow& row : rows) row.doubtful = false;
    CHECK(former_wishes(rows, now, edit).empty());
    rows[0].wish = EndWish::Outlet;
    rows[2].wish = EndWish::Closed;
    const auto wishes = former_wishes(rows, now, edit);
    CHECK(std::set(wishes.begin(), wishes.end()) ==
          std::set<std::pair<int, EndWish>>{{1, EndWish::Closed}, {3, EndWish::Outlet}});
    CHECK(former_wishes(rows, now, edit + 1).empty());
}

SCENARIO("The form of an edit has the ends that it named, whatever their numbers are on its input",
         "[window][openings]") {
    Openings window(aneurysm());
    window.place.fill_form({{"accept_doubts", "true"}, {"close_ends", "4"}});
    window.settle();
    const Vec3 removed = window.row(2).place, closed = window.row(4).place;
    static_cast<void>(window.apply());
    const EditId edit = window.place.document.snapshot()->log.back().edit.edit.id;
    window.place.document.apply("remove-branch", {{"tip", removed}}, Step::Branches);
    REQUIRE(window.until([&] { return !window.place.document.busy(); }));
    window.place.choose_edit(edit);
    window.settle();
    REQUIRE(window.ends().rows().size() == 5);
    CHECK(window.text("close_ends").empty());
    CHECK_FALSE(window.text("closed").empty());
    for (const EndRow& row : window.ends().rows())
        if ((row.place - closed).norm() < 1.0) CHECK(row.wish == EndWish::Closed);
}

SCENARIO("A closed end that is toggled is opened", "[window][openings]") {
    Openings window(aneurysm());
    const EndRow sac = window.row(1);
    REQUIRE(sac.wish == EndWish::Closed);
    CHECK_THAT(sac.why, Contains("aneurysm"));
    CHECK(next_wish(window.row(2)) == EndWish::Closed);
    window.wish(1, EndWish::Outlet);
    CHECK_FALSE(window.text("open").empty());
    CHECK(window.text("inlet").empty());
    CHECK(window.text("closed").empty());
    CHECK(window.text("planes").empty());
    window.settle();
    const EndRow opened = window.row(1);
    CHECK(opened.wish == EndWish::Outlet);
    CHECK(opened.is_changed());
    REQUIRE(opened.cut);
    CHECK(summary_of(window.ends().rows()) == "6 of 6 ends open; changed: 1");
    WHEN("it is applied, and a stub with it") {
        window.wish(6, EndWish::Outlet);
        const Surface made = window.apply();
        CHECK(is_opening_near(made, opened.cut->place.plane.point, 1.0));
        CHECK(made.patches.size() == 7);
    }
    WHEN("it is closed again") {
        window.wish(1, EndWish::Closed);
        CHECK(window.text("open").empty());
        window.settle();
        CHECK(window.row(1).wish == EndWish::Closed);
        CHECK_FALSE(window.row(1).is_changed());
    }
}

SCENARIO("Another inlet changes the roles and nothing else", "[window][openings]") {
    Openings window(furcation());
    const std::vector<EndRow> before = window.ends().rows();
    REQUIRE(wishes_of(before) ==
            std::vector<EndWish>{EndWish::Inlet, EndWish::Outlet, EndWish::Outlet});
    window.wish(3, EndWish::Inlet);
    for (const char* parameter : {"open", "closed", "planes", "names", "closings", "tip"})
        CHECK(window.text(parameter).empty());
    window.settle();
    const std::vector<EndRow> after = window.ends().rows();
    CHECK(wishes_of(after) ==
          std::vector<EndWish>{EndWish::Outlet, EndWish::Outlet, EndWish::Inlet});
    for (std::size_t i = 0; i < after.size(); ++i) {
        REQUIRE(after[i].cut);
        CHECK((after[i].cut->place.plane.point - before[i].cut->place.plane.point).norm() < 1e-9);
    }
    const Surface made = window.apply();
    CHECK(opening_near(made, after[2].place).kind == PatchKind::Inlet);
    CHECK(opening_near(made, after[0].place).kind == PatchKind::Outlet);
    CHECK(made.patches.size() == 4);
    WHEN("the edit is opened again, and its first inlet is chosen") {
        window.place.choose_edit(window.place.document.snapshot()->log.back().edit.edit.id);
        window.settle();
        REQUIRE(window.ends().rows().size() == 3);
        CHECK(window.row(3).wish == EndWish::Inlet);
        CHECK((window.row(3).place - after[2].place).norm() < 1e-9);
        window.wish(1, EndWish::Inlet);
        const Surface changed = window.apply();
        CHECK(opening_near(changed, after[0].place).kind == PatchKind::Inlet);
        CHECK(window.place.document.snapshot()->log.size() == 2);
    }
}

SCENARIO("A second inlet is added to the first one", "[window][openings]") {
    Openings window(furcation());
    window.place.fill_form(window.ends().inlet_texts(*window.place.form(), 2));
    window.settle();
    CHECK(wishes_of(window.ends().rows()) ==
          std::vector<EndWish>{EndWish::Inlet, EndWish::Inlet, EndWish::Outlet});
}

SCENARIO("A plan of choices that have changed is dropped", "[window][openings]") {
    Openings window(furcation());
    window.wish(2, EndWish::Closed);
    window.place.update();
    REQUIRE(window.ends().pending());
    window.wish(2, EndWish::Outlet);
    window.wish(3, EndWish::Closed);
    bool mixed = false;
    REQUIRE(window.until([&] {
        const EndRow* second = window.ends().row(2);
        mixed = mixed || (second != nullptr && second->why.find("as asked") != std::string::npos);
        return !window.ends().pending();
    }));
    window.place.update();
    CHECK_FALSE(mixed);
    CHECK(window.row(2).wish == EndWish::Outlet);
    CHECK(window.row(3).wish == EndWish::Closed);
    CHECK_THAT(window.row(3).why, Contains("as asked"));
}

SCENARIO("The cut of one end is moved, and the others stay as planned", "[window][openings]") {
    Openings window(furcation());
    const Plane planned = window.row(2).cut->place.plane;
    const Plane moved{planned.point - 3.0 * planned.normal, planned.normal};
    window.place.fill_form(window.ends().move_texts(*window.place.form(), 2, moved));
    CHECK_FALSE(window.text("planes").empty());
    CHECK_THAT(window.text("names"), Contains(R"({"kind":"inlet","name":"inlet"})"));
    window.settle();
    CHECK(window.row(2).moved);
    CHECK(window.row(2).is_changed());
    CHECK_FALSE(window.row(1).is_changed());
    CHECK_FALSE(window.row(3).is_changed());
    WHEN("it is applied") {
        const Vec3 other = window.row(3).cut->place.plane.point;
        const Surface made = window.apply();
        CHECK(is_opening_near(made, moved.point, 0.2));
        CHECK(is_opening_near(made, other, 0.2));
        CHECK(opening_near(made, {0, 0, -20}).kind == PatchKind::Inlet);
    }
    WHEN("another end is closed") {
        window.wish(3, EndWish::Closed);
        window.settle();
        CHECK(window.row(2).moved);
        CHECK(records_of(*window.place.form(), "planes").list().size() == 2);
        CHECK(window.apply().patches.size() == 3);
    }
    WHEN("it goes back") {
        window.place.fill_form(window.ends().move_texts(*window.place.form(), 2, std::nullopt));
        for (const char* parameter : {"planes", "names", "closings", "open", "closed"})
            CHECK(window.text(parameter).empty());
    }
}

SCENARIO("The handles of the chosen end's cut change its row alone", "[window][openings]") {
    Openings window(furcation());
    CHECK_FALSE(window.ends().cut_form());
    window.place.openings().select(2);
    const auto form = window.ends().cut_form();
    REQUIRE(form);
    const Cut cut = find_cut(*window.ends().surface(), cut_question(*form).value(), nullptr);
    REQUIRE(cut.problem.empty());
    REQUIRE(cut_shape(*form, cut).handles.size() == 2);
    const auto drag = [&](std::size_t handle, const Vec3& to) {
        window.place.fill_form(window.ends().dragged_texts(*window.place.form(), *form, cut,
                                                           cut_texts(*form, cut, handle, to)));
        window.settle();
    };
    WHEN("it slides by 3 mm") {
        drag(0, cut.branch->place(cut.distance + 3.0));
        CHECK(window.row(2).moved);
        CHECK((window.row(2).cut->place.plane.point - cut.plane.point).norm() ==
              Approx(3.0).margin(0.1));
        CHECK_FALSE(window.row(3).moved);
    }
    WHEN("it is tilted by 20 degrees") {
        const auto [side, other] = plane_axes(cut.plane.normal);
        const double radians = 0.35;
        drag(1, cut.plane.point +
                    4.0 * (std::cos(radians) * cut.plane.normal + std::sin(radians) * side));
        REQUIRE(window.row(2).moved);
        CHECK(std::acos(window.row(2).cut->place.plane.normal.dot(cut.plane.normal)) ==
              Approx(radians).margin(0.01));
    }
}

SCENARIO("A branch is removed with the cuts", "[window][openings]") {
    Openings window(aneurysm());
    const EndRow stub = window.row(5);
    REQUIRE(stub.removable);
    window.wish(5, EndWish::Removed);
    window.settle();
    CHECK(window.row(5).wish == EndWish::Removed);
    CHECK(next_wish(window.row(5)) == EndWish::Outlet);
    const Surface made = window.apply();
    CHECK(made.patches.size() == 5);
    CHECK_FALSE(is_opening_near(made, stub.place, 2.0));
    const auto nearest = std::ranges::min_element(
        made.points(), {}, [&](const Vec3& p) { return (p - stub.place).norm(); });
    CHECK((*nearest - stub.place).norm() > 1.0);
}

SCENARIO("A form of one end has no table until all are asked for", "[window][openings]") {
    Openings window(furcation());
    window.place.set_field("tip", "0,0,-20");
    window.place.update();
    CHECK(window.ends().has_form());
    CHECK_FALSE(window.ends().lists_ends());
    CHECK(window.ends().rows().empty());
    window.place.set_field("tip", "");
    window.settle();
    CHECK(window.ends().rows().size() == 3);
}

SCENARIO("Rows and markers of ends are clicked", "[window][openings]") {
    const auto shell = test_shell();
    if (!shell) return;
    open_and_wait(*shell, furcation().string());
    REQUIRE(shell->click_item("rail.openings"));
    REQUIRE(shell->click_item("choose.clip-opening"));
    REQUIRE(shell->settle(60s));
    const Workplace& place = shell->app().place();
    const auto wish = [&](int number) { return place.openings().row(number)->wish; };
    REQUIRE(place.openings().rows().size() == 3);
    REQUIRE(wish(2) == EndWish::Outlet);
    for (const int number : {1, 2, 3}) {
        const auto& items = shell->app().ui().items();
        const ScreenRect marker = items.at("view.end." + std::to_string(number)).rect;
        const ScreenRect view = items.at("view.area").rect;
        CHECK(marker.y >= view.y);
        CHECK(marker.y + marker.height <= view.y + view.height);
    }
    WHEN("the button of a row is clicked") {
        REQUIRE(shell->click_item("end.2.fate"));
        REQUIRE(shell->settle(60s));
        CHECK(wish(2) == EndWish::Closed);
        CHECK(place.openings().selected() == 2);
        THEN("the card beside the marker shows it, and takes it back") {
            REQUIRE(shell->click_item("card.Outlet"));
            REQUIRE(shell->settle(60s));
            CHECK(wish(2) == EndWish::Outlet);
        }
        THEN("all is as planned after one click more") {
            REQUIRE(shell->click_item("ends.plain"));
            REQUIRE(shell->settle(60s));
            CHECK(wish(2) == EndWish::Outlet);
            CHECK(place.form()->field("closed").text.empty());
        }
    }
    WHEN("a marker is clicked") {
        REQUIRE(shell->click_item("view.end.1"));
        REQUIRE(shell->settle(60s));
        CHECK(wish(1) == EndWish::Closed);
        CHECK(place.openings().selected() == 1);
    }
    WHEN("an end is made the inlet") {
        REQUIRE(shell->click_item("end.3.inlet"));
        REQUIRE(shell->settle(60s));
        CHECK(wish(3) == EndWish::Inlet);
        CHECK(wish(1) == EndWish::Outlet);
    }
    WHEN("a row is chosen") {
        REQUIRE(shell->click_item("end.2"));
        REQUIRE(shell->settle(60s));
        CHECK(wish(2) == EndWish::Outlet);
        THEN("its cut has handles") {
            CHECK(shell->has("cut.slide"));
            CHECK(shell->has("cut.tilt"));
        }
        THEN("keys go on from there") {
            shell->press_key(keys::kDown);
            CHECK(place.openings().selected() == 3);
            shell->press_key(keys::kSpace);
            REQUIRE(shell->settle(60s));
            CHECK(wish(3) == EndWish::Closed);
        }
    }
}

SCENARIO("Marks of neighbouring ends do not lie on each other", "[window][openings]") {
    const PixelView view{.camera = {}, .width = 400, .height = 300, .left = 50, .top = 20};
    const std::vector<std::optional<ViewPixel>> ends = {
        ViewPixel(200, 150), ViewPixel(205, 152), std::nullopt,        ViewPixel(200, 25),
        ViewPixel(202, 149), ViewPixel(52, 318),  ViewPixel(204, 148), ViewPixel(900, 900)};
    const auto marks = marks_apart(view, ends, 30, 24);
    REQUIRE(marks.size() == ends.size());
    CHECK((*marks[0] - ViewPixel(200, 120)).norm() < 1e-9);  // above, as there is room
    CHECK_FALSE(marks[2]);
    CHECK(marks[3]->y() > 25);  // below: the view ends above it
    for (std::size_t i = 0; i + 1 < marks.size(); ++i) {
        if (!marks[i]) continue;
        CHECK(marks[i]->x() >= 62);
        CHECK(marks[i]->y() <= 308);
        for (std::size_t k = 0; k < i; ++k)
            if (marks[k]) CHECK((*marks[i] - *marks[k]).norm() > 24);
    }
    CHECK((*marks[7] - ViewPixel(900, 870)).norm() < 1e-9);  // of an end out of sight
}

SCENARIO("The role that an opening has is the highlighted one", "[window][openings]") {
    const auto shell = test_shell();
    if (!shell) return;
    const std::string file = temporary_folder() + "/tube.vtp";
    write_surface(fine_tube(4.0, 30.0, 24), file);
    open_and_wait(*shell, file);
    Workplace& place = shell->app().place();
    const auto patches = measure_patches(*place.document.shown()->surface);
    const auto inlet = std::ranges::find(patches, PatchKind::Inlet, &PatchMeasures::kind);
    REQUIRE(inlet != patches.end());
    place.get<OpeningsFeature>().click(*inlet);
    shell->frame();
    REQUIRE(shell->has("role.inlet"));
    REQUIRE(shell->click_item("role.inlet"));
    CHECK_FALSE(shell->has("role.inlet"));
    CHECK_FALSE(place.form());
}
