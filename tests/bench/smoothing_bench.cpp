// Times the filters of smoothing/ and other libraries' in the same run, and prints a row each.
//   bench_smoothing [--large]     with --large also 7 million vertices (about 15 GB of memory)

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <malloc.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include "geometry/kernel/stopwatch.h"
#include "smoothing/context/area_normals.h"
#include "smoothing/context/caps.h"
#include "smoothing/context/staircase_weights.h"
#include "smoothing/context/staircases.h"
#include "smoothing/filters/laplace.h"
#include "smoothing/filters/laplace_hc.h"
#include "smoothing/filters/taubin.h"
#include "tests/bench/organ.h"
#include "tests/bench/reference_filters.h"

namespace vesselbench::bench {

namespace {

constexpr int kIterations = 20;
constexpr int kRepeats = 7;
const Vec3 kStackAxis(0, 0, 1);

/// Seconds of one of our filters with its neighbour arrays, built by a fresh topology each time.
template <class Filter>
Run ours(const Surface& surface, Filter filter) {
    return [&surface, filter] {
        std::vector<Triangle> triangles(surface.triangles().begin(), surface.triangles().end());
        const Stopwatch watch;
        const Topology topology(std::move(triangles), surface.vertex_count());
        [[maybe_unused]] const auto result = filter(topology, surface.points());
        return watch.seconds();
    };
}

Positions twenty_laplace(const Topology& topology, const Positions& positions) {
    return laplace(topology, positions, {}, FilterSettings{.iterations = kIterations});
}

Positions twenty_laplace_hc(const Topology& topology, const Positions& positions) {
    return laplace_hc(topology, positions, {}, FilterSettings{.iterations = kIterations});
}

Positions twenty_taubin(const Topology& topology, const Positions& positions) {
    return taubin(topology, positions, {}, FilterSettings{.iterations = kIterations});
}

std::vector<double> sorted(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values;
}

double median(const std::vector<double>& ascending) {
    return ascending[ascending.size() / 2];
}

/// Results of the repeats of two runs, each ascending.
struct Pair {
    std::vector<double> first, second;  ///< [s]
    std::vector<double> ratios;         ///< first / second of each repeat [-]
};

/// Runs both alternately, so that a disturbance of the machine affects both; the first turn warms
/// up.
Pair in_turn(const Run& first, const Run& second) {
    std::vector<double> a, b, ratios;
    for (int repeat = -1; repeat < kRepeats; ++repeat) {
        const double one = first(), other = second();
        if (repeat < 0) continue;
        a.push_back(one);
        b.push_back(other);
        ratios.push_back(one / other);
    }
    return {sorted(a), sorted(b), sorted(ratios)};
}

void row(const char* name, const Pair& times, double target, bool at_least) {
    const bool met = at_least ? median(times.ratios) >= target : median(times.ratios) <= target;
    std::printf("%-66s %7.4f s / %7.4f s = %5.2f (%.2f to %.2f), target %s %.1f: %s\n", name,
                median(times.first), median(times.second), median(times.ratios),
                times.ratios.front(), times.ratios.back(), at_least ? ">=" : "<=", target,
                met ? "met" : "not met");
    std::fflush(stdout);
}

template <class Work>
auto on_threads(int count, const Work& work) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism,
                                      static_cast<std::size_t>(count));
    return work();
}

Run on(int threads, const Run& run) {
    return [threads, run] { return on_threads(threads, run); };
}

