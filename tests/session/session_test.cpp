#include "workbench/session/session.h"

#include <filesystem>
#include <fstream>

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "tests/session/small_operations.h"
#include "tests/session/sphere_session.h"
#include "tests/support/shapes.h"
#include "workbench/session/moved_places.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

Arguments bump_at(const Vec3& at, double height) {
    return {{"at", at}, {"reach", 4.0}, {"height", height}};
}

std::vector<EditStatus> statuses(const Session& session) {
    std::vector<EditStatus> all;
    for (const auto& line : session.log()) all.push_back(line.status);
    return all;
}

constexpr auto kDone = EditStatus::Done;
constexpr auto kPending = EditStatus::Pending;
constexpr auto kStale = EditStatus::Stale;

}  // namespace

SCENARIO("A note can be written on any revision of an edit", "[session]") {
    Session session = sphere_session();
    const EditId id = session.apply("bump", bump_at(kTop, 0.5)).edit.edit.id;
    session.change_edit(id, bump_at(kTop, 0.7));
    const auto states = session.snapshot()->history->states().size();
    session.set_note({id, 1}, "too little");
    session.set_note({id, 2}, "better");
    CHECK(session.log()[1].edit.note == "better");
    CHECK(session.snapshot()->past->at({id, 1}).edit.note == "too little");
    CHECK(session.snapshot()->history->states().size() == states);
    CHECK_THROWS_AS(session.set_note({id, 3}, "none"), UsageError);
    WHEN("the project is saved and opened") {
        const std::string file = temporary_folder() + "/noted.vbench";
        session.save_as(file);
        CHECK(Session::open(file, options()).log()[1].edit.note == "better");
    }
    session.set_note({id, 2}, "");
    CHECK(session.log()[1].edit.note.empty());
}

SCENARIO("A revision keeps the figures of its first run beside the newest", "[session]") {
    Session session = sphere_session();
    const EditRef scale = session.apply("scale", {}).edit.edit;
    session.change_edit(1, {{"radius", 4.0}});
    (void)session.scene();
    const auto check = [&](const Session& now) {
        const PastEdit past = now.snapshot()->past->at(scale);
        REQUIRE(past.first);
        REQUIRE(past.result);
        CHECK(past.first->id < past.result->id);
        CHECK(*past.first->change.volume_after > 2.0 * *past.result->change.volume_after);
    };
    check(session);
    const std::string file = temporary_folder() + "/runs.vbench";
    session.save_as(file);
    check(Session::open(file, options()));
    CHECK(session.snapshot()->past->at({1, 1}).first ==
          session.snapshot()->past->at({1, 1}).result);
}

SCENARIO("The scene of any state is known without going there", "[session]") {
    Session session = sphere_session();
    const double plain = top_of(session.scene());
    const StateId before = session.snapshot()->history->current();
    const EditId bump = session.apply("bump", bump_at(kTop, 0.5)).edit.edit.id;
    const StateId after = session.snapshot()->history->current();
    session.remove_edit(bump);
    const StateId now = session.snapshot()->history->current();
    CHECK(top_of(session.known_scene(before)) == plain);
    CHECK(top_of(session.known_scene(after)) == Approx(plain + 0.5));
    CHECK(session.known_scene(0).surface == std::nullopt);
    CHECK(session.snapshot()->history->current() == now);
    CHECK_THROWS_AS(session.known_scene(99), UsageError);
    WHEN("edits are pending there") {
        session.undo();
        session.change_edit(1, {{"radius", 4.0}});
        const StateId pending = session.snapshot()->history->current();
        REQUIRE(session.log()[1].status == kPending);
        session.jump(before);
        THEN("it is the scene before them") {
            CHECK(top_of(session.known_scene(pending)) < plain - 3.0);
        }
    }
}

