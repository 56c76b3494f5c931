// The case in the window: which requests may meet, and that what is shown belongs to its state.

#include "workbench/window/case/document.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <functional>
#include <thread>
#include <vector>

#include <catch2/catch.hpp>
#include <sqlite3.h>

#include "geometry/formats/surface_file.h"
#include "tests/support/program.h"
#include "tests/support/shapes.h"
#include "tests/window/case_folder.h"
#include "tests/window/window_support.h"
#include "workbench/session/task_thread.h"
#include "workbench/window/case/history_tree.h"
#include "workbench/window/case/rail.h"
#include "workbench/window/case/request.h"

using namespace vesselbench;
using namespace vesselbench::test;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;

namespace fs = std::filesystem;

namespace {

bool poll_until(Document& document, const std::function<bool()>& done) {
    for (const auto end = std::chrono::steady_clock::now() + 60s;
         std::chrono::steady_clock::now() < end; std::this_thread::sleep_for(2ms)) {
        document.poll();
        if (done()) return true;
    }
    return false;
}

bool wait_for_rest(Document& document) {
    return poll_until(document, [&] { return !document.busy(); });
}

DocumentOptions options() {
    return {.session = session_options(), .documents = temporary_folder()};
}

std::vector<std::string> operations_in(const Document& document) {
    std::vector<std::string> names;
    for (const LogEntry& entry : document.snapshot()->log) names.push_back(entry.edit.operation);
    return names;
}

bool told(const Document& document, const std::string& text) {
    for (const Message& message : document.messages())
        if (message.text.find(text) != std::string::npos) return true;
    return false;
}

void write_sql(const fs::path& project, const std::string& sql) {
    sqlite3* database = nullptr;
    REQUIRE(sqlite3_open(project.c_str(), &database) == SQLITE_OK);
    CHECK(sqlite3_exec(database, sql.c_str(), nullptr, nullptr, nullptr) == SQLITE_OK);
    sqlite3_close(database);
}

}  // namespace

