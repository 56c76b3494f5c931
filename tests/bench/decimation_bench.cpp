// Compares our decimation with other libraries' at the same number of triangles, and prints a row
// each: seconds, distances from the source, worst triangles.
//   bench_decimation [SURFACE]...

#include <cstdio>
#include <string>
#include <vector>

#include "geometry/formats/surface_file.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/reference_comparison.h"
#include "geometry/kernel/self_intersections.h"
#include "geometry/kernel/stopwatch.h"
#include "meshing/remeshing/decimate.h"
#include "tests/bench/organ.h"
#include "tests/bench/reference_decimation.h"

namespace vesselbench::bench {

namespace {

DecimationRun ours(const Surface& surface, std::size_t triangles) {
    const Stopwatch watch;
    Surface result = decimate(surface, {.triangles = triangles}).surface;
    return {std::move(result), watch.seconds()};
}

void print_row(const char* name, const Surface& source, const DecimationRun& run) {
    const auto found = compare_with_reference(run.surface, source);
    const SurfaceMeasures facts = measure(run.surface);
    std::printf(
        "  %-18s %7zu  %7.3f s  mean %.4f  largest %.3f mm  volume %+.3f %%  skewness "
        "%.3f to %.3f  crossings %zu%s\n",
        name, run.surface.triangle_count(), run.seconds, found.mean_distance, found.hausdorff,
        found.volume_change_percent, facts.equiangle_skewness.mean, facts.equiangle_skewness.max,
        facts.self_intersections, facts.connectivity.manifold ? "" : "  NOT MANIFOLD");
    std::fflush(stdout);
}

void compare(const Surface& surface, const char* name) {
    for (const double share : {0.5, 0.25, 0.1}) {
        std::printf("%s, %zu triangles, %.0f %% of them\n", name, surface.triangle_count(),
                    100.0 * share);
        const auto triangles =
            static_cast<std::size_t>(share * static_cast<double>(surface.triangle_count()));
        print_row("vesselbench", surface, ours(surface, triangles));
        print_row("CGAL quadrics", surface, cgal_quadric(surface, triangles));
        print_row("OpenMesh quadrics", surface, openmesh_quadric(surface, triangles));
        print_row("VTK quadrics", surface, vtk_quadric(surface, triangles));
        print_row("VTK DecimatePro", surface, vtk_pro(surface, triangles));
    }
}

}  // namespace

}  // namespace vesselbench::bench

int main(int count, char** names) {
    using namespace vesselbench;
    bench::compare(bench::organ(38e3), "organ");
    for (int i = 1; i < count; ++i)
        bench::compare(read_surface(names[i]).surface,
                       std::string(names[i]).substr(std::string(names[i]).rfind('/') + 1).c_str());
    return 0;
}
