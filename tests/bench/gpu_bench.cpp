// Times smoothing, measures, the exhaustive search and detections on the GPU, and prints a row
// each. Renderers that compute on the CPU are named and skipped.
//   bench_gpu [--any-device] [VERTICES]...     default: 250000 and 7000000 vertices

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/stopwatch.h"
#include "gpu/device_caps.h"
#include "gpu/device_choice.h"
#include "gpu/device_neighbours.h"
#include "gpu/device_order.h"
#include "gpu/filter_on_device.h"
#include "gpu/gpu_engine.h"
#include "gpu/gpu_meter.h"
#include "gpu/gpu_smoother.h"
#include "gpu/gpu_weights.h"
#include "smoothing/context/caps.h"
#include "smoothing/context/staircase_weights.h"
#include "smoothing/context/staircases.h"
#include "smoothing/quality/quality_table.h"
#include "tests/bench/organ.h"
#include "tests/support/shuffled.h"

namespace vesselbench::bench {

namespace {

constexpr int kIterations = 20;
constexpr int kRepeats = 11;
constexpr int kVoxelsOfASlice = 4;

double median(std::vector<double> values) {
    std::ranges::sort(values);
    return values[values.size() / 2];
}

/// Times of some work [ms].
struct Times {
    double device = 0.0;  ///< by the driver's timer; wall-clock time if it has none, like llvmpipe
    double clock = 0.0;   ///< from the first call until the device has finished
};

/// Medians of several runs, after two to warm up.
Times times_of(const std::function<void()>& work) {
    const DeviceTimer timer;
    std::vector<double> times, clocks;
    for (int repeat = -2; repeat < kRepeats; ++repeat) {
        finish_device();
        const Stopwatch watch;
        timer.start();
        work();
        timer.stop();
        finish_device();
        const double by_clock = 1e3 * watch.seconds(), time = timer.milliseconds();
        if (repeat < 0) continue;
        times.push_back(time > 0.01 * by_clock ? time : by_clock);
        clocks.push_back(by_clock);
    }
    return {median(times), median(clocks)};
}

/// Wall-clock time [ms], the best of three: for work that reads numbers back on the way.
double clock_milliseconds(const std::function<void()>& work) {
    std::vector<double> times;
    for (int repeat = 0; repeat < 3; ++repeat) {
        const Stopwatch watch;
        work();
        times.push_back(1e3 * watch.seconds());
    }
    return std::ranges::min(times);
}

/// What some work asks of the device, which no machine changes.
void print_counts(const Device& device, const char* what, const std::function<void()>& work) {
    const DeviceCounts before = *device.counts;
    work();
    std::printf("          %s: %s\n", what, text_of(since(before, *device.counts)).c_str());
    std::fflush(stdout);
}

/// Bytes per second that a copy from buffer to buffer reads and writes in total.
double copy_bandwidth(const Device& device) {
    const std::size_t bytes =
        std::min(device.limits.largest_storage_block, std::size_t{1} << 30) & ~std::size_t{4095};
    const Buffer from = make_storage(device, bytes, "copied from");
    const Buffer to = make_storage(device, bytes, "copied to");
    const double time = times_of([&] { copy_storage(device, from, to, bytes); }).device;
    return 2.0 * static_cast<double>(bytes) / (1e-3 * time);
}

/// Least memory traffic of 20 iterations of Laplace+HC and the measures [bytes]: every array that a
/// pass needs is read once and written once.
double least_bytes(const Topology& topology) {
    const auto vertices = static_cast<double>(topology.vertex_count());
    const double neighbours = 4.0 * static_cast<double>(topology.rings().values.size());
    const double corners = 8.0 * static_cast<double>(topology.triangles_at().values.size());
    const double shifts = 16.0 * vertices, offsets = 4.0 * vertices;
    // in: own shifts and the anchors' umbrella or the last pass's result; out: moved shifts
    const double pass = 3.0 * shifts + offsets + neighbours;
    // in: shifts and anchors; out: normals
    const double shape = 3.0 * shifts + offsets + corners;
    // in: both shifts, anchors and references; out: references and errors
    const double error = 3.0 * shifts + offsets + corners + 12.0 * vertices;
    return 2.0 * kIterations * pass + shape + error;
}

void time_smoothing(const HeldDevice& held, const Surface& surface, double bandwidth) {
    const auto on_device = std::make_shared<const DeviceSurface>(held.device, surface);
    GpuSmoother smoother(on_device, {});
    GpuMeter meter(on_device);
    const auto vertices = static_cast<double>(surface.vertex_count());
    const double target = vertices < 1e6 ? 1.0 : 13.0;
    const auto smooth_and_measure = [&] {
        smoother.start(LaplaceHcParameters{});
        meter.restart();
        smoother.run(kIterations);
        meter.measure(smoother.shifts());
    };
    const Times whole = times_of(smooth_and_measure);
    const Times filter = times_of([&] {
        smoother.start(LaplaceHcParameters{});
        smoother.run(kIterations);
    });
    const double share = least_bytes(*surface.topology) / (1e-3 * whole.device) / bandwidth;
    std::printf(
        "%9.0f vertices, 20 iterations of Laplace+HC, normals, error, curvature, volume: "
        "%.3f ms, by the clock %.3f (filter alone %.3f and %.3f), target < %.0f: %s\n",
        vertices, whole.device, whole.clock, filter.device, filter.clock, target,
        whole.device < target ? "met" : "not met");
    print_counts(held.device, "of it", smooth_and_measure);
    const Times anisotropic = times_of([&] {
        smoother.start(AnisotropicParameters{});
        smoother.run(kIterations);
    });
    std::printf("          anisotropic instead: %.3f ms, by the clock %.3f\n", anisotropic.device,
                anisotropic.clock);
    std::printf("          %.0f %% of the copy bandwidth%s\n", 100.0 * share,
                vertices < 1e6 ? ""
                : share >= 0.4 ? ", target >= 40: met"
                               : ", target >= 40: not met");
    std::fflush(stdout);
}

/// The same surface with its vertices numbered at random.
Surface numbered_at_random(const Surface& surface) {
    std::vector<VertexId> numbers;
    return test::shuffled(surface, numbers);
}

/// What an order along the mesh brings on a surface whose numbering does not follow it.
void time_order(const HeldDevice& held, const Surface& surface) {
    const Surface mixed = numbered_at_random(surface);
    const auto time = [&](const Surface& shape, bool reorders) {
        Device device = held.device;
        device.reorders = reorders;
        const auto there = std::make_shared<const DeviceSurface>(device, shape);
        GpuSmoother smoother(there, {});
        GpuMeter meter(there);
        return times_of([&] {
            smoother.start(LaplaceHcParameters{});
            meter.restart();
            smoother.run(kIterations);
            meter.measure(smoother.shifts());
        });
    };
    const double usual = time(surface, true).clock, as_given = time(mixed, false).clock,
                 reordered = time(mixed, true).clock;
    const double ordering =
        clock_milliseconds([&] { static_cast<void>(DeviceOrder(*mixed.topology)); });
    std::printf(
        "          numbered at random: %.3f ms by the clock, in an order along the mesh %.3f "
        "(%.2f times), in the surface's usual one %.3f; the CPU finds the order in %.1f ms\n",
        as_given, reordered, as_given / reordered, usual, ordering);
    std::fflush(stdout);
}

std::vector<ParameterSet> all_sets() {
    std::vector<ParameterSet> sets;
    for (int lambda = 0; lambda <= 10; ++lambda)
        for (int iterations = 0; iterations <= 50; iterations += 5)
            sets.push_back({0.1 * lambda, static_cast<double>(iterations)});
    return sets;
}

void time_search(const HeldDevice& held, const Surface& surface) {
    const auto engine =
        make_gpu_engine(held, {.topology = surface.topology, .start = surface.positions});
    const Chooser laplace = [](std::span<const double> values) {
        return SmoothingChoice{LaplaceParameters{values[0]}, nullptr};
    };
    std::vector<double> times;
    for (int repeat = -1; repeat < kRepeats; ++repeat) {
        QualityTable table(engine, laplace, 0);
        const Stopwatch watch;
        table.find(all_sets());
        if (repeat >= 0) times.push_back(1e3 * watch.seconds());
    }
    std::printf("%9zu vertices, exhaustive suggestion of 11 x 11 sets: %.1f ms%s\n",
                surface.vertex_count(), median(times),
                surface.vertex_count() > 300'000 ? ""
                : median(times) < 30.0           ? ", target < 30: met"
                                                 : ", target < 30: not met");
    auto weights = std::make_shared<const std::vector<double>>(surface.vertex_count(), 0.5);
    const Chooser weighted = [&](std::span<const double> values) {
        return SmoothingChoice{LaplaceParameters{values[0]}, weights};
    };
    print_counts(held.device, "of it", [&] { QualityTable(engine, laplace, 0).find(all_sets()); });
    print_counts(held.device, "weighted",
                 [&] { QualityTable(engine, weighted, 0).find(all_sets()); });
}

/// Filtering again from another start, as rounded caps do.
void count_filtering(const HeldDevice& held, const Surface& surface) {
    const auto there = std::make_shared<const DeviceSurface>(held.device, surface);
    const auto start = std::make_shared<const Positions>(surface.points());
    const auto filter = [&] {
        static_cast<void>(filter_on_device(there, surface.positions, LaplaceHcParameters{}));
    };
    std::printf("%9zu vertices, 20 iterations of Laplace+HC, read back\n", surface.vertex_count());
    print_counts(held.device, "first", filter);
    print_counts(held.device, "again", filter);
    print_counts(held.device, "from another start",
                 [&] { static_cast<void>(filter_on_device(there, start, LaplaceHcParameters{})); });
}

void print_beside(const Surface& surface, const char* what, double on_device, double on_cpu) {
    std::printf("%9zu vertices, %s: %.1f ms, the CPU %.1f ms (%.1f times)\n",
                surface.vertex_count(), what, on_device, on_cpu, on_cpu / on_device);
    std::fflush(stdout);
}

/// The same surface, shifted until the two touch.
Surface beside(const Surface& surface) {
    Positions points = surface.points();
    const Bounds box = bounds(points);
    for (Vec3& p : points) p.x() += 0.98 * (box.max - box.min).x();
    return surface.with_positions(std::move(points));
}

/// Times staircases, their weights, caps and distances to a neighbour on a stack of slices, on the
/// device and the CPU.
void time_detections(const HeldDevice& held, const Surface& surface) {
    const auto on_device = std::make_shared<const DeviceSurface>(held.device, surface);
    const Topology& topology = *surface.topology;
    const Vec3 axis(0.0, 0.0, 1.0);
    GpuWeights weights(on_device);
    std::vector<double> change;
    const double change_time = clock_milliseconds([&] {
        weights.find_orientation_change(axis);
        finish_device();
    });
    const double cpu_change_time =
        clock_milliseconds([&] { change = orientation_change(topology, surface.points(), axis); });
    print_beside(surface, "staircases", change_time, cpu_change_time);
    double tau_max = 3.0;
    const double weight_time = clock_milliseconds([&] {
        tau_max += 1e-9;  // else the last search is reused
        weights.restart();
        weights.multiply_staircases({.tau_max = tau_max});
        finish_device();
    });
    const double cpu_weight_time = clock_milliseconds([&] {
        static_cast<void>(
            staircase_weights(topology, surface.points(), change, {.tau_max = tau_max}));
    });
    print_beside(surface, "staircase weights", weight_time, cpu_weight_time);
    const double cap_time = clock_milliseconds([&] { static_cast<void>(find_caps(*on_device)); });
    const double cpu_cap_time = clock_milliseconds([&] { static_cast<void>(find_caps(surface)); });
    print_beside(surface, "caps", cap_time, cpu_cap_time);
    const std::vector<Surface> neighbours{beside(surface)};
    const double distance_time = clock_milliseconds(
        [&] { static_cast<void>(find_neighbour_distances(*on_device, neighbours)); });
    const double cpu_distance_time = clock_milliseconds(
        [&] { static_cast<void>(neighbour_distances(surface.points(), neighbours)); });
    print_beside(surface, "distances to a neighbour as large", distance_time, cpu_distance_time);
}

void time_all(bool any_device, const std::vector<double>& sizes) {
    const ChosenDevice chosen = choose_device(any_device ? DeviceChoice::Gpu : DeviceChoice::Auto);
    if (!chosen.device) {
        std::printf("GPU rows skipped: %s\n", chosen.reason.c_str());
        return;
    }
    const HeldDevice& held = *chosen.device;
    const double bandwidth = copy_bandwidth(held.device);
    std::printf("%s, OpenGL %d.%d, copies %.0f GB/s (read and written), medians of %d\n",
                held.device.limits.renderer.c_str(), held.device.limits.major,
                held.device.limits.minor, 1e-9 * bandwidth, kRepeats);
    for (const double size : sizes) {
        const Surface surface = organ(size);
        time_smoothing(held, surface, bandwidth);
        time_order(held, surface);
        time_search(held, surface);
        count_filtering(held, surface);
        time_detections(held, organ(size, kVoxelsOfASlice));
    }
}

}  // namespace

}  // namespace vesselbench::bench

int main(int count, char** words) {
    bool any_device = false;
    std::vector<double> sizes;
    for (int i = 1; i < count; ++i) {
        if (std::strcmp(words[i], "--any-device") == 0) {
            any_device = true;
        } else if (const double size = std::atof(words[i]); size >= 1000.0) {
            sizes.push_back(size);
        } else {
            std::fprintf(stderr, "usage: bench_gpu [--any-device] [VERTICES]...\n");
            return 2;
        }
    }
    if (sizes.empty()) sizes = {250e3, 7e6};
    try {
        vesselbench::bench::time_all(any_device, sizes);
    } catch (const vesselbench::GpuUnavailable& error) {
        std::printf("GPU rows end here: %s\n", error.what());
    }
    return 0;
}
