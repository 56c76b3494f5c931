// Times the window without a display, and prints a row each: start-up, frames while a surface of
// 200,000 triangles with edges turns, the way from the cursor over an opening to its highlight,
// dabs of a brush until they are seen, models while the mouse drives their smoothing, surfaces
// while the iso-value of an image slides.
//   bench_window PROGRAM                        all of these
//   bench_window PROGRAM --driving              smoothing driven by the mouse only
//   bench_window PROGRAM --brushing             a brush on 480,000 triangles only
//   bench_window PROGRAM --clicks SECONDS [SEEDS [FIRST]]   longest frames under random input
//                                                           instead

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <epoxy/gl.h>

#include "geometry/formats/image_file.h"
#include "geometry/formats/surface_file.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/stopwatch.h"
#include "gpu/render/drawing_arrays.h"
#include "smoothing/filters/laplace_hc.h"
#include "tests/support/shapes.h"
#include "tests/window/random_user.h"
#include "workbench/operations/smooth/change_meter.h"
#include "workbench/operations/table.h"
#include "workbench/window/drawing/screen_places.h"
#include "workbench/window/keys/keys.h"
#include "workbench/window/shell/offscreen_shell.h"

namespace vesselbench::bench {

namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

constexpr int kAround = 252;        // vertices around the tube: about 200,000 triangles
constexpr double kLongest = 250.0;  // of a frame under random input [ms]
constexpr int kAroundDriven = 252;  // vertices around the driven tube: about 100,000 of them
constexpr double kDriveSeconds = 10.0;
constexpr int kAroundBrushed = 390;  // vertices around the brushed tube: about 480,000 triangles
constexpr int kDabs = 15;

/// A shell whose files are all in one temporary folder.
struct Bench {
    fs::path program;
    fs::path home = test::temporary_folder();

    [[nodiscard]] AppOptions options() const {
        AppOptions options{.settings = home, .documents = home};
        options.session.find = find_operation;
        options.session.worker.command = {program.string(), "--worker"};
        return options;
    }