void compare_filters(const Surface& surface) {
    const Run our_laplace = ours(surface, twenty_laplace);
    const auto both = [&](const char* name, const Run& first, const Run& second, int threads,
                          double target, bool at_least = true) {
        row(name, in_turn(on(threads, first), on(threads, second)), target, at_least);
    };
    const Run vtk = vtk_laplace(surface, kIterations);
    both("vtkSmoothPolyDataFilter / laplace, 2 threads", vtk, our_laplace, 2, 15.0);
    both("vtkSmoothPolyDataFilter / laplace, 1 thread", vtk, our_laplace, 1, 8.0);
    both("OpenMesh JacobiLaplaceSmootherT C0 / laplace, 2 threads",
         openmesh_laplace(surface, kIterations), our_laplace, 2, 7.0);
    both("vtkWindowedSincPolyDataFilter / taubin of 20 pairs, 2 threads",
         vtk_windowed_sinc(surface, kIterations), ours(surface, twenty_taubin), 2, 2.0);
    both("laplace_hc / laplace, 2 threads", ours(surface, twenty_laplace_hc), our_laplace, 2, 2.5,
         false);
    row("laplace on 1 thread / on 2", in_turn(on(1, our_laplace), on(2, our_laplace)), 1.5, true);
}

/// Orientation changes; about the given fraction exceeds `threshold`, all of them if it is 1.
std::vector<double> changes_of(const Surface& surface, double share, double& threshold) {
    std::vector<double> change =
        orientation_change(*surface.topology, surface.points(), kStackAxis);
    if (share == 1.0) change.assign(change.size(), 1.0);
    const auto place = static_cast<std::size_t>((1.0 - share) * static_cast<double>(change.size()));
    threshold = share == 1.0 ? 0.0 : sorted(change)[place];
    return change;
}

/// Orientation changes, caps and weights on a surface that has no neighbour arrays yet.
/// \param change input of the weights, close to the orientation changes
double detection_seconds(const Surface& surface, std::span<const double> change,
                         StaircaseParameters parameters) {
    const Surface fresh =
        make_surface(surface.points(), {surface.triangles().begin(), surface.triangles().end()});
    const Stopwatch watch;
    const AreaNormals faces(fresh, AreaNormals::When::Ahead);
    const auto detected = orientation_change(faces, kStackAxis);
    const auto caps = cap_vertices(find_caps(faces), detected.size());
    parameters.caps = caps;
    const auto weights = staircase_weights(*fresh.topology, fresh.points(), change, parameters);
    return watch.seconds();
}

/// Times detection and weights from scratch, and weights alone as after a change of a threshold,
/// against 40 Laplace iterations.
void compare_staircases(const Surface& surface, double share) {
    StaircaseParameters parameters;
    const std::vector<double> change = changes_of(surface, share, parameters.tau_theta);
    const auto found = std::count_if(change.begin(), change.end(),
                                     [&](double c) { return c > parameters.tau_theta; });
    std::printf("%zu vertices, %.1f %% at staircases, weights up to %.0f mm from them:\n",
                surface.vertex_count(),
                100.0 * static_cast<double>(found) / static_cast<double>(change.size()),
                parameters.tau_max);
    const Run whole = on(2, [&] { return detection_seconds(surface, change, parameters); });
    const Run iterations = on(2, ours(surface, [](const Topology& topology, const Positions& x) {
                                  return laplace(topology, x, {}, {.iterations = 40});
                              }));
    const auto caps = cap_vertices(find_caps(surface), surface.vertex_count());
    parameters.caps = caps;
    const Run again = on(2, [&] {
        const Stopwatch watch;
        const auto weights =
            staircase_weights(*surface.topology, surface.points(), change, parameters);
        return watch.seconds();
    });
    row("  detection, caps and weights / 40 laplace iterations, 2 threads",
        in_turn(whole, iterations), 1.0, false);
    row("  weights for another threshold / detection, caps and weights", in_turn(again, whole), 0.5,
        false);
}

/// STREAM's triad a = b + s c, 24 bytes per element, arrays of 256 MiB [bytes/s].
double triad_bandwidth(int threads) {
    const std::size_t count = std::size_t{1} << 25;
    std::vector<double> a(count, 0.0), b(count, 1.0), c(count, 2.0);
    const Run triad = on(threads, [&] {
        const Stopwatch watch;
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, std::size_t{1} << 16),
                          [&](const auto& part) {
                              for (std::size_t i = part.begin(); i < part.end(); ++i)
                                  a[i] = b[i] + 3.0 * c[i];
                          });
        return watch.seconds();
    });
    const Pair times = in_turn(triad, triad);
    return 24.0 * static_cast<double>(count) / std::min(times.first.front(), times.second.front());
}

