// Cancels long requests of a background session at several points of their run and prints how long
// each takes to end, beside the 0.3 s that DESIGN allows: operations (as previews, which run like
// edits but are not entered), live edits, and what else a session does on large data. An edit that
// is just being entered into the project completes: `entering` is the time of that. Other programs
// delay the end; the processor time of the session's thread until then does not count them.
//   bench_cancel FOLDER [NAME]...    its files are made or used again; only rows whose names
//   contain a NAME

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <pthread.h>
#include <time.h>

#include "geometry/formats/image_file.h"
#include "geometry/formats/surface_file.h"
#include "geometry/kernel/stopwatch.h"
#include "geometry/phantoms/phantom.h"
#include "tests/bench/organ.h"
#include "tests/support/operation_examples.h"
#include "workbench/operations/table.h"
#include "workbench/phantoms/phantom_json.h"
#include "workbench/session/session_runner.h"
#include "workbench/worker/worker.h"

namespace vesselbench::bench {

namespace {

using Text = std::string;
using Count = std::int64_t;

constexpr double kBar = 0.3;       // [s] from a cancel to the end
constexpr double kShortest = 0.5;  // [s] what ends sooner by itself is not cancelled
const Vec3 kDome(-6.0, -3.2, 17.8), kStub(0.0, 5.6, 8.2);   // [mm] of the bundled case
constexpr double kPoints[] = {0.02, 0.1, 0.35, 0.6, 0.95};  // of the uncancelled time

/// Files that the operations read.
struct Files {
    Text image, mask, organ, open_organ;
};

/// An operation on the scene that the kept ones before it have made.
struct Trial {
    Text name;
    Arguments arguments;
    bool kept = false;
    EditOptions options = {};
    bool live = false;  ///< also driven live
};

/// From a cancel to the end of the job.
struct End {
    double seconds = 0.0;
    double processor = 0.0;  ///< [s] of the session's thread
};

class Bench {
public:
    explicit Bench(std::vector<Text> only) : only_(std::move(only)) {}

    /// \param start () -> Job; it must not change the session if it completes
    template <class Start>
    void row(const Text& name, const Start& start, std::optional<double> entering = {}) {
        if (!wanted(name)) return;
        const Stopwatch watch;
        const auto whole = start();
        whole.wait();
        cancel_row(name, start, watch.seconds(), whole.error(), entering);
    }

    /// The same for what has been timed.
    template <class Start>
    void cancel_row(const Text& name, const Start& start, double whole, const Text& error,
                    std::optional<double> entering) {
        std::printf("%-42s %7.2f s", name.c_str(), whole);
        std::vector<End> ends;
        if (whole >= kShortest && error.empty())
            for (const double point : kPoints)
                if (const auto end = cancelled(start(), point * whole)) ends.push_back(*end);
        if (ends.empty()) {
            std::printf("  %-45s", error.empty() ? "not cancelled" : error.c_str());
        } else {
            std::ranges::sort(ends, {}, &End::seconds);
            const double processor = std::ranges::max(ends, {}, &End::processor).processor;
            const double last = ends.back().seconds;
            std::printf("  %.3f  %.3f s  %5.2f of the bar%s  %.3f s", ends[ends.size() / 2].seconds,
                        last, last / kBar, last > kBar ? "  OVER" : "      ", processor);
            worst_ = {std::max(worst_.seconds, last), std::max(worst_.processor, processor)};
        }
        if (entering) std::printf("  entering %.3f s", *entering);
        std::printf("\n");
        std::fflush(stdout);
    }

    /// The runner of the rows that follow.
    void follow(SessionRunner& runner) {
        clock_ = runner
                     .submit([](Session&, const Progress&) {
                         clockid_t clock{};
                         pthread_getcpuclockid(pthread_self(), &clock);
                         return clock;
                     })
                     .result();
    }

    [[nodiscard]] bool wanted(const Text& name) const {
        return only_.empty() || std::ranges::any_of(only_, [&](const Text& word) {
                   return name.find(word) != Text::npos;
               });
    }

    [[nodiscard]] End worst() const { return worst_; }

private:
    /// None if the job ended before the cancel.
    template <class Job>
    [[nodiscard]] std::optional<End> cancelled(const Job& job, double after) const {
        if (job.wait_for(std::chrono::milliseconds(static_cast<int>(1000.0 * after)))) return {};
        const double before = processor_seconds();
        const Stopwatch watch;
        job.cancel();
        job.wait();
        if (job.state() != TaskState::Cancelled) return {};
        const double seconds = watch.seconds();
        return End{seconds, processor_seconds() - before};
    }