SCENARIO("The log describes each edit and its effect", "[session]") {
    Session session = sphere_session();
    EditOptions how;
    how.note = "the bulge is real";
    const LogEntry entry = session.apply("bump", {{"at", kTop}, {"reach", 4.0}}, how);
    CHECK(entry.edit.author == "Ada");
    CHECK(entry.edit.note == "the bulge is real");
    CHECK(entry.edit.time.size() == 20);
    CHECK(entry.edit.given.has("at"));
    CHECK_FALSE(entry.edit.given.has("height"));
    REQUIRE(entry.result);
    CHECK(entry.result->resolved.has("height"));
    CHECK(entry.result->device == "cpu");
    CHECK_FALSE(entry.result->program_version.empty());
    const SurfaceChange& change = entry.result->change;
    CHECK(change.triangles_before == 320);
    CHECK(change.triangles_after == 320);
    CHECK(change.moved_vertices > 0);
    CHECK(change.largest_deviation.value() == Approx(entry.result->resolved.real("height")));
    CHECK(change.volume_after.value() > change.volume_before.value());
    const auto log = session.log();
    REQUIRE(log.size() == 2);
    CHECK(log[1].edit == entry.edit);
    CHECK(log[1].result->change == change);
    CHECK(log[1].result->report == entry.result->report);
}

SCENARIO("Undo and redo walk the states", "[session]") {
    Session session = sphere_session();
    const double before = top_of(session.scene());
    session.apply("bump", bump_at(kTop, 0.5));
    session.undo();
    CHECK(top_of(session.scene()) == before);
    session.redo();
    CHECK(top_of(session.scene()) == before + 0.5);
    session.undo(1);
    CHECK_FALSE(session.scene().surface);
    session.redo(2);
    CHECK(top_of(session.scene()) == before + 0.5);
    CHECK_THROWS_AS(session.redo(), UsageError);
}

SCENARIO("Changing an earlier edit replays the later ones", "[session]") {
    Session session = sphere_session();
    const double height =
        session.apply("bump", {{"at", kTop}, {"reach", 4.0}}).result->resolved.real("height");
    session.apply("scale", {});
    session.change_edit(1, {{"radius", 10.5}});
    CHECK(statuses(session) == std::vector{kDone, kPending, kPending});
    const double top = top_of(session.scene());
    THEN("with what they had decided") {
        CHECK(session.log()[1].result->resolved.real("height") == height);
        CHECK(top == 2.0 * (top_of(session.scene_after(1)) + height));
    }
    CHECK(statuses(session) == std::vector{kDone, kDone, kDone});
    CHECK(session.log()[0].edit.edit.revision == 2);
    THEN("and replay agrees") {
        for (const auto& entry : session.replay()) {
            CHECK(entry.replayed);
            CHECK(entry.differences.empty());
        }
    }
}

SCENARIO("Later edits decide anew where that is asked for", "[session]") {
    Session session = sphere_session();
    const double height =
        session.apply("bump", {{"at", kTop}, {"reach", 4.0}}).result->resolved.real("height");
    session.change_edit(1, {{"radius", 10.5}});
    CHECK(session.decide_anew() == 1);
    CHECK(session.decide_anew() == 1);  // it is still pending
    CHECK(statuses(session) == std::vector{kDone, kPending});
    static_cast<void>(session.scene());
    CHECK(session.log()[1].result->resolved.real("height") > height);
    CHECK(session.log()[1].edit.edit.revision == 3);
    CHECK(session.decide_anew() == 0);
    for (const auto& entry : session.replay()) CHECK(entry.differences.empty());
    session.undo(1);
    CHECK(session.log()[1].result->resolved.real("height") == height);
}

SCENARIO("Places follow a model into another unit, sizes keep their numbers", "[session]") {
    using enum ParameterType;
    const Operation operation{
        .name = "cut",
        .parameters = {{.name = "at", .type = Point, .unit = "mm", .meaning = Meaning::Tip},
                       {.name = "open", .type = List, .unit = "mm", .meaning = Meaning::Tip},
                       {.name = "planes",
                        .type = ParameterType::Records,
                        .fields = {{.name = "point", .type = Point, .unit = "mm"},
                                   {.name = "normal", .type = Point, .unit = "-"},
                                   {.name = "reach", .unit = "mm"},
                                   {.name = "way", .type = Choice}}},
                       {.name = "distance", .unit = "mm"},
                       {.name = "share", .unit = "-"},
                       {.name = "units", .type = Text, .meaning = Meaning::Unit}}};
    using Numbers = std::vector<double>;
    const auto plane = [](const Vec3& point, double reach) {
        return Arguments{{"point", point},
                         {"normal", Vec3(0, 0.6, 0.8)},
                         {"reach", reach},
                         {"way", std::string("cut")}};
    };
    const vesselbench::Records planes({plane({1, 2, 3}, 4), plane({4, 5, 6}, 7)});
    const Arguments given = {
        {"at", Vec3(1, 2, 3)}, {"open", Numbers{1, 2, 3, 4, 5, 6}},
        {"planes", planes},    {"dabs", Numbers{1, 2, 3, 0, 0, 1, 4, 5, 0.5, 1}},
        {"distance", 7.0},     {"share", 0.3}};
    const Arguments scaled = with_scaled_places(operation, given, 10.0);
    CHECK(scaled.point("at") == Vec3(10, 20, 30));
    CHECK(scaled.list("open") == Numbers{10, 20, 30, 40, 50, 60});
    CHECK(scaled.records("planes") ==
          vesselbench::Records({plane({10, 20, 30}, 40), plane({40, 50, 60}, 70)}));
    CHECK(scaled.real("distance") == 7.0);
    CHECK(given_sizes(operation, given) == std::vector<std::string>{"distance"});
    const Arguments in_mm = {{"units", std::string("mm")}}, in_m = {{"units", std::string("m")}};
    CHECK(unit_factor(operation, in_mm, in_m) == 1000.0);
    CHECK_FALSE(unit_factor(operation, in_m, in_m));
}

