// What was decided about a vessel end holds for every variant and for later runs of a recipe.

#include "workbench/prepare/decided_ends.h"

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/formats/surface_file.h"
#include "geometry/kernel/measure.h"
#include "geometry/phantoms/exact_surface.h"
#include "geometry/phantoms/field.h"
#include "tests/support/paths.h"
#include "tests/support/program.h"
#include "tests/support/shapes.h"
#include "workbench/operations/clip_opening/parameters.h"
#include "workbench/operations/table.h"
#include "workbench/phantoms/phantom_json.h"
#include "workbench/prepare/apply_recipe.h"
#include "workbench/prepare/before_cuts.h"
#include "workbench/prepare/decided_entry.h"
#include "workbench/prepare/input.h"
#include "workbench/prepare/prepared_purposes.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Lines = std::vector<std::string>;

namespace {

/// Places of the bundled case [mm], from cases/phantoms/aneurysm.json.
const Vec3 kSac(-3.4, -1.5, 16.2), kInlet(-4.5, 2.5, -6.0), kOutletA(5.6, 7.6, 53.0),
    kOutletB(4.4, -6.0, 53.0), kLowStub(0.0, 5.6, 8.2), kHighStub(2.4, -6.0, 41.2);

/// The exact surface of a built-in phantom, as a file. \param edge of its triangles [mm]
std::string surface_of_phantom(const std::string& name, double edge) {
    const PhantomField field(builtin_phantom(name).parts);
    const std::string file = temporary_folder() + "/" + name + ".vtp";
    write_surface(exact_surface(field, field.bounds(), edge), file);
    return file;
}

/// The bundled vessel with its stubs.
Session vessel_with_stubs() {
    static const std::string file = surface_of_phantom("aneurysm", 0.35);
    SessionOptions options{.find = find_operation};
    options.worker.command = {program_path(), "--worker"};
    Session session = Session::unsaved(options);
    session.apply("load-surface", {{"file", file}, {"units", std::string("mm")}});
    return session;
}

Session bundled_vessel() {
    Session session = vessel_with_stubs();
    session.apply("remove-branch", {{"tip", kLowStub}});
    session.apply("remove-branch", {{"tip", kHighStub}});
    return session;
}

/// Runs a recipe of one entry that opens the ends. \return what was said
Lines open_ends(Session& session, const std::string& variant, const Arguments& more = {}) {
    GivenArguments given(find_operation("clip-opening"));
    given.set("accept_doubts", true);
    for (const auto& [name, value] : more.values()) given.set(name, value);
    Lines lines;
    apply_recipe(session, {{.given = given}}, variant,
                 [&](const std::string& line) { lines.push_back(line); }, {});
    return lines;
}

LogEntry last_of(const Session& session, const std::string& variant) {
    return session.log(variant).back();
}

Lines remarks_in(Lines lines) {
    std::erase_if(lines, [](const std::string& line) {
        return line.find(" as decided in ") == std::string::npos;
    });
    return lines;
}

bool names_place(const Arguments& given, const char* parameter, const Vec3& place, double reach) {
    return std::ranges::any_of(points_of(given, parameter),
                               [&](const Vec3& named) { return (named - place).norm() < reach; });
}

/// The opening within 4 mm of a place; none: it is closed.
std::optional<PatchKind> opening_at(Session& session, const std::string& variant,
                                    const Vec3& place) {
    const Scene scene = session.scene(variant);
    for (const PatchMeasures& patch : measure_patches(*scene.surface))
        if (patch.kind != PatchKind::Wall && (patch.centroid - place).norm() < 4.0)
            return patch.kind;
    return std::nullopt;
}

Value list(const Vec3& place) {
    return std::vector<double>{place.x(), place.y(), place.z()};
}

/// Changes the edit that opens the ends, as a user does who names some arguments.
void change_ends(Session& session, const Arguments& more) {
    const EditId edit = last_of(session, "cfd").edit.edit.id;
    const DecidedEntry changed =
        decided_change(edit, given_arguments(find_operation("clip-opening"), more), session, {});
    session.change_edit(edit, changed.entry.given);
}

/// The number of the end nearest to a place, in the list of ends.
double number_at(Session& session, const Vec3& place) {
    const LogEntry edit = last_of(session, "cfd");
    const auto ends = nlohmann::json::parse(edit.result->report)["ends"];
    const auto distance = [&](const nlohmann::json& end) {
        const auto at = end["place_mm"].get<std::vector<double>>();
        return (Vec3(at[0], at[1], at[2]) - place).norm();
    };
    return std::ranges::min_element(ends, {}, distance)->at("number").get<double>();
}

}  // namespace