    /// Of the followed runner's thread.
    [[nodiscard]] double processor_seconds() const {
        timespec time{};
        clock_gettime(clock_, &time);
        return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
    }

    std::vector<Text> only_;
    End worst_;
    clockid_t clock_{};
};

Text row_name(const Trial& trial) {
    Text name = trial.name;
    for (const auto& [key, value] : trial.arguments.values())
        if (key != "file" && key != "mask" && key != "tip" && key != "name")
            name += " " + key + "=" + to_text(value);
    return name;
}

void run_live(Bench& bench, SessionRunner& runner, const Trial& trial) {
    const auto start = [&] {
        return runner.start_live(trial.name, trial.arguments, trial.options);
    };
    const Text name = "live " + row_name(trial);
    bench.row(name + ": start", start);
    if (!bench.wanted(name)) return;
    const SessionRunner::Live live = start().result();
    // What commit(live) does before it enters the edit.
    bench.row(name + ": figures", [&] {
        return runner.submit([live](Session& session, const Progress& progress) {
            return session.preview(*live, progress);
        });
    });
}

void run(Bench& bench, SessionRunner& runner, const Trial& trial) {
    const Text name = row_name(trial);
    if (!trial.kept && !bench.wanted(name)) return;
    const auto start = [&] {
        return runner.preview(trial.name, trial.arguments, trial.options, "");
    };
    const Stopwatch watch;
    const auto whole = start();
    whole.wait();
    const double seconds = watch.seconds();
    std::optional<double> entering;
    if (whole.state() == TaskState::Done) {
        const Stopwatch commit;
        runner.commit(whole.result()).wait();
        entering = commit.seconds();
        runner.undo().wait();
    }
    if (bench.wanted(name)) bench.cancel_row(name, start, seconds, whole.error(), entering);
    if (trial.live && bench.wanted(name)) run_live(bench, runner, trial);
    if (trial.kept) runner.redo().wait();
}

Arguments staircases() {
    return {{"preset", Text("cfd")}, {"staircase", true}, {"tau_theta", 0.5}, {"find_caps", false}};
}

Arguments filter(const char* name, Count iterations) {
    return {{"filter", Text(name)}, {"iterations", iterations}};
}

/// The bundled case's recipe with arguments that take long, and others on its way.
std::vector<Trial> vessel_trials(const Files& files) {
    const EditOptions source{.step = Step::Source};
    return {
        {"load-image", {{"file", files.image}, {"mask", files.mask}}, true},
        {"extract-surface", {{"diffusion", Count{1}}, {"gaussian", 0.1}, {"closing", Count{1}}}},
        {"extract-surface", {{"resample", 0.1}}},
        {"extract-surface", {{"method", Text("masked")}, {"dilation", Count{0}}}, true, {}, true},
        {"repair", {}, true},
        {"smooth", staircases(), true, source, true},
        {"smooth", filter("laplace-hc", 100)},
        {"smooth", filter("mean-curvature-flow", 30)},
        {"smooth", filter("anisotropic", 30)},
        {"smooth", filter("curvature-triggered", 30)},
        {"brush-smooth", {{"at", kDome}, {"radius", 3.0}}, false, {}, true},
        {"remove-branch", {{"tip", kStub}}, true},
        {"clip-opening", {}, true, {}, true},
        {"extrude-opening", {{"diameters", 1.0}}, true},
        {"decimate", {{"share", 0.1}}, false, {}, true},
        {"remesh", {{"mode", Text("uniform")}, {"edge", 0.15}}},
        {"remesh", {{"mode", Text("graded")}, {"edge", 0.15}}, true},
        {"tetrahedralize", {}, true},
    };
}

/// A surface with a hole.
std::vector<Trial> organ_trials(const Files& files) {
    return {{"load-surface", {{"file", files.open_organ}}, true}, {"repair", {}}};
}

/// The examples of operations that work on such scenes and have no row yet; adds theirs to `tried`.
std::vector<Trial> other_trials(const Files& files, const std::set<ExampleScene>& scenes,
                                std::set<Text>& tried) {
    const test::ExampleGround ground{.radius = 3.0,
                                     .wall = kDome,
                                     .end = kStub,
                                     .branch = kStub,
                                     .files = {{InputKind::Surface, files.organ},
                                               {InputKind::Image, files.image},
                                               {InputKind::Neighbour, files.organ}},
                                     .mask = files.mask};
    std::vector<Trial> trials;
    for (const Operation& operation : operation_table())
        if (scenes.contains(operation.example.scene) && tried.insert(operation.name).second)
            trials.push_back({operation.name, test::example_arguments(operation, ground)});
    return trials;
}

/// The bundled phantom, finer in each direction.
PhantomDescription fine_phantom() {
    constexpr int kFiner = 4;
    PhantomDescription phantom = builtin_phantom("aneurysm");
    PhantomImaging& imaging = phantom.imaging;
    imaging.spacing /= kFiner;
    for (int& size : imaging.size.value()) size *= kFiner;
    imaging.mask_slice_step *= kFiner;
    phantom.surface_edge = 1.0;  // the exact surface is not used
    return phantom;
}

/// Without its lower end.
Surface opened(const Surface& surface) {
    constexpr double kCut = -36.0;  // [mm]: the hole's border has a few hundred edges
    std::vector<Triangle> kept;
    for (const Triangle& t : surface.triangles())
        if (surface.points()[t[0]].z() > kCut) kept.push_back(t);
    return make_surface(surface.points(), std::move(kept));
}

Files write_files(const Text& folder) {
    Files files{folder + "/image.nii", folder + "/mask.nii", folder + "/organ.stl",
                folder + "/open.stl"};
    if (std::filesystem::exists(files.open_organ)) return files;
    const Stopwatch watch;
    const Phantom phantom = make_phantom(fine_phantom());
    write_image(files.image, phantom.image);
    write_image(files.mask, phantom.mask);
    const Surface surface = organ(100'000);
    write_surface(surface, files.organ);
    write_surface(opened(surface), files.open_organ);
    std::printf("image of %zu voxels, organ of %zu triangles, made in %.0f s\n",
                phantom.image.voxel_count(), surface.triangle_count(), watch.seconds());
    return files;
}

SessionOptions options() {
    SessionOptions made;
    made.find = find_operation;
    return made;
}

void say_size(SessionRunner& runner, const char* what) {
    const Scene scene = runner.scene().result();
    if (scene.surface) std::printf("  %s: %zu triangles\n", what, scene.surface->triangle_count());
}

/// What else a session does for seconds.
void run_requests(Bench& bench, const Text& project) {
    const Text copy = project + ".copy";
    {
        SessionRunner runner(Session::open(project, options()));
        bench.follow(runner);
        bench.row("replay of all edits", [&] { return runner.replay(); });
        bench.row("save as", [&] {
            std::filesystem::remove(copy);
            return runner.save_as(copy);
        });
    }
    if (!bench.wanted("open")) return;
    // A session reads a scene once: each start needs a fresh one.
    std::vector<std::unique_ptr<SessionRunner>> runners;
    bench.row("open: the last scene", [&] {
        runners.push_back(std::make_unique<SessionRunner>(Session::open(project, options())));
        bench.follow(*runners.back());
        return runners.back()->scene();
    });
}

void print_load(const char* when) {
    double load = 0.0;
    getloadavg(&load, 1);
    std::printf("load average %s: %.1f\n", when, load);
}

void run_trials(Bench& bench, SessionRunner& runner, const std::vector<Trial>& trials,
                std::set<Text>& tried) {
    for (const Trial& trial : trials) {
        run(bench, runner, trial);
        tried.insert(trial.name);
        if (trial.kept) say_size(runner, trial.name.c_str());
    }
}

void run_all(Bench& bench, const Text& folder) {
    print_load("before");
    std::filesystem::create_directories(folder);
    const Files files = write_files(folder);
    std::printf("%-42s %9s  %s  %s\n", "", "whole", "median",
                "worst, from cancel to end; processor");
    const Text project = folder + "/vessel.vbench";
    std::filesystem::remove(project);
    std::set<Text> tried;
    {
        SessionRunner runner(Session::create(project, options()));
        bench.follow(runner);
        run_trials(bench, runner, vessel_trials(files), tried);
        using enum ExampleScene;
        run_trials(bench, runner, other_trials(files, {Tube, Branches, Openings, Image}, tried),
                   tried);
    }
    run_requests(bench, project);
    SessionRunner runner(Session::unsaved(options()));
    bench.follow(runner);
    run_trials(bench, runner, organ_trials(files), tried);
    run_trials(bench, runner, other_trials(files, {ExampleScene::Holes}, tried), tried);
    std::printf("worst of all: %.3f s, %.2f of the bar; processor time %.3f s\n",
                bench.worst().seconds, bench.worst().seconds / kBar, bench.worst().processor);
    print_load("after");
}

}  // namespace

}  // namespace vesselbench::bench

int main(int argc, char** argv) {
    using namespace vesselbench;
    if (argc == 2 && std::string_view(argv[1]) == "--worker") return worker_main(find_operation);
    if (argc < 2) {
        std::fputs("bench_cancel FOLDER [NAME]...\n", stderr);
        return 2;
    }
    bench::Bench bench({argv + 2, argv + argc});
    bench::run_all(bench, argv[1]);
    return 0;
}