SCENARIO("An edit that no longer applies becomes stale, and says why", "[session]") {
    Session session = sphere_session();
    session.apply("bump", bump_at(kTop, 0.5));
    EditOptions smoothing;
    smoothing.step = Step::Smoothing;
    session.apply("bump", {{"at", Vec3(1, 2, 0)}, {"reach", 100.0}, {"height", 1.0}}, smoothing);
    session.change_edit(1, {{"radius", 3.0}});
    const Scene scene = session.scene();
    CHECK(statuses(session) == std::vector{kDone, kStale, kDone});
    CHECK(session.log()[1].reason == "no vertex lies within reach of the place");
    CHECK(top_of(scene) == Approx(top_of(session.scene_after(1)) + 1.0));
    THEN("what would mend it is stored with the reason") {
        const std::string file = temporary_folder() + "/stale.vbench";
        session.save_as(file);
        const Session opened = Session::open(file, options());
        for (const std::vector<LogEntry>& log : {session.log(), opened.log()}) {
            REQUIRE(log[1].refusal.size() == 1);
            CHECK(log[1].refusal[0].operation == "bump");
            CHECK(log[1].refusal[0].severity == Severity::Error);
            CHECK(log[1].refusal[0].remedies.at(0).arguments.at("reach") == "100");
            CHECK(log[2].refusal.empty());
        }
    }
    THEN("it comes back with the old first edit") {
        session.undo();
        CHECK(statuses(session) == std::vector{kDone, kDone, kDone});
    }
    THEN("it can be mended by a change") {
        session.change_edit(2, bump_at(Vec3(1.0, 2.0, 3.0), 0.1));
        CHECK(statuses(session) == std::vector{kDone, kDone, kPending});
    }
}

SCENARIO("An edit of an earlier step goes before the later ones", "[session]") {
    Session session = sphere_session();
    session.apply("scale", {});
    session.apply("bump", bump_at(kTop, 0.5));
    CHECK(session.log()[1].edit.operation == "bump");
    CHECK(statuses(session) == std::vector{kDone, kDone, kPending});
    CHECK(top_of(session.scene()) == 2.0 * top_of(session.scene_after(3)));
}

SCENARIO("Variants share the trunk only", "[session]") {
    Session session = sphere_session();
    const double top = top_of(session.scene());
    EditOptions print;
    print.variant = "rp";
    session.apply("scale", {{"factor", 3.0}}, print);
    session.apply("scale", {});
    CHECK(top_of(session.scene("cfd")) == 2.0 * top);
    CHECK(top_of(session.scene("rp")) == 3.0 * top);
    CHECK(top_of(session.scene("none yet")) == top);
}

SCENARIO("A failed operation leaves the session unchanged", "[session]") {
    Session session = sphere_session();
    const StateId state = session.snapshot()->history->current();
    CHECK_THROWS_AS(session.apply("no-such-thing", {}), UsageError);
    CHECK_THROWS_AS(session.apply("bump", {{"where", kTop}}), UsageError);
    CHECK_THROWS_AS(session.apply("bump", bump_at(Vec3(99, 0, 0), 1.0)), AlgorithmFailure);
    CHECK_THROWS_AS(session.apply("crash", {}), AlgorithmFailure);
    CHECK_THROWS_AS(session.change_edit(7, {}), UsageError);
    CHECK_THROWS_AS(session.change_edit(1, {{"levels", 0.5}}), UsageError);
    CHECK_THROWS_AS(session.remove_edit(2), UsageError);
    EditOptions wrong_step;
    wrong_step.step = Step::Product;
    CHECK_THROWS_AS(session.apply("bump", bump_at(kTop, 1.0), wrong_step), UsageError);
    std::stop_source stop;
    stop.request_stop();
    CHECK_THROWS_AS(session.apply("bump", bump_at(kTop, 1.0), {}, Progress({}, stop.get_token())),
                    Cancelled);
    CHECK(session.snapshot()->history->current() == state);
    CHECK(session.snapshot()->history->results().size() == 1);
    CHECK(session.log().size() == 1);
}