/// Seconds of one Laplace iteration with everything built: the slope between the fastest runs
/// of 20 and of 60 iterations.
double iteration_seconds(const Surface& surface) {
    const auto some = [&](int iterations) -> Run {
        return [&surface, iterations] {
            const Stopwatch watch;
            const Positions moved = laplace(*surface.topology, surface.points(), {},
                                            FilterSettings{.iterations = iterations});
            return watch.seconds();
        };
    };
    const Pair times = in_turn(some(60), some(20));
    return (times.first.front() - times.second.front()) / 40.0;
}

/// Least memory traffic of a single iteration: each position is read and written once, each offset
/// and each neighbour index read once. Iterations that share a pass through the memory move less,
/// so the rate may exceed the triad's.
double iteration_bytes(const Topology& topology) {
    return static_cast<double>(topology.vertex_count() * 2 * sizeof(Vec3) +
                               topology.rings().bytes());
}

/// Seconds until a fresh topology has its one-rings.
Run one_rings(const Surface& surface) {
    return ours(surface, [](const Topology& topology, const Positions&) {
        return topology.rings().offsets.size();
    });
}

/// A figure of /proc/self/status [bytes]; 0 if there is none.
double process_bytes(const std::string& key) {
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;)
        if (double kib = 0.0; word == key + ":" && status >> kib) return 1024.0 * kib;
    return 0.0;
}

/// Peak memory of 20 iterations in addition to their input, neighbour arrays and result included.
double peak_bytes(const Surface& surface) {
    malloc_trim(0);
    std::ofstream("/proc/self/clear_refs") << "5";  // resets the peak
    const double before = process_bytes("VmRSS");
    ours(surface, twenty_laplace)();
    return process_bytes("VmHWM") - before;
}

void scale(const Surface& surface, double triad) {
    const auto vertices = static_cast<double>(surface.vertex_count());
    const double peak = peak_bytes(surface);
    const Run run = ours(surface, twenty_laplace);
    const Pair times = in_turn(run, one_rings(surface));
    const double iteration = iteration_seconds(surface);
    const double bytes = iteration_bytes(*surface.topology);
    const double by_step = 1e9 / vertices / kIterations;
    std::printf("laplace of %.0f vertices, 2 threads:\n", vertices);
    std::printf("    %.2f ns a vertex and iteration, %.2f of them iterating, %.2f for one-rings\n",
                by_step * median(times.first), 1e9 * iteration / vertices,
                by_step * median(times.second));
    std::printf("    %.0f bytes of memory a vertex at the peak, beside the input's 48\n",
                peak / vertices);
    std::printf(
        "    %.1f GB/s of the %.0f bytes a vertex that an iteration by itself reads and "
        "writes (positions in and out,\n    neighbour lists in); triad %.1f GB/s\n",
        bytes / iteration / 1e9, bytes / vertices, triad / 1e9);
    std::fflush(stdout);
}

}  // namespace

}  // namespace vesselbench::bench

int main(int count, char** words) {
    using namespace vesselbench;
    using namespace vesselbench::bench;
    const bool large = count == 2 && std::strcmp(words[1], "--large") == 0;
    if (count > 1 && !large) {
        std::fprintf(stderr, "usage: bench_smoothing [--large]\n");
        return 2;
    }
    const Surface surface = organ(250e3);
    std::printf("raw surface of %zu vertices, %d iterations, medians of %d repeats\n",
                surface.vertex_count(), kIterations, kRepeats);
    compare_filters(surface);
    const Surface stack = organ(94e3, 4);
    for (const double share : {0.1, 1.0}) compare_staircases(stack, share);
    on_threads(2, [&] {
        const double triad = triad_bandwidth(2);
        scale(surface, triad);
        scale(organ(1e6), triad);
        if (large) scale(organ(7e6), triad);
    });
    return 0;
}