SCENARIO("Nothing disturbs a recipe while it runs", "[window][document]") {
    GIVEN("a case that is being prepared") {
        Document document(options());
        document.open({.path = case_folder(
                           R"([{"operation": "smooth", "arguments": {"iterations": 300}},
                               {"operation": "subdivide"}, {"operation": "smooth"}])")});
        REQUIRE(wait_for_rest(document));
        REQUIRE(document.is_open());
        const StateId before = document.snapshot()->history->current();
        document.prepare("cfd");
        REQUIRE_FALSE(document.can(RequestKind::History));
        WHEN("another state is asked for, an edit, an export and a file that is broken") {
            document.jump(before);
            document.undo();
            document.apply("decimate", {}, Step::Remeshing);
            document.export_to(fs::path(temporary_folder()) / "model.unknown");
            document.show_variant("rp");
            const fs::path broken = fs::path(temporary_folder()) / "broken.stl";
            write_text(broken, "no surface");
            document.open({.path = broken});
            REQUIRE(wait_for_rest(document));
            THEN("they are refused, and the recipe ends") {
                CHECK(told(document, "Not now: the model is being prepared"));
                CHECK(told(document, "Prepared the model for flow simulation"));
                CHECK(document.variant() == "cfd");
                CHECK(operations_in(document) ==
                      std::vector<std::string>{"load-surface", "smooth", "smooth", "subdivide"});
            }
        }
        WHEN("it is cancelled") {
            document.cancel();
            REQUIRE(wait_for_rest(document));
            THEN("other requests are possible again") {
                CHECK(document.can(RequestKind::Edit));
                CHECK_FALSE(told(document, "Prepared"));
            }
        }
    }
}

SCENARIO("Cancelling a recipe ends it, also when the running entry cannot be stopped any more",
         "[window][document]") {
    Document document(options());
    document.open(
        {.path = case_folder(R"([{"operation": "subdivide"}, {"operation": "smooth"}])")});
    REQUIRE(wait_for_rest(document));
    document.prepare("cfd");
    while (!document.runner()->idle()) std::this_thread::sleep_for(2ms);
    document.cancel();
    REQUIRE(wait_for_rest(document));
    CHECK(operations_in(document) == std::vector<std::string>{"load-surface", "subdivide"});
    CHECK(told(document, "Cancelled"));
    CHECK(document.can(RequestKind::Edit));
}

SCENARIO("A stroke stays in view although edits behind it become pending", "[window][document]") {
    Document document(options());
    document.open({.path = tube_file()});
    REQUIRE(wait_for_rest(document));
    document.apply("clip-opening", {}, Step::Openings);
    REQUIRE(wait_for_rest(document));
    document.apply("tetrahedralize", {}, Step::Product);
    REQUIRE(wait_for_rest(document));
    document.stand_before(EditSite{.edit = {}, .step = Step::LocalRepair});
    REQUIRE(wait_for_rest(document));
    const Surface before = *document.shown()->surface;
    REQUIRE(document.can_paint());
    document.begin_stroke({.operation = "brush-inflate", .radius = 2.0, .strength = 0.5},
                          Step::LocalRepair);
    document.add_dab({.point = {4, 0, 15}, .normal = {1, 0, 0}});
    REQUIRE(poll_until(document, [&] { return !document.take_moves().empty(); }));
    document.end_stroke();
    bool seen = true, ready = true;
    REQUIRE(poll_until(document, [&] {
        seen = seen && document.shown() != nullptr &&
               document.shown()->surface->points() != before.points();
        const bool entered = document.snapshot()->log.size() > 3;
        ready = ready && (!entered || document.can_paint());
        return !document.busy();
    }));
    CHECK(seen);
    CHECK(ready);
    CHECK(document.snapshot()->log[1].edit.place.step == Step::LocalRepair);
    CHECK(pending_count(*document.snapshot(), document.variant()) == 2);
}

SCENARIO("A request that ends while others are collected is not lost", "[window][document]") {
    GIVEN("requests that end while they are collected") {
        constexpr int kRequests = 2000;
        TaskThread thread;
        std::vector<Request> requests;
        for (int i = 0; i < kRequests; ++i) {
            requests.push_back({.label = {.what = std::to_string(i)},
                                .run = std::make_shared<TaskRun>([](const Progress&) {})});
            thread.add(requests.back().run);
        }
        THEN("each is returned once") {
            std::vector<std::string> returned, all;
            while (!requests.empty())
                for (const Request& request : take_ended(requests))
                    returned.push_back(request.label.what);
            for (int i = 0; i < kRequests; ++i) all.push_back(std::to_string(i));
            std::ranges::sort(returned);
            std::ranges::sort(all);
            CHECK(returned == all);
        }
    }
}

SCENARIO("A preview is shown only for what it was asked for", "[window][document]") {
    Document document(options());
    document.open({.path = tube_file(64)});
    REQUIRE(wait_for_rest(document));
    REQUIRE(document.is_open());
    document.preview("smooth", {{"iterations", Value(std::int64_t{200})}}, Step::Smoothing);
    WHEN("its form is left while it is made") {
        document.drop_preview();
        REQUIRE(wait_for_rest(document));
        THEN("it does not appear") {
            CHECK_FALSE(document.previewed());
        }
    }
    WHEN("another one is asked for") {
        document.preview("subdivide", {}, Step::Remeshing);
        REQUIRE(wait_for_rest(document));
        THEN("only that one is shown") {
            REQUIRE(document.previewed());
            CHECK(document.previewed()->edit().operation == "subdivide");
        }
    }
    WHEN("an edit is made meanwhile") {
        document.apply("subdivide", {}, Step::Remeshing);
        REQUIRE(wait_for_rest(document));
        THEN("the edit is shown") {
            CHECK_FALSE(document.previewed());
            CHECK(operations_in(document).back() == "subdivide");
        }
    }
}

SCENARIO("What is shown belongs to the state, whatever is asked meanwhile", "[window][document]") {
    GIVEN("a project with two edits, freshly opened at its first state") {
        const fs::path project = fs::path(temporary_folder()) / "tube.vbench";
        {
            Session session = Session::create(project, session_options());
            session.apply("load-surface", {{"file", tube_file()}, {"units", std::string("mm")}});
            session.apply("subdivide", {});
        }
        Document document(options());
        document.open({.path = project});
        REQUIRE(poll_until(document, [&] { return document.is_open(); }));
        const std::size_t triangles = read_surface(tube_file()).surface.triangles().size();
        WHEN("another state is chosen, and a preview at once, again and again") {
            for (const StateId state : {1, 2, 1}) {
                document.jump(state);
                document.preview("smooth", {}, Step::Smoothing);
                document.drop_preview();
                document.save_copy(fs::path(temporary_folder()) / "copy.vbench");
                REQUIRE(wait_for_rest(document));
                REQUIRE(document.current() != nullptr);
                REQUIRE(document.current()->surface);
                const std::size_t edits = document.snapshot()->log.size();
                CHECK(document.current()->surface->triangles().size() ==
                      triangles * (edits == 2 ? 4 : 1));
            }
            THEN("its figures are known as well") {
                CHECK(document.figures().volume);
            }
        }
    }
}

SCENARIO("What was made at an end is no deviation from the source", "[window][document]") {
    const fs::path project = fs::path(temporary_folder()) / "tube.vbench";
    {
        Session session = Session::create(project, session_options());
        session.apply("load-surface", {{"file", tube_file()}, {"units", std::string("mm")}});
        session.apply("clip-opening", {});
        session.apply("extrude-opening", {{"length", 20.0}});
    }
    Document document(options());
    document.open({.path = project});
    document.want_deviation(true);
    REQUIRE(wait_for_rest(document));
    REQUIRE(document.figures().deviation);
    CHECK(document.figures().deviation->largest < 0.2);
    REQUIRE(document.deviation());
    CHECK(document.deviation()->full < 0.2);
    const auto& values = document.deviation()->values;
    CHECK(std::ranges::any_of(values, [](double value) { return std::isnan(value); }));
    CHECK_FALSE(std::ranges::all_of(values, [](double value) { return std::isnan(value); }));
}

SCENARIO("Going through the history says where it led", "[window][document]") {
    const fs::path project = fs::path(temporary_folder()) / "tube.vbench";
    const std::string small = temporary_folder() + "/small.off";  // in which unit?
    write_text(small,
               "OFF\n4 4 0\n0 0 0\n5 0 0\n0 5 0\n0 0 5\n"
               "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
    {
        Session session = Session::create(project, session_options());
        session.apply("load-surface", {{"file", small}, {"units", std::string("guess")}});
        session.apply("subdivide", {});
    }
    Document document(options());
    document.open({.path = project});
    REQUIRE(wait_for_rest(document));
    THEN("what the edits warned of is known again, and that it was opened comes last") {
        CHECK(told(document, "does not state its unit"));
        CHECK_THAT(document.messages().back().text, Contains("Opened"));
    }
    document.undo();
    REQUIRE(wait_for_rest(document));
    CHECK(document.messages().back().text == "Undid edit 2, Subdivide");
    document.redo();
    REQUIRE(wait_for_rest(document));
    CHECK(document.messages().back().text == "Redid edit 2, Subdivide");
}

SCENARIO("A project of a version with more operations is shown", "[window][document]") {
    const fs::path project = fs::path(temporary_folder()) / "tube.vbench";
    {
        Session session = Session::create(project, session_options());
        session.apply("load-surface", {{"file", tube_file()}, {"units", std::string("mm")}});
        session.apply("subdivide", {});
    }
    write_sql(project, "UPDATE edits SET operation = 'hollow' WHERE operation = 'subdivide'");
    Document document(options());
    document.open({.path = project});
    REQUIRE(wait_for_rest(document));
    REQUIRE(document.is_open());
    const HistoryTree tree = history_tree(*document.snapshot());
    bool listed = false;
    for (const HistoryRow& row : tree.rows)
        listed = listed || row.arguments == "an operation of another version";
    CHECK(listed);
    std::size_t edits = 0;
    for (const RailStep& step : rail_of(*document.snapshot(), "cfd")) edits += step.edits.size();
    CHECK(edits == 2);
}