SCENARIO("A project holds the whole session", "[session]") {
    const std::string file = test::temporary_folder() + "/case.vbench";
    std::vector<LogEntry> log;
    Positions points;
    {
        Session session = Session::create(file, options());
        session.apply("make-sphere", {});
        session.apply("bump", bump_at(kTop, 0.5));
        session.apply("far-bump", bump_at(kTop, 0.25));
        session.apply("flatten", {});
        session.change_edit(2, bump_at(kTop, 0.75));
        points = surface_of(session.scene()).points();
        session.undo();
        log = session.log();
        CHECK_THROWS_AS(Session::create(file, options()), IoError);
    }
    CHECK_FALSE(std::filesystem::exists(file + "-lock"));
    CHECK_FALSE(std::filesystem::exists(file + "-wal"));
    Session session = Session::open(file, options());
    CHECK(session.read_only_reason().empty());
    const auto again = session.log();
    REQUIRE(again.size() == log.size());
    for (std::size_t i = 0; i < log.size(); ++i) {
        CHECK(again[i].edit == log[i].edit);
        CHECK(again[i].result->resolved == log[i].result->resolved);
        CHECK(again[i].result->change == log[i].result->change);
    }
    session.redo();
    const Scene scene = session.scene();
    CHECK(surface_of(scene).points() == points);
    CHECK(scene.surface->patches.size() == 2);
    CHECK(scene.surface->attributes.contains("weight"));
    CHECK(scene.volume_mesh->tetrahedra.size() == 1);
    CHECK(scene.neighbours.contains("bone"));
    THEN("states that differ in shape only share their topology in memory, read back too") {
        CHECK(session.scene_after(1).surface->topology == scene.surface->topology);
    }
    THEN("replay finds no difference") {
        const auto replayed = session.replay();
        CHECK(replayed.size() == 4);
        for (const auto& entry : replayed) {
            CHECK(entry.replayed);
            CHECK(entry.differences.empty());
        }
    }
    THEN("a copy is a project of its own") {
        const std::string copy = file + ".copy";
        session.save_as(copy);
        CHECK_THROWS_AS(session.save_as(copy), IoError);
        session.apply("bump", bump_at(kTop, 1.0));
        Session other = Session::open(copy, options());
        CHECK(other.log().size() == 4);
        CHECK(surface_of(other.scene()).points() == points);
    }
}

SCENARIO("Replay reports results that are not reproduced", "[session]") {
    const std::string file = test::temporary_folder() + "/case.vbench";
    {
        Session session = Session::create(file, options());
        session.apply("make-sphere", {});
        session.apply("bump", bump_at(kTop, 0.5));
    }
    SessionOptions other = options();
    other.find = [](const std::string& name) -> const Operation& {
        static Operation changed = test::find_test_operation("bump");
        changed.run = [](const Scene& scene, const Arguments& arguments, Progress& progress) {
            Outcome outcome = test::find_test_operation("bump").run(scene, arguments, progress);
            Positions points = outcome.scene.surface->points();
            points.back().x() = std::nextafter(points.back().x(), 100.0);
            outcome.scene.surface = outcome.scene.surface->with_positions(std::move(points));
            return outcome;
        };
        return name == "bump" ? changed : test::find_test_operation(name);
    };
    Session session = Session::open(file, other);
    const auto replayed = session.replay();
    CHECK(replayed[0].differences.empty());
    CHECK(replayed[1].differences == std::vector<std::string>{"positions"});
}