SCENARIO("A sac that was closed stays closed in the other variant", "[workbench][ends]") {
    Session session = bundled_vessel();
    open_ends(session, "cfd");
    REQUIRE_FALSE(opening_at(session, "cfd", kSac));
    REQUIRE(opening_at(session, "cfd", kOutletB));
    session.apply("remove-branch", {{"tip", kOutletB}});
    WHEN("a branch is removed, and a recipe opens the ends for another purpose") {
        const Lines said = open_ends(session, "rp");
        const LogEntry edit = last_of(session, "rp");
        CAPTURE(said);
        CHECK_FALSE(opening_at(session, "rp", kSac));
        CHECK(opening_at(session, "rp", kInlet));
        CHECK(opening_at(session, "rp", kOutletA));
        AND_THEN("the decision is an argument of the edit, and is said where the odds differ") {
            CHECK(names_place(edit.edit.given, "closed", kSac, 6.0) ==
                  (remarks_in(said).size() == 1));
        }
        AND_THEN("it replays to the same bits") {
            for (const ReplayEntry& entry : session.replay()) CHECK(entry.differences.empty());
        }
    }
}

SCENARIO("A chosen inlet stays the inlet", "[workbench][ends]") {
    Session session = bundled_vessel();
    open_ends(session, "cfd", {{"inlet", Value(std::vector<double>{5.6, 7.6, 53.0})}});
    REQUIRE(opening_at(session, "cfd", kOutletA) == PatchKind::Inlet);
    WHEN("another purpose opens the ends") {
        const Lines said = open_ends(session, "simulation");
        CHECK(opening_at(session, "simulation", kOutletA) == PatchKind::Inlet);
        CHECK(opening_at(session, "simulation", kInlet) == PatchKind::Outlet);
        REQUIRE(remarks_in(said).size() == 1);
        CHECK_THAT(remarks_in(said)[0],
                   Catch::Contains("1 end as decided in the variant cfd: inlet at"));
    }
    WHEN("the edit is removed, and the recipe runs again") {
        session.remove_edit(last_of(session, "cfd").edit.edit.id);
        open_ends(session, "cfd");
        CHECK(opening_at(session, "cfd", kOutletA) == PatchKind::Inlet);
    }
    WHEN("the recipe itself names another one") {
        const Lines said = open_ends(session, "simulation",
                                     {{"inlet", Value(std::vector<double>{4.4, -6.0, 53.0})}});
        CHECK(remarks_in(said).empty());
        CHECK(opening_at(session, "simulation", kOutletB) == PatchKind::Inlet);
    }
    WHEN("the ends are listed for a purpose that has not opened them") {
        const std::string project = temporary_folder() + "/case.vbench";
        session.save_as(project);
        begin_purpose(project, "simulation");
        const BeforeCuts before =
            before_cuts({.input = project}, "simulation", {}, [](const std::string&) {}, {});
        CHECK(names_place(before.cutting, "inlet", kOutletA, 4.0));
    }
    WHEN("its branch is removed") {
        session.apply("remove-branch", {{"tip", kOutletA}});
        const Lines said = open_ends(session, "simulation");
        THEN("the inlet is chosen among those that there are") {
            CHECK(opening_at(session, "simulation", kInlet) == PatchKind::Inlet);
            CHECK_FALSE(
                names_place(last_of(session, "simulation").edit.given, "inlet", kOutletA, 4.0));
        }
    }
}

