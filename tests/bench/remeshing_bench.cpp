// Times our remeshing beside CGAL's isotropic remeshing to the same edge length, and prints a row
// each: seconds, and those of all processors, triangles made a second, the worst and mean triangle,
// change of the volume.
//   bench_remeshing EDGE_MM SURFACE...    surfaces in mm

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <string>

#include "geometry/formats/surface_file.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/stopwatch.h"
#include "geometry/vessel/repair/repair.h"
#include "meshing/remeshing/remesh.h"
#include "tests/bench/reference_remeshing.h"

namespace vesselbench::bench {

namespace {

RemeshingRun ours(const Surface& surface, RemeshMode mode, double edge) {
    const Stopwatch watch;
    const std::clock_t start = std::clock();
    Surface result = remesh(surface, {.mode = mode, .edge = edge}).surface;
    return {std::move(result), watch.seconds(), processor_seconds(start)};
}

void print_row(const char* name, const Surface& source, const RemeshingRun& run) {
    const SurfaceMeasures facts = measure(run.surface);
    const auto count = static_cast<double>(run.surface.triangle_count());
    std::printf(
        "  %-22s %8zu  %8.2f s (processor %6.2f s)  %8.0f triangles/s  skewness %.3f to %.3f  "
        "volume %+.3f %%\n",
        name, run.surface.triangle_count(), run.seconds, run.processor, count / run.seconds,
        facts.equiangle_skewness.mean, facts.equiangle_skewness.max,
        100.0 * (volume(run.surface) / volume(source) - 1.0));
    std::fflush(stdout);
}

void compare(const Surface& surface, const std::string& name, double edge) {
    std::printf("%s, %zu triangles, to edges of %g mm\n", name.c_str(), surface.triangle_count(),
                edge);
    print_row("graded", surface, ours(surface, RemeshMode::Graded, edge));
    print_row("uniform", surface, ours(surface, RemeshMode::Uniform, edge));
    print_row("CGAL isotropic", surface, cgal_isotropic(surface, edge));
}

}  // namespace

}  // namespace vesselbench::bench

int main(int count, char** words) {
    using namespace vesselbench;
    if (count < 3) {
        std::fprintf(stderr, "usage: bench_remeshing EDGE_MM SURFACE...\n");
        return 2;
    }
    try {
        for (int i = 2; i < count; ++i)
            bench::compare(repair(read_surface(words[i]).surface).surface, words[i],
                           std::atof(words[1]));
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
    return 0;
}