SCENARIO("Source files are embedded, their folders are not", "[session]") {
    const std::string folder = test::temporary_folder();
    std::filesystem::create_directory(folder + "/patient-name");
    const std::string source = folder + "/patient-name/radius.txt";
    std::ofstream(source) << 7.5;
    const std::string file = folder + "/case.vbench";
    {
        Session session = Session::create(file, options());
        session.apply("load-sphere", {{"file", source}});
        CHECK(session.log()[0].edit.given.text("file") == "radius.txt");
        CHECK(session.replay()[0].replayed);
    }
    std::ifstream stream(file, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(stream)), {});
    CHECK(bytes.find("patient-name") == std::string::npos);
    Session session = Session::open(file, options());
    THEN("without the file the scene is there, and replay checks what is stored") {
        std::filesystem::remove(source);
        CHECK(top_of(session.scene()) == Approx(7.5));
        const auto replayed = session.replay();
        CHECK_FALSE(replayed[0].replayed);
        CHECK(replayed[0].differences.empty());
        CHECK(replayed[0].note.find("radius.txt") != std::string::npos);
        CHECK_THROWS_AS(session.change_edit(1, session.log()[0].edit.given), IoError);
    }
    THEN("beside the project it is found again, if it is the same") {
        std::filesystem::copy(source, folder + "/radius.txt");
        CHECK(session.replay()[0].replayed);
        session.change_edit(1, session.log()[0].edit.given);
        std::ofstream(folder + "/radius.txt") << 8.5;
        CHECK_FALSE(session.replay()[0].replayed);
    }
    THEN("a file that is said to be it is read, if it is the same") {
        std::filesystem::create_directory(folder + "/another");
        const std::string moved = folder + "/another/moved.txt", other = folder + "/other.txt";
        std::filesystem::rename(source, moved);
        std::ofstream(other) << 8.5;
        CHECK_FALSE(session.find_source_in(other));
        CHECK_FALSE(session.replay()[0].replayed);
        CHECK(session.find_source_in(moved));
        CHECK(session.replay()[0].replayed);
        session.change_edit(1, session.log()[0].edit.given);
    }
}

SCENARIO("An edit whose file was read in this session can be changed", "[session]") {
    const std::string folder = test::temporary_folder();
    std::filesystem::create_directory(folder + "/elsewhere");
    const std::string source = folder + "/elsewhere/radius.txt";
    std::ofstream(source) << 7.5;
    Session session = Session::create(folder + "/case.vbench", options());
    session.apply("load-sphere", {{"file", source}});
    const Arguments given = session.log()[0].edit.given;
    REQUIRE(given.text("file") == "radius.txt");
    WHEN("it is there") {
        session.change_edit(1, given);
        CHECK(session.replay()[0].replayed);
        CHECK(top_of(session.scene()) == Approx(7.5));
    }
    WHEN("another file has taken its name") {
        std::ofstream(source) << 8.5;
        CHECK_THROWS_WITH(session.change_edit(1, given),
                          Catch::Contains("has changed since it was read"));
    }
    WHEN("it is gone") {
        std::filesystem::remove(source);
        CHECK_THROWS_WITH(session.change_edit(1, given), Catch::Contains("is missing"));
    }
}

SCENARIO("Large images are referenced by their hash", "[session]") {
    const std::string folder = test::temporary_folder();
    const std::string source = folder + "/scan.txt";
    std::ofstream(source) << 3.0;
    SessionOptions small = options();
    small.embed_limit = 1000;
    const std::string file = folder + "/case.vbench";
    std::vector<float> voxels;
    {
        Session session = Session::create(file, small);
        session.apply("make-image", {{"file", source}, {"edge", std::int64_t{40}}});
        voxels = *session.scene().image->voxels;
    }
    CHECK(std::filesystem::file_size(file) < 200000);
    Session session = Session::open(file, small);
    CHECK(*session.scene().image->voxels == voxels);
    CHECK(session.replay()[0].differences.empty());
    THEN("without the file the error names it") {
        Session other = Session::open(file, small);
        std::ofstream(source) << 4.0;
        CHECK_THROWS_AS(other.scene(), IoError);
    }
}

SCENARIO("Memory is bounded, and dropped scenes are read again", "[session]") {
    SessionOptions tight = options();
    tight.scene_bytes = 200000;
    Session session = Session::unsaved(tight);
    session.apply("make-sphere", {{"levels", std::int64_t{4}}});
    for (int i = 0; i < 20; ++i) session.apply("bump", bump_at(kTop, 0.1));
    const double top = top_of(session.scene());
    for (int i = 0; i < 20; ++i) session.undo();
    CHECK(top_of(session.scene()) == Approx(top - 2.0));
    for (int i = 0; i < 20; ++i) session.redo();
    CHECK(top_of(session.scene()) == top);
}