SCENARIO("A print that leaves closed ends opens none that was decided to be open",
         "[workbench][ends]") {
    Session session = bundled_vessel();
    open_ends(session, "cfd");
    const Lines said = open_ends(
        session, "rp", {{"check", std::string("none")}, {"closed_ends", std::string("leave")}});
    CHECK(remarks_in(said).empty());
    CHECK_FALSE(opening_at(session, "rp", kOutletA));
    AND_THEN("its closed ends decide nothing about a flow") {
        const auto decided = decided_ends(*session.snapshot());
        CHECK(std::ranges::none_of(decided,
                                   [](const DecidedEnd& end) { return end.variant == "rp"; }));
        CHECK(decided.size() >= 4);
    }
}

SCENARIO("No end changes its side because another branch was removed", "[workbench][ends]") {
    for (const Vec3& removed : {kOutletA, kOutletB, kLowStub, kHighStub}) {
        Session session = vessel_with_stubs();
        open_ends(session, "cfd");
        const auto before = decided_ends(*session.snapshot());
        REQUIRE(before.size() >= 6);
        session.apply("remove-branch", {{"tip", removed}});
        open_ends(session, "simulation");
        CAPTURE(removed.transpose());
        for (const DecidedEnd& end : before) {
            CAPTURE(end.place.transpose());
            if ((end.place - removed).norm() < 8.0) continue;
            CHECK(opening_at(session, "simulation", end.place).has_value() ==
                  (end.role != EndRole::Closed));
        }
    }
}

SCENARIO("A change of one end leaves all others as they were decided", "[workbench][ends]") {
    GIVEN("ends of which the program closed the sac, before a branch was removed") {
        Session session = bundled_vessel();
        open_ends(session, "cfd");
        session.apply("remove-branch", {{"tip", kOutletB}});
        WHEN("another end becomes the inlet") {
            change_ends(session, {{"inlet", list(kOutletA)}});
            CHECK(opening_at(session, "cfd", kOutletA) == PatchKind::Inlet);
            CHECK(opening_at(session, "cfd", kInlet) == PatchKind::Outlet);
            CHECK_FALSE(opening_at(session, "cfd", kSac));
        }
        WHEN("the sac itself is named") {
            change_ends(session, {{"open", list(kSac)}});
            CHECK(opening_at(session, "cfd", kSac));
            CHECK(opening_at(session, "cfd", kInlet) == PatchKind::Inlet);
        }
    }
    GIVEN("ends of which a user closed one and chose the inlet") {
        Session session = bundled_vessel();
        open_ends(session, "cfd",
                  {{"closed", list(kOutletB)}, {"inlet", list(kOutletA)}, {"open", list(kSac)}});
        REQUIRE_FALSE(opening_at(session, "cfd", kOutletB));
        REQUIRE(opening_at(session, "cfd", kOutletA) == PatchKind::Inlet);
        WHEN("one more end is closed") {
            change_ends(session, {{"closed", list(kInlet)}});
            CHECK_FALSE(opening_at(session, "cfd", kInlet));
            CHECK_FALSE(opening_at(session, "cfd", kOutletB));
            CHECK(opening_at(session, "cfd", kOutletA) == PatchKind::Inlet);
            CHECK(opening_at(session, "cfd", kSac) == PatchKind::Outlet);
        }
        WHEN("the inlet is another one") {
            change_ends(session, {{"inlet", list(kInlet)}});
            CHECK(opening_at(session, "cfd", kInlet) == PatchKind::Inlet);
            CHECK(opening_at(session, "cfd", kOutletA) == PatchKind::Outlet);
            CHECK_FALSE(opening_at(session, "cfd", kOutletB));
            CHECK(opening_at(session, "cfd", kSac) == PatchKind::Outlet);
        }
        WHEN("the inlet is named by its number") {
            const double number = number_at(session, kInlet);
            change_ends(session, {{"inlet_ends", Value(std::vector<double>{number})}});
            CHECK(opening_at(session, "cfd", kInlet) == PatchKind::Inlet);
            CHECK(opening_at(session, "cfd", kOutletA) == PatchKind::Outlet);
        }
        WHEN("the closed end becomes the inlet") {
            change_ends(session, {{"inlet", list(kOutletB)}});
            CHECK(opening_at(session, "cfd", kOutletB) == PatchKind::Inlet);
            CHECK(opening_at(session, "cfd", kOutletA) == PatchKind::Outlet);
        }
        WHEN("the blood flows another way") {
            change_ends(session, {{"vessel", std::string("vein")}, {"inlet", list(kInlet)}});
            CHECK_FALSE(opening_at(session, "cfd", kOutletB));
        }
        WHEN("nothing is said of ends") {
            change_ends(session, {{"strict", true}});
            CHECK(opening_at(session, "cfd", kOutletA) == PatchKind::Inlet);
            CHECK_FALSE(opening_at(session, "cfd", kOutletB));
        }
    }
}

