// Times the exhaustive search for parameters against the filter alone, and prints a row each.
//   bench_suggestion

#include <algorithm>
#include <cstdio>
#include <vector>

#include <tbb/global_control.h>

#include "geometry/kernel/stopwatch.h"
#include "smoothing/filters/laplace.h"
#include "smoothing/quality/cpu_engine.h"
#include "smoothing/quality/quality_table.h"
#include "tests/bench/organ.h"

namespace vesselbench::bench {

namespace {

constexpr int kRepeats = 7;

std::vector<double> lambdas() {
    std::vector<double> values;
    for (int i = 0; i <= 10; ++i) values.push_back(0.1 * i);
    return values;
}

std::optional<SmoothingChoice> laplace_choice(std::span<const double> values) {
    return SmoothingChoice{LaplaceParameters{values[0]}, nullptr};
}

/// The 11 x 11 sets of thesis 6.5.5, with a new engine.
double search_seconds(const Surface& surface, Fidelity fidelity) {
    const Stopwatch watch;
    QualityTable table(make_cpu_engine({.topology = surface.topology, .start = surface.positions}),
                       laplace_choice, 0, fidelity);
    std::vector<ParameterSet> sets;
    for (const double lambda : lambdas())
        for (int iterations = 0; iterations <= 50; iterations += 5)
            sets.push_back({lambda, static_cast<double>(iterations)});
    table.find(sets);
    return watch.seconds();
}

/// 50 iterations for each lambda, as `smooth` runs them.
double plain_seconds(const Surface& surface) {
    const Stopwatch watch;
    for (const double lambda : lambdas()) {
        const Positions moved =
            laplace(*surface.topology, surface.points(), {lambda}, {.iterations = 50});
    }
    return watch.seconds();
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

/// \param most times the filter alone that the search may take [-]
void compare(const Surface& surface, Fidelity fidelity, double most, const char* name) {
    std::vector<double> search, plain, ratios;
    for (int repeat = -1; repeat < kRepeats; ++repeat) {
        const double one = search_seconds(surface, fidelity), other = plain_seconds(surface);
        if (repeat < 0) continue;
        search.push_back(one);
        plain.push_back(other);
        ratios.push_back(one / other);
    }
    std::printf(
        "%s, 11 x 11 sets, %zu vertices, 2 threads: %.3f s, target < 1.5: %s\n"
        "  / 50 iterations of laplace for each lambda, %.3f s = %.2f (%.2f to %.2f), target <= "
        "%.1f: "
        "%s\n",
        name, surface.vertex_count(), median(search), median(search) < 1.5 ? "met" : "not met",
        median(plain), median(ratios), *std::ranges::min_element(ratios),
        *std::ranges::max_element(ratios), most, median(ratios) <= most ? "met" : "not met");
    std::fflush(stdout);
}

}  // namespace

}  // namespace vesselbench::bench

int main() {
    const tbb::global_control two(tbb::global_control::max_allowed_parallelism, 2);
    using namespace vesselbench;
    for (const double vertices : {38e3, 250e3}) {
        const Surface surface = bench::organ(vertices);
        bench::compare(surface, Fidelity::Estimate, 1.5, "suggestion from estimates");
        bench::compare(surface, Fidelity::Full, 3.0, "suggestion from all vertices");
    }
    return 0;
}