SCENARIO("A failing edit leaves pending edits pending", "[session]") {
    Session session = sphere_session();
    session.apply("bump", bump_at(kTop, 0.5));
    session.change_edit(1, {{"radius", 10.5}});
    const auto before = session.snapshot();
    REQUIRE(statuses(session) == std::vector{kDone, kPending});
    CHECK_THROWS_AS(session.apply("bump", bump_at(Vec3(99, 0, 0), 1.0)), AlgorithmFailure);
    CHECK(statuses(session) == std::vector{kDone, kPending});
    CHECK(session.snapshot()->history->results().size() == before->history->results().size());
    THEN("and one that succeeds enters them, by one change") {
        session.apply("bump", bump_at(kTop, 0.25));
        CHECK(statuses(session) == std::vector{kDone, kDone, kDone});
        CHECK(session.replay()[1].differences.empty());
        CHECK(session.replay()[2].differences.empty());
        CHECK(session.log()[2].result->input == session.log()[1].result->id);
    }
    THEN("pending edits that have become stale are entered, too") {
        session.change_edit(1, {{"radius", 3.0}});
        session.apply("bump", {{"at", Vec3(1, 2, 0)}, {"reach", 100.0}, {"height", 1.0}});
        CHECK(statuses(session) == std::vector{kDone, kStale, kDone});
        CHECK(session.log()[2].result->input == session.log()[0].result->id);
    }
}

SCENARIO("A preview is shown first and entered later", "[session][preview]") {
    Session session = sphere_session();
    const auto before = session.snapshot();
    const Preview preview = session.preview("bump", {{"at", kTop}, {"reach", 4.0}});
    CHECK(preview.input_id() == before->log[0].result->id);
    CHECK(preview.result().change.moved_vertices > 0);
    CHECK(preview.result().resolved.has("height"));
    CHECK(session.snapshot()->history->states().size() == before->history->states().size());
    CHECK(statuses(session) == std::vector{kDone});
    WHEN("it is committed") {
        const LogEntry entry = session.commit(preview);
        CHECK(entry.edit.edit.id == 2);
        CHECK(entry.result->resolved == preview.result().resolved);
        CHECK(session.scene().surface->positions == preview.scene().surface->positions);
        CHECK(session.replay()[1].differences.empty());
        THEN("it cannot be committed twice: it would precede itself") {
            CHECK_THROWS_AS(session.commit(preview), UsageError);
        }
        THEN("after an undo it can") {
            session.undo();
            CHECK(session.commit(preview).edit.edit.id == 3);
        }
    }
    WHEN("an edit before it has changed") {
        session.change_edit(1, {{"radius", 10.5}});
        THEN("it is refused, and nothing is entered") {
            const auto now = session.snapshot();
            CHECK_THROWS_WITH(session.commit(preview),
                              Catch::Matchers::Contains("preview of bump no longer fits"));
            CHECK(session.snapshot()->history->states().size() == now->history->states().size());
        }
        THEN("it fits again when that is undone") {
            session.undo();
            CHECK(session.commit(preview).status == kDone);
        }
    }
    WHEN("an edit behind it was made meanwhile") {
        session.apply("scale", {});
        session.commit(preview);
        CHECK(statuses(session) == std::vector{kDone, kDone, kPending});
    }
}

SCENARIO("A change is previewed as well", "[session][preview]") {
    Session session = sphere_session();
    session.apply("bump", bump_at(kTop, 0.5));
    session.apply("scale", {});
    const Preview preview = session.preview_change(2, bump_at(kTop, 1.0));
    CHECK(top_of(preview.scene()) == top_of(preview.input()) + 1.0);
    const LogEntry entry = session.commit(preview);
    CHECK(entry.edit.edit == EditRef{2, 2});
    CHECK(statuses(session) == std::vector{kDone, kDone, kPending});
    session.remove_edit(2);
    CHECK_THROWS_AS(session.commit(preview), UsageError);
}

