#include "smoothing/filters/filter_run.h"

#include <catch2/catch.hpp>

#include "tests/support/iso_surface.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

const std::vector<FilterParameters> kFilters = {
    LaplaceParameters{0.7},     LaplaceHcParameters{0.5, 0.3, 0.4},
    TaubinParameters{0.5},      MeanCurvatureFlowParameters{0.5},
    AnisotropicParameters{0.5}, CurvatureTriggeredParameters{}};

/// Every third vertex moves half as far, and one in seven not at all.
std::shared_ptr<const std::vector<double>> some_weights(std::size_t count) {
    std::vector<double> weights(count, 1.0);
    for (std::size_t v = 0; v < count; v += 3) weights[v] = 0.5;
    for (std::size_t v = 0; v < count; v += 7) weights[v] = 0.0;
    return std::make_shared<const std::vector<double>>(std::move(weights));
}

}  // namespace

SCENARIO("A run in portions equals a single run, bit for bit", "[smoothing][run]") {
    const Surface tube = with_noise(open_tube(3.0, 12.0, 18, 24), 0.2);
    const auto weights = some_weights(tube.vertex_count());
    std::vector<std::uint8_t> fixed(tube.vertex_count(), 0);
    fixed[100] = 1;
    PositionConstraint cell;
    cell.size = Vec3(0.3, 0.3, 0.3);
    for (const auto& constraint : {std::optional<PositionConstraint>{}, std::optional{cell}}) {
        const auto ground = FilterRun::prepare({.topology = tube.topology,
                                                .start = tube.positions,
                                                .fixed = fixed,
                                                .constraint = constraint});
        for (const FilterParameters& filter : kFilters) {
            INFO("filter " << filter.index() << (constraint ? ", in cells" : ""));
            const auto at_once = [&](int iterations) {
                return apply_filter(*tube.topology, tube.points(), filter,
                                    {.iterations = iterations,
                                     .weights = *weights,
                                     .fixed = fixed,
                                     .constraint = constraint});
            };
            FilterRun run(ground, filter, weights);
            Positions now;
            run.write_positions(now);
            CHECK(now == tube.points());
            run.advance(3);
            run.write_positions(now);
            CHECK(now == at_once(3));
            FilterRun copy(run);
            run.advance(4);
            copy.advance(1);
            run.write_positions(now);
            CHECK(now == at_once(7));
            copy.write_positions(now);
            CHECK(now == at_once(4));
            CHECK(copy.iterations() == 4);
        }
    }
}