    [[nodiscard]] fs::path tube(int around) const {
        const fs::path file = home / ("tube-" + std::to_string(around) + ".vtp");
        if (!fs::exists(file)) write_surface(test::fine_tube(4.0, 30.0, around), file.string());
        return file;
    }
};

void report_error(const std::string& text) {
    std::printf("  OpenGL reported: %s\n", text.c_str());
}

double median(std::vector<double> values) {
    std::ranges::sort(values);
    return values.at(values.size() / 2);
}

void print(const char* what, double milliseconds, const char* goal) {
    std::printf("  %-56s %8.1f ms   %s\n", what, milliseconds, goal);
    std::fflush(stdout);
}

void time_start(const Bench& bench) {
    const Stopwatch whole;
    OffscreenShell shell(bench.options(), 1280, 720, report_error);
    const double made = whole.seconds();
    shell.frame();
    const double drawn = whole.seconds();
    glFinish();
    print("context and window", 1e3 * made, "");
    print("first frame, its CPU work", 1e3 * (drawn - made), "");
    print("first frame seen", 1e3 * whole.seconds(), "goal < 500");
}

bool open(OffscreenShell& shell, const fs::path& file) {
    shell.app().open(file);
    const Document& document = shell.app().place().document;
    return shell.run_until([&] { return !document.activity(); }, 2min) && document.is_open() &&
           shell.settle(1min);
}

void time_turning(OffscreenShell& shell) {
    const ScreenRect view = shell.app().ui().items().at("view.area").rect;
    const float x = view.middle_x(), y = view.middle_y();
    shell.move_mouse(x, y);
    shell.press(MouseButton::Left);
    std::vector<double> times;
    for (int i = 1; i <= 20; ++i) {
        const Stopwatch watch;
        shell.move_mouse(x + 6.0F * static_cast<float>(i), y);
        glFinish();
        times.push_back(1e3 * watch.seconds());
    }
    shell.release(MouseButton::Left);
    print("a frame while it turns, 1280 x 720", median(times), "goal < 100");
    shell.move_mouse(0, 0);
    times.clear();
    for (int i = 0; i < 20; ++i) {
        const Stopwatch watch;
        shell.frame();
        glFinish();
        times.push_back(1e3 * watch.seconds());
    }
    print("a frame in which the model is still", median(times), "");
}

bool lights_opening(OffscreenShell& shell) {
    const auto& items = shell.app().ui().items();
    const auto found = items.lower_bound("view.opening.");
    return found != items.end() && found->first.starts_with("view.opening.");
}

void time_pick(OffscreenShell& shell) {
    const auto& openings = shell.app().place().surface_places().openings;
    const ScreenRect view = shell.app().ui().items().at("view.area").rect;
    for (const PatchMeasures& opening : openings) {
        const auto at = on_screen(shell.app().camera(), view).place(opening.centroid);
        if (!at) continue;
        shell.move_mouse(view.x + 1, view.y + 1);  // off every opening
        shell.frame();
        const Stopwatch watch;
        shell.move_mouse(static_cast<float>(at->x()), static_cast<float>(at->y()));
        int frames = 1;
        while (!lights_opening(shell) && ++frames < 60) shell.frame();
        if (frames == 60) continue;  // it faces away
        std::printf("  %-56s %8.1f ms   %d frames\n", "from the cursor's move to the lit opening",
                    1e3 * watch.seconds(), frames);
        return;
    }
    std::printf("  no opening faces the viewer\n");
}

void time_case(const Bench& bench) {
    OffscreenShell shell(bench.options(), 1280, 720, report_error);
    shell.frame();
    const Stopwatch watch;
    if (!open(shell, bench.tube(kAround))) return static_cast<void>(std::printf("  not opened\n"));
    const Surface& surface = *shell.app().place().document.shown()->surface;
    std::printf("%zu triangles, edges on\n", surface.triangle_count());
    print("from the file to the settled view", 1e3 * watch.seconds(), "");
    shell.click_item("view.edges");
    time_turning(shell);
    const ScreenRect view = shell.app().ui().items().at("view.area").rect;
    shell.move_mouse(view.middle_x(), view.middle_y());
    shell.press_key(keys::k0 + 7);  // from above, onto an opening
    time_pick(shell);
}

/// Frames, and time, until something is so.
struct Wait {
    int frames = 0;
    double milliseconds = 0.0;
};

Wait wait_until(OffscreenShell& shell, const std::function<bool()>& done) {
    const Stopwatch watch;
    int frames = 0;
    while (!done() && watch.seconds() < 10.0) {
        shell.frame();
        ++frames;
    }
    glFinish();
    return {frames, 1e3 * watch.seconds()};
}

/// From the mouse at a new place, the button held, to the picture with the dab there.
std::vector<Wait> time_dabs(OffscreenShell& shell) {
    const ScreenRect view = shell.app().ui().items().at("view.area").rect;
    const Document& document = shell.app().place().document;
    const float x = view.middle_x(), y = view.middle_y();
    shell.move_mouse(x - 30.0F, y);
    shell.settle(1min);
    shell.press(MouseButton::Left);
    const Wait begun = wait_until(shell, [&] { return document.is_painting(); });
    print("from the press to the stroke", begun.milliseconds, "");
    std::vector<Wait> waits;
    for (int i = 0; i < kDabs; ++i) {
        const auto before = document.shown()->surface->positions;
        const int drawn = shell.app().drawings();
        shell.move_mouse(x - 30.0F + 4.0F * static_cast<float>(i), y);
        waits.push_back(wait_until(shell, [&] {
            return document.shown()->surface->positions != before && shell.app().drawings() > drawn;
        }));
    }
    shell.release(MouseButton::Left);
    return waits;
}

void time_brushing(const Bench& bench) {
    OffscreenShell shell(bench.options(), 1280, 720, report_error);
    shell.frame();
    if (!open(shell, bench.tube(kAroundBrushed))) return;
    std::printf("brush-inflate on %zu triangles\n",
                shell.app().place().document.shown()->surface->triangle_count());
    time_turning(shell);
    shell.app().place().choose("brush-inflate");
    shell.settle(1min);
    std::vector<double> times, frames;
    for (const Wait& wait : time_dabs(shell)) {
        times.push_back(wait.milliseconds);
        frames.push_back(wait.frames);
    }
    print("from the mouse to the seen dab, the first", times.front(), "");
    print("the others", median({times.begin() + 1, times.end()}), "");
    std::printf("  %-56s %8.0f      goal <= 2\n", "frames of them",
                median({frames.begin() + 1, frames.end()}));
}

/// What a model costs besides its iterations, each part by the iterations alone.
void print_parts(const Surface& before) {
    const auto iterate = [&] {
        return laplace_hc(*before.topology, before.points(), {}, {.iterations = 20});
    };
    const Surface after = before.with_positions(iterate());
    const QuickChangeMeter meter(before);
    const auto layout = prepare_drawing(before).layout;
    const std::pair<const char*, std::function<void()>> parts[] = {
        {"  20 iterations", [&] { static_cast<void>(iterate()); }},
        {"  error, curvature and volume", [&] { static_cast<void>(meter.measure(after)); }},
        {"  arrays of the picture", [&] { static_cast<void>(prepare_drawing(after, layout)); }}};
    double reference = 0.0;
    for (const auto& [name, work] : parts) {
        std::vector<double> times;
        for (int i = 0; i < 9; ++i) {
            const Stopwatch watch;
            work();
            times.push_back(watch.seconds());
        }
        const double least = *std::ranges::min_element(times);
        if (reference == 0.0) reference = least;
        std::printf("  %-56s %8.2f      by 20 iterations, %.1f ms\n", name, least / reference,
                    1e3 * least);
    }
}

/// A press of the right button, and movements that drive lambda while 20 iterations are computed,
/// with error and curvature, and drawn.
void time_driving(const Bench& bench) {
    OffscreenShell shell(bench.options(), 1280, 720, report_error);
    shell.frame();
    if (!open(shell, bench.tube(kAroundDriven))) return;
    Workplace& place = shell.app().place();
    place.choose("smooth");
    place.set_field("filter", "laplace-hc");
    place.set_field("iterations", "20");
    place.set_field("lambda", "0.5");
    place.view.choose(ColouringKind::Deviation);
    const ScreenRect view = shell.app().ui().items().at("view.area").rect;
    const float x = view.middle_x(), y = view.middle_y();
    shell.move_mouse(x, y);
    shell.press(MouseButton::Right);
    shell.run_until([&] { return place.live().shown() != nullptr; }, 1min);
    std::vector<double> frames;
    shell.watch_frames([&](const FrameTime& time) { frames.push_back(1e3 * time.clock); });
    int models = 0;
    auto seen = place.live().shown();
    const int drawn = shell.app().drawings();
    const Stopwatch watch;
    for (int i = 0; watch.seconds() < kDriveSeconds; ++i) {
        shell.move_mouse(x, y + static_cast<float>(i % 160 - 80));
        if (place.live().shown() == seen) continue;
        seen = place.live().shown();
        if (seen->state.whole && seen->state.change && !place.live().problem().size()) ++models;
    }
    const double seconds = watch.seconds(), rate = models / seconds;
    const double pictures = (shell.app().drawings() - drawn) / seconds;
    shell.watch_frames({});
    shell.release(MouseButton::Right);
    const std::size_t vertices = place.document.current()->surface->vertex_count();
    const Surface& surface = *place.document.current()->surface;
    std::printf("lambda driven on %zu vertices, 20 iterations with error and curvature\n",
                vertices);
    std::printf("  %-56s %8.1f /s   goal > 10\n", "models shown", rate);
    std::printf("  %-56s %8.1f /s   goal > 10\n", "pictures of them", pictures);
    print("a frame meanwhile", median(frames), "");
    print("the longest of them", *std::ranges::max_element(frames), "goal < 100");
    print_parts(surface);
}

/// A branching vessel of wavy tubes with noise around it, 256 x 256 x 128 voxels.
Image vessel_image() {
    Image image{.size = {256, 256, 128}};
    image.index_to_patient = Eigen::Vector4d(0.4, 0.4, 0.4, 1.0).asDiagonal();
    std::vector<float> voxels(image.voxel_count());
    std::minstd_rand random(7);
    std::normal_distribution<float> noise(0.0F, 15.0F);
    for (int k = 0; k < image.size[2]; ++k)
        for (int j = 0; j < image.size[1]; ++j)
            for (int i = 0; i < image.size[0]; ++i) {
                const double wave = 20.0 * std::sin(0.05 * k);
                double inside = -1e3;
                for (const double lean : {-0.7, -0.2, 0.3, 0.8})
                    inside = std::max(inside, 12.0 - std::hypot(i - 128.0 - wave - lean * k,
                                                                j - 128.0 + lean * wave));
                const double share = std::clamp(0.5 + 0.25 * inside, 0.0, 1.0);
                voxels[image.offset(i, j, k)] = static_cast<float>(300.0 * share) + noise(random);
            }
    image.voxels = std::make_shared<const std::vector<float>>(std::move(voxels));
    return image;
}

/// A press in the histogram of the form of extract-surface, and movements that slide the iso-value
/// while the surface follows, is drawn, and outlined in three slices.
void time_sliding(const Bench& bench) {
    OffscreenShell shell(bench.options(), 1280, 720, report_error);
    shell.frame();
    const fs::path file = bench.home / "vessel.mha";
    write_image(file.string(), vessel_image());
    if (!open(shell, file)) return;
    Workplace& place = shell.app().place();
    place.choose("extract-surface");
    shell.frame();
    shell.click_item("form.live");
    const Stopwatch first;
    const auto is_whole = [&] {
        return place.extraction().shown() && !place.extraction().outdated();
    };
    shell.run_until(is_whole, 1min);
    std::printf("iso-value slid on 256 x 256 x 128 voxels\n");
    print("from the tab to the whole surface", 1e3 * first.seconds(), "");
    const ScreenRect rect = shell.app().ui().items().at("extraction.histogram").rect;
    std::vector<double> frames;
    shell.move_mouse(rect.middle_x(), rect.middle_y());
    shell.press(MouseButton::Left);
    shell.watch_frames([&](const FrameTime& time) { frames.push_back(1e3 * time.clock); });
    const int drawn = shell.app().drawings();
    int surfaces = 0;
    auto seen = place.extraction().shown();
    const Stopwatch watch;
    for (int i = 0; watch.seconds() < kDriveSeconds; ++i) {
        const float share = 0.55F + 0.25F * static_cast<float>(std::sin(0.05 * i));
        shell.move_mouse(rect.x + share * rect.width, rect.middle_y());
        surfaces += std::exchange(seen, place.extraction().shown()) != place.extraction().shown();
    }
    const double seconds = watch.seconds();
    shell.watch_frames({});
    std::printf("  %-56s %8.1f /s   goal > 10, %zu triangles\n", "surfaces found",
                surfaces / seconds, seen->state.surface.triangle_count());
    std::printf("  %-56s %8.1f /s\n", "pictures of them",
                (shell.app().drawings() - drawn) / seconds);
    print("a frame meanwhile", median(frames), "");
    print("the longest of them", *std::ranges::max_element(frames), "goal < 100");
    shell.release(MouseButton::Left);
    const Stopwatch rest;
    shell.run_until(is_whole, 1min);
    print("from the release to the whole surface", 1e3 * rest.seconds(), "");
}

/// The longest frames, with what had been done just before.
struct Longest {
    FrameTime frame;
    std::string after;
};

void click_around(const Bench& bench, unsigned seed, double seconds) {
    const fs::path tube = bench.tube(12), broken = bench.home / "broken.stl";
    OffscreenShell shell(bench.options(), 1280, 720, report_error);
    shell.frame();
    if (seed % 4 != 0) open(shell, tube);
    test::RandomUser user(shell, seed, {tube, broken});
    Longest longest;
    int frames = 0;
    shell.watch_frames([&](const FrameTime& time) {
        ++frames;
        if (time.clock <= longest.frame.clock) return;
        longest = {time, user.latest()};
    });
    const Stopwatch watch;
    while (watch.seconds() < seconds) user.act();
    std::printf("  seed %2u: %5d frames, longest %6.1f ms, its work %6.1f ms\n", seed, frames,
                1e3 * longest.frame.clock, 1e3 * longest.frame.work);
    if (1e3 * longest.frame.clock > kLongest) std::printf("%s", longest.after.c_str());
    std::fflush(stdout);
}

void run(int count, char** words) {
    const Bench bench{.program = words[1]};
    test::live_in(bench.home);
    if (count > 3 && std::string(words[2]) == "--clicks") {
        const unsigned seeds = count > 4 ? static_cast<unsigned>(std::atoi(words[4])) : 20;
        std::printf("random input for %s s each, goal: no frame over %.0f ms\n", words[3],
                    kLongest);
        const unsigned first = count > 5 ? static_cast<unsigned>(std::atoi(words[5])) : 1;
        for (unsigned seed = first; seed < first + seeds; ++seed)
            click_around(bench, seed, std::atof(words[3]));
        return;
    }
    if (count > 2 && std::string(words[2]) == "--driving") return time_driving(bench);
    if (count > 2 && std::string(words[2]) == "--brushing") return time_brushing(bench);
    std::printf("the window\n");
    time_start(bench);
    time_case(bench);
    time_brushing(bench);
    time_driving(bench);
    time_sliding(bench);
}

}  // namespace

}  // namespace vesselbench::bench

int main(int count, char** words) {
    if (count < 2) {
        std::fprintf(stderr,
                     "usage: bench_window PROGRAM [--driving | --brushing | --clicks SECONDS "
                     "[SEEDS [FIRST]]]\n");
        return 2;
    }
    try {
        vesselbench::bench::run(count, words);
    } catch (const vesselbench::GpuUnavailable& error) {
        std::printf("window rows skipped: %s\n", error.what());
    }
    return 0;
}
