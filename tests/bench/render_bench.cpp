// Times the renderer on the machine's OpenGL device, and prints a row each: frames with and without
// edges at 1280 x 720 and 4 samples, picks and dabs of a brush.
//   bench_render [TRIANGLES]...     200000 and 1000000 triangles when none are given

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <numbers>
#include <thread>
#include <vector>

#include <epoxy/gl.h>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/stopwatch.h"
#include "gpu/context.h"
#include "gpu/gpu_meter.h"
#include "gpu/render/drawn_device_surface.h"
#include "gpu/render/drawn_surface.h"
#include "gpu/render/pick.h"
#include "gpu/render/target.h"

namespace vesselbench::bench {

namespace {

constexpr int kWidth = 1280, kHeight = 720, kRepeats = 5;

/// A ring of radius 10 mm with ripples.
Surface torus(std::size_t triangles) {
    const auto around = static_cast<std::size_t>(std::sqrt(static_cast<double>(triangles) / 4.0));
    const std::size_t along = triangles / (2 * around);
    Positions points;
    for (std::size_t i = 0; i < along; ++i)
        for (std::size_t j = 0; j < around; ++j) {
            const double u =
                2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(along);
            const double v =
                2.0 * std::numbers::pi * static_cast<double>(j) / static_cast<double>(around);
            const double r = 3.0 + 0.08 * std::sin(40.0 * u) * std::sin(9.0 * v);
            points.emplace_back((10.0 + r * std::cos(v)) * std::cos(u),
                                (10.0 + r * std::cos(v)) * std::sin(u), r * std::sin(v));
        }
    std::vector<Triangle> list;
    const auto at = [&](std::size_t i, std::size_t j) {
        return static_cast<VertexId>(i % along * around + j % around);
    };
    for (std::size_t i = 0; i < along; ++i)
        for (std::size_t j = 0; j < around; ++j) {
            list.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
            list.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    return make_surface(std::move(points), std::move(list));
}

/// Milliseconds of the clock, and of all threads' work by the number of cores: what the clock would
/// show if llvmpipe had the machine to itself and shared its work perfectly.
struct Times {
    double clock = 0.0, work = 0.0;
};

/// Medians of some work with the device, after two runs to warm up.
Times times_of(const std::function<void()>& work) {
    std::vector<double> clock, busy;
    for (int repeat = -2; repeat < kRepeats; ++repeat) {
        glFinish();
        const Stopwatch watch;
        const std::clock_t start = std::clock();
        work();
        glFinish();
        if (repeat < 0) continue;
        clock.push_back(1e3 * watch.seconds());
        busy.push_back(1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC /
                       std::max(std::thread::hardware_concurrency(), 1U));
    }
    const auto median = [](std::vector<double>& values) {
        std::ranges::sort(values);
        return values[values.size() / 2];
    };
    return {median(clock), median(busy)};
}

double milliseconds(const std::function<void()>& work) {
    return times_of(work).clock;
}

/// All that a row needs.
struct Stage {
    Renderer renderer;
    RenderTarget target{kWidth, kHeight};
    SceneView view;
    Layers layers;

    Times frame() {
        return times_of([&] {
            target.bind();
            renderer.draw(view, layers);
            static_cast<void>(target.resolve());
        });
    }
};

void print_times(const char* what, const Times& times, const Times& plain) {
    std::printf("    %-28s %8.1f ms, work %7.1f ms (%.2f times plain)\n", what, times.clock,
                times.work, times.work / plain.work);
    std::fflush(stdout);
}

void time_frames(Stage& stage, const char* what) {
    std::printf("  %s\n", what);
    SurfaceLayer& layer = stage.layers.surfaces.front();
    const Times plain = stage.frame();
    print_times("plain", plain, plain);
    layer.edges = Edges::Over;
    const Times edges = stage.frame();
    print_times("edges over it", edges, plain);
    if (layer.source->triangle_count() <= 200000 && layer.source->has_corners())
        std::printf("      target < 100 ms: %s\n", edges.clock < 100.0 ? "met" : "not met");
    layer.edges = Edges::Only;
    print_times("edges only", stage.frame(), plain);
    layer.edges = Edges::Off;
}

void time_variants(Stage& stage) {
    SurfaceLayer& layer = stage.layers.surfaces.front();
    const Times plain = stage.frame();
    layer.flat = true;
    print_times("flat", stage.frame(), plain);
    layer.flat = false;
    layer.opacity = 0.4;
    print_times("transparent", stage.frame(), plain);
    layer.opacity = 1.0;
    stage.view.clip = ClipPlane{Vec3::Zero(), Vec3(1, 0, 0)};
    layer.section = Colour(0.8F, 0.7F, 0.3F);
    print_times("clipped, with its section", stage.frame(), plain);
    stage.view.clip.reset();
    layer.section.reset();
}

void time_device_source(Stage& stage, const Surface& surface) {
    const auto uploaded = std::make_shared<const DeviceSurface>(current_device(), surface);
    GpuMeter meter(uploaded);
    meter.measure_shape(uploaded->shifts());
    const auto source = std::make_shared<DrawnDeviceSurface>(uploaded);
    source->show({&uploaded->shifts(), &meter.normals(), nullptr});
    const auto before = stage.layers.surfaces.front().source;
    stage.layers.surfaces.front().source = source;
    time_frames(stage, "from device buffers, edges as lines");
    stage.layers.surfaces.front().source = before;
}

void time_picks(Stage& stage) {
    stage.layers.surfaces.front().id = 1;
    Picker picker(stage.renderer);
    const double whole = milliseconds([&] {
        static_cast<void>(picker.pick(stage.view, stage.layers, kWidth / 2 + 200, kHeight / 2));
    });
    std::printf("  pick, to its result: %.1f ms\n", whole);
}

/// The vertices within a distance of a place.
std::vector<VertexId> near(const Surface& surface, const Vec3& place, std::size_t most) {
    std::vector<VertexId> all(surface.vertex_count());
    for (VertexId v = 0; v < all.size(); ++v) all[v] = v;
    const auto distance = [&](VertexId v) { return (surface.points()[v] - place).squaredNorm(); };
    const auto end = all.begin() + static_cast<std::ptrdiff_t>(std::min(most, all.size()));
    std::ranges::nth_element(all, end, {}, distance);
    all.erase(end, all.end());
    return all;
}

void time_dabs(DrawnSurface& drawn) {
    const Surface& surface = drawn.surface();
    const std::vector<VertexId> moved = near(surface, Vec3(13, 0, 0), 5000);
    Positions points = surface.points();
    const double dab = milliseconds([&] {
        for (const VertexId v : moved) points[v].z() += 1e-4;
        drawn.move(points, moved);
    });
    std::printf("  dab of %zu vertices, normals and upload: %.2f ms, target < 10: %s\n",
                moved.size(), dab, dab < 10.0 ? "met" : "not met");
}

void time_surface(std::size_t triangles) {
    const Surface surface = torus(triangles);
    static_cast<void>(surface.topology->triangles_at());
    static_cast<void>(surface.topology->rings());
    Stopwatch watch;
    DrawingArrays arrays = prepare_drawing(surface);
    const double prepared = 1e3 * watch.seconds();
    watch = {};
    const DrawingArrays again = prepare_drawing(surface, arrays.layout);
    const double reshaped = 1e3 * watch.seconds();
    const std::size_t extras = arrays.layout->extras.size();
    watch = {};
    const auto drawn = std::make_shared<DrawnSurface>(std::move(arrays));
    glFinish();
    std::printf(
        "%zu triangles: prepared in %.0f ms (of the same layout %.0f ms), %.1f %% of vertices "
        "split, uploaded in %.0f ms\n",
        surface.triangle_count(), prepared, reshaped,
        100.0 * static_cast<double>(extras) / static_cast<double>(surface.vertex_count()),
        1e3 * watch.seconds());
    Stage stage;
    stage.view.camera = {.view = Vec3(0.3, 0.7, -0.8), .half_height = 11.0, .perspective = true};
    stage.view.rectangle = stage.target.rectangle();
    SurfaceLayer layer;
    layer.source = drawn;
    stage.layers.surfaces = {layer};
    time_frames(stage, "1280 x 720, 4 samples");
    time_variants(stage);
    time_device_source(stage, surface);
    time_picks(stage);
    time_dabs(*drawn);
}

}  // namespace

}  // namespace vesselbench::bench

int main(int count, char** words) {
    std::vector<std::size_t> sizes;
    for (int i = 1; i < count; ++i)
        if (const long size = std::atol(words[i]); size >= 1000) {
            sizes.push_back(static_cast<std::size_t>(size));
        } else {
            std::fprintf(stderr, "usage: bench_render [TRIANGLES]...\n");
            return 2;
        }
    if (sizes.empty()) sizes = {200'000, 1'000'000};
    try {
        const vesselbench::OffscreenContext context;
        std::printf("%s\n", context.renderer().c_str());
        for (const std::size_t size : sizes) vesselbench::bench::time_surface(size);
    } catch (const vesselbench::GpuUnavailable& error) {
        std::printf("renderer rows end here: %s\n", error.what());
    }
    return 0;
}
