// Times our filling of a closed surface with tetrahedra beside plain TetGen with one bound on the
// volume of all cells, and prints a row each: seconds, of all processors too, cells, angles.
//   bench_tetrahedra CELLS SURFACE...    surfaces in mm, closed

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <string>

#include "geometry/formats/surface_file.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/stopwatch.h"
#include "meshing/tetrahedra/quality.h"
#include "meshing/tetrahedra/tetgen_run.h"
#include "meshing/tetrahedra/tetrahedralize.h"

namespace vesselbench::bench {

namespace {

template <class Run>
void row(const char* name, const Run& run) {
    const Stopwatch watch;
    const std::clock_t start = std::clock();
    const VolumeMesh mesh = run();
    const double seconds = watch.seconds();
    const double processor = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    const VolumeQuality quality = volume_quality(mesh);
    std::printf(
        "  %-34s %8zu cells %8.2f s (processor %7.2f s)  dihedral angles from %.1f deg, mean of "
        "the cells' least %.1f deg\n",
        name, quality.cells, seconds, processor, quality.smallest_dihedral,
        quality.mean_smallest_dihedral);
    std::fflush(stdout);
}

void compare(const Surface& surface, const std::string& name, double cells) {
    std::printf("%s, %zu triangles, to %.0f cells\n", name.c_str(), surface.triangle_count(),
                cells);
    double size = 1.0;
    row("vesselbench, number of cells given", [&] {
        auto result = tetrahedralized(surface, {.cells = cells});
        size = result.report.size;
        return std::move(result.mesh);
    });
    row("vesselbench, size given",
        [&] { return std::move(tetrahedralized(surface, {.size = size}).mesh); });
    row("vesselbench without improvement",
        [&] { return std::move(tetrahedralized(surface, {.size = size, .improve = 0}).mesh); });
    constexpr double kPerBound = 1.9;  // cells for each bound's volume, about
    row("plain TetGen", [&] {
        const std::string bound = std::to_string(kPerBound * volume(surface) / cells);
        return run_tetgen(surface, "pYq1.4/10a" + bound).mesh;
    });
}

}  // namespace

}  // namespace vesselbench::bench

int main(int count, char** words) {
    using namespace vesselbench;
    if (count < 3) {
        std::fprintf(stderr, "usage: bench_tetrahedra CELLS SURFACE...\n");
        return 2;
    }
    try {
        for (int i = 2; i < count; ++i)
            bench::compare(read_surface(words[i]).surface, words[i], std::atof(words[1]));
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
    return 0;
}
