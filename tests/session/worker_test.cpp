#include "workbench/worker/worker.h"

#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <thread>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "geometry/kernel/errors.h"
#include "tests/session/small_operations.h"
#include "tests/support/shapes.h"
#include "tests/support/small_files.h"
#include "workbench/worker/run_operation.h"

using namespace vesselbench;
using namespace std::chrono_literals;

namespace {

Scene sphere() {
    Scene scene;
    scene.surface = test::icosphere(10.0, 3);
    return scene;
}

Outcome run(const std::string& name, const Scene& scene, const Arguments& given,
            WorkerOptions worker = test::test_worker(), Progress progress = {}) {
    const Operation& operation = test::find_test_operation(name);
    return run_operation(operation, scene, checked_arguments(operation, given), progress, worker);
}

std::string text_of(const std::function<void()>& call) {
    try {
        call();
    } catch (const std::exception& error) {
        return error.what();
    }
    return {};
}

const Arguments kTop = {{"at", Vec3(0.0, 0.0, 10.0)}, {"reach", 3.0}};

}  // namespace

SCENARIO("An isolated operation gives the same result as in process", "[session][worker]") {
    const Scene scene = sphere();
    const Outcome near = run("bump", scene, kTop);
    const Outcome far = run("far-bump", scene, kTop);
    CHECK(far.scene.surface->points() == near.scene.surface->points());
    CHECK(far.resolved == near.resolved);
    CHECK(far.resolved.has("height"));
    CHECK(far.report->dump() == near.report->dump());
    THEN("what it left alone is shared with its input") {
        CHECK(far.scene.surface->topology == scene.surface->topology);
        CHECK(far.scene.surface->positions != scene.surface->positions);
    }
}

SCENARIO("A result larger than files may be is no fault of the file that was read",
         "[session][worker]") {
    const std::string file = test::temporary_folder() + "/radius.txt";
    std::ofstream(file) << "10";
    WorkerOptions worker = test::test_worker();
    worker.every_operation = true;
    const auto load = [&] { static_cast<void>(run("load-sphere", {}, {{"file", file}}, worker)); };
    CHECK_NOTHROW(load());
    const test::SmallFiles small(2000);
    CHECK_THROWS_AS(load(), IoError);
    CHECK_THAT(text_of(load), Catch::Contains("ulimit -f") && !Catch::Contains("damaged"));
}

SCENARIO("Where all operations run in workers, some stay", "[session][worker]") {
    WorkerOptions worker = test::test_worker();
    worker.every_operation = true;
    const std::vector<Diagnostic> here = {plain_text(std::to_string(getpid()))};
    const Outcome near = run("where", sphere(), {{"here", true}}, worker);
    const Outcome far = run("where", sphere(), {{"here", false}}, worker);
    CHECK(near.warnings == here);
    CHECK(far.warnings != here);
    THEN("the device that computed the scene is known of both") {
        CHECK(near.device == "gpu");
        CHECK(far.device == "gpu");
        CHECK(run("far-bump", sphere(), kTop).device == "cpu");
    }
}

SCENARIO("A program that does not answer --worker does not start itself without end",
         "[session][worker]") {
    ::setenv("VESSELBENCH_WORKER", "1", 1);  // as in a worker
    CHECK_THROWS_AS(run("far-bump", sphere(), kTop), std::logic_error);
    ::unsetenv("VESSELBENCH_WORKER");
    CHECK_NOTHROW(run("far-bump", sphere(), kTop));
}

SCENARIO("Errors keep their class across the processes", "[session][worker]") {
    const auto refuse = [](const char* as) { return run("refuse", {}, {{"as", std::string(as)}}); };
    CHECK_THROWS_AS(refuse("usage"), UsageError);
    CHECK_THROWS_AS(refuse("input"), InvalidInput);
    CHECK_THROWS_AS(refuse("io"), IoError);
    CHECK_THROWS_AS(refuse("algorithm"), AlgorithmFailure);
    CHECK(text_of([&] { (void)refuse("io"); }) == "refused as io");
    CHECK_THROWS_AS(refuse("library"), AlgorithmFailure);
    CHECK(text_of([&] { (void)refuse("library"); }).starts_with("failed (vector"));
    CHECK_THROWS_AS(run("refuse", {}, {}), UsageError);
}

SCENARIO("The session survives whatever its workers do", "[session][worker]") {
    CHECK_THROWS_AS(run("crash", sphere(), {}), AlgorithmFailure);
    THEN("a crash while reading a file is the file's fault") {
        const Arguments given = {{"file", std::string("/somewhere/bad.stl")}};
        CHECK_THROWS_AS(run("crash-on-file", {}, given), InvalidInput);
        const std::string text = text_of([&] { (void)run("crash-on-file", {}, given); });
        CHECK(text.find("bad.stl") != std::string::npos);
        CHECK(text.find("somewhere") == std::string::npos);
    }
    THEN("a worker that somebody stops is nobody's fault") {
        CHECK_THROWS_AS(run("be-stopped", {}, {{"file", std::string("good.stl")}}), Cancelled);
    }
    THEN("one that takes too long is stopped") {
        WorkerOptions worker = test::test_worker();
        worker.time_limit = 1s;
        CHECK_THROWS_AS(run("hang", {}, {}, worker), AlgorithmFailure);
    }
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
    THEN("one that reads a file gets memory for its size") {
        const std::string file = test::temporary_folder() + "/a.stl";
        std::ofstream(file) << std::string(std::size_t{8} << 20, 'x');
        const auto read = [&](std::int64_t megabytes) {
            return run("read-much", {}, {{"file", file}, {"megabytes", megabytes}});
        };
        CHECK_NOTHROW(read(350));  // 16 x 8 MiB + 256 MiB is 384 MiB
        CHECK_THROWS_AS(read(600), InvalidInput);
        CHECK(text_of([&] { (void)read(600); }).find("384 MiB for a file") != std::string::npos);
    }
    THEN("one that wants too much memory is refused it") {  // sanitizers need all address space
        WorkerOptions worker = test::test_worker();
        worker.memory_limit = std::size_t{2} << 30;
        CHECK_THROWS_AS(run("greedy", {}, {}, worker), AlgorithmFailure);
        CHECK(text_of([&] { (void)run("greedy", {}, {}, worker); }).find("2 GiB") !=
              std::string::npos);
    }
#endif
    THEN("a worker that cannot be started is reported") {
        WorkerOptions worker;
        worker.command = {"/no/such/program"};
        CHECK_THROWS_AS(run("hang", {}, {}, worker), IoError);
        worker.command = {"/bin/false"};
        CHECK_THROWS_AS(run("hang", {}, {}, worker), AlgorithmFailure);
    }
}

SCENARIO("Cancelling kills the worker at once", "[session][worker]") {
    std::stop_source stop;
    double seen = -1.0;
    const Progress progress(
        [&](double fraction, std::string_view what) {
            seen = fraction;
            CHECK(what == "waiting");
            if (fraction > 0.0) stop.request_stop();
        },
        stop.get_token());
    const auto start = std::chrono::steady_clock::now();
    CHECK_THROWS_AS(run("hang", {}, {}, test::test_worker(), progress), Cancelled);
    CHECK(seen >= 0.0);
    CHECK(std::chrono::steady_clock::now() - start < 20s);
}