SCENARIO("A preview runs pending edits for itself", "[session][preview]") {
    Session session = sphere_session();
    session.apply("bump", bump_at(kTop, 0.5));
    session.change_edit(1, {{"radius", 10.5}});
    const Preview preview = session.preview("bump", bump_at(kTop, 0.25));
    CHECK_FALSE(preview.input_id());
    CHECK(statuses(session) == std::vector{kDone, kPending});
    WHEN("it is committed, they are") {
        session.commit(preview);
        CHECK(statuses(session) == std::vector{kDone, kDone, kDone});
    }
    WHEN("they have run by then, their results serve") {
        const double top = top_of(session.scene());
        session.commit(preview);
        CHECK(statuses(session) == std::vector{kDone, kDone, kDone});
        CHECK(session.snapshot()->history->results().size() == 5);
        CHECK(top_of(session.scene()) == top + 0.25);
    }
}

SCENARIO("A session that only reads may preview", "[session][preview]") {
    const std::string file = test::temporary_folder() + "/case.vbench";
    Session writer = Session::create(file, options());
    writer.apply("make-sphere", {});
    Session reader = Session::open(file, options());
    CHECK_FALSE(reader.snapshot()->read_only_reason.empty());
    const Preview preview = reader.preview("bump", bump_at(kTop, 0.5));
    CHECK(top_of(preview.scene()) == top_of(preview.input()) + 0.5);
    CHECK_THROWS_AS(reader.commit(preview), IoError);
    CHECK(reader.log().size() == 1);
}

SCENARIO("A stroke is one edit, the sum of what was drawn", "[session][live]") {
    Session session = sphere_session();
    LiveEdit live = session.start_live("stroke", {{"heights", std::vector<double>{0.1, 0.2}}});
    live.add({{"heights", std::vector<double>{0.3}}});
    const Positions drawn = surface_of(live.scene()).points();
    CHECK_THROWS_AS(live.add({{"heights", std::vector<double>{0.4, 0.0}}}), AlgorithmFailure);
    CHECK_THROWS_AS(live.add({{"depths", 1.0}}), UsageError);
    CHECK(surface_of(live.scene()).points() == drawn);
    const Preview half = session.preview(live);
    live.add({{"heights", std::vector<double>{-0.2}}});
    const LogEntry entry = session.commit(session.preview(live));
    CHECK(entry.edit.given.list("heights") == std::vector<double>{0.1, 0.2, 0.3, -0.2});
    CHECK(surface_of(session.scene()).points() == surface_of(live.scene()).points());
    CHECK(surface_of(half.scene()).points() == drawn);
    THEN("its replay, and the same arguments at once, give the same bits") {
        CHECK(session.replay()[1].differences.empty());
        session.undo();
        session.apply("stroke", entry.edit.given);
        CHECK(surface_of(session.scene()).points() == surface_of(live.scene()).points());
    }
    CHECK_THROWS_WITH(session.start_live("scale", {}),
                      Catch::Matchers::Contains("cannot be driven live"));
}

SCENARIO("A snapshot shows what is at hand", "[session][snapshot]") {
    const std::string file = test::temporary_folder() + "/case.vbench";
    {
        Session session = Session::create(file, options());
        session.apply("make-sphere", {});
        session.apply("scale", {});
        const auto now = session.snapshot();
        CHECK(now->project == "case.vbench");
        CHECK(now->read_only_reason.empty());
        CHECK(now->scenes.size() == 2);
        CHECK(top_of(now->scenes.at("cfd")) == 2.0 * top_of(now->scenes.at("")));
        session.change_edit(1, {{"radius", 5.0}});
        CHECK(now->log[0].edit.edit.revision == 1);
        CHECK(session.snapshot()->scenes.size() == 1);
        CHECK_FALSE(session.snapshot()->log[1].result);
    }
    Session session = Session::open(file, options());
    CHECK(session.snapshot()->scenes.empty());
    CHECK(session.snapshot()->log.size() == 2);
    static_cast<void>(session.scene());
    CHECK(session.snapshot()->scenes.contains("cfd"));
}

SCENARIO("A cancelled copy leaves no file", "[session]") {
    const std::string folder = test::temporary_folder();
    Session session = Session::create(folder + "/case.vbench", options());
    session.apply("make-sphere", {{"levels", std::int64_t{5}}});
    std::stop_source stop;
    stop.request_stop();
    CHECK_THROWS_AS(session.save_as(folder + "/copy.vbench", Progress({}, stop.get_token())),
                    Cancelled);
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        CHECK(entry.path().filename().string().find("copy") == std::string::npos);
    session.save_as(folder + "/copy.vbench");
    CHECK(std::filesystem::exists(folder + "/copy.vbench"));
}