SCENARIO("A changed edit keeps the ends that it named by numbers of an earlier input",
         "[workbench][ends]") {
    Session session = bundled_vessel();
    open_ends(session, "cfd");
    const double number = number_at(session, kOutletB);
    session.undo();
    open_ends(session, "cfd", {{"close_ends", Value(std::vector<double>{number})}});
    REQUIRE_FALSE(opening_at(session, "cfd", kOutletB));
    session.apply("remove-branch", {{"tip", kOutletA}});
    change_ends(session, {{"check", std::string("none")}});
    CHECK_FALSE(opening_at(session, "cfd", kOutletB));
    CHECK(opening_at(session, "cfd", kInlet) == PatchKind::Inlet);
}

SCENARIO("`change` says which ends stay what they were decided to be", "[workbench][ends]") {
    Session session = bundled_vessel();
    open_ends(session, "cfd", {{"closed", list(kOutletB)}});
    const std::string project = temporary_folder() + "/case.vbench";
    session.save_as(project);
    const auto id = std::to_string(last_of(session, "cfd").edit.edit.id);
    const ProgramRun run =
        run_program(program_path(), {"change", project, id, "inlet=5.6,7.6,53", "--json"});
    CHECK(run.exit_code == 0);
    CHECK_THAT(run.err, Catch::Contains("1 end as decided in the variant cfd: closed at"));
    const auto edit = nlohmann::json::parse(run.out);
    CHECK(edit["given"]["closed"].size() == 3);
}

SCENARIO("Numbers of ends name the same ends beside what was decided", "[workbench][ends]") {
    Session session = bundled_vessel();
    open_ends(session, "cfd", {{"closed", Value(std::vector<double>{4.4, -6.0, 53.0})}});
    REQUIRE_FALSE(opening_at(session, "cfd", kOutletB));
    Session other = bundled_vessel();
    open_ends(other, "cfd", {{"inlet_ends", Value(std::vector<double>{3})}});
    open_ends(session, "simulation", {{"inlet_ends", Value(std::vector<double>{3})}});
    for (const Vec3& place : {kInlet, kOutletA})
        CHECK((opening_at(session, "simulation", place) == PatchKind::Inlet) ==
              (opening_at(other, "cfd", place) == PatchKind::Inlet));
    CHECK(opening_at(session, "simulation", kOutletB).has_value() ==
          (opening_at(other, "cfd", kOutletB) == PatchKind::Inlet));
}

SCENARIO("The bundled case's print leaves closed ends closed", "[workbench][ends]") {
    const Input input = resolve_input({.input = "aneurysm"}, {});
    for (const std::string purpose : {"cfd", "rp"}) {
        const Recipe recipe = input_recipe(input, purpose, own_recipe(input, purpose));
        const auto cut = std::ranges::find_if(recipe, [](const RecipeEntry& entry) {
            return entry.given.operation().recipe.cuts_ends;
        });
        REQUIRE(cut != recipe.end());
        CHECK(cut->given->is_word("closed_ends", "leave") == (purpose == "rp"));
        CHECK(cut->given->is_word("check", "none") == (purpose == "rp"));
    }
}
