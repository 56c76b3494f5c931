#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/errors.h"
#include "tests/support/shapes.h"
#include "tests/workbench/test_operations.h"
#include "workbench/operation.h"

using namespace vesselbench;
using namespace vesselbench::test;

SCENARIO("smooth keeps caps and rims bit for bit and says what it did", "[workbench][smooth]") {
    const Surface tube = closed_tube(2.0, 12.0, 24, 30);
    const auto filter = GENERATE("laplace", "laplace-hc", "taubin");
    const Outcome outcome = run("smooth", tube, {{"filter", filter}});
    for (TriangleId t = 0; t < tube.triangle_count(); ++t)
        if (tube.patch_of(t).kind != PatchKind::Wall)
            for (const VertexId v : tube.triangles()[t])
                CHECK(outcome.scene.surface->points()[v] == tube.points()[v]);
    CHECK(outcome.report->at("cap_vertices_kept") == 2 * 24 + 2);
    CHECK(outcome.report->at("largest_displacement_mm") > 0.0);
    CHECK(outcome.warnings.empty());
}

SCENARIO("smooth warns of values that roughen and refuses a positive mu", "[workbench][smooth]") {
    const Surface tube = closed_tube(2.0, 12.0, 24, 30);
    CHECK_FALSE(
        run("smooth", tube, {{"lambda", 1.0}, {"beta", 0.0}, {"iterations", std::int64_t{1}}})
            .warnings.empty());
    const Outcome taubin = run("smooth", tube, {{"filter", "taubin"}, {"lambda", 0.4}});
    CHECK(taubin.resolved.real("mu") == Approx(-0.408));
    CHECK_THROWS_AS(run("smooth", tube, {{"filter", "taubin"}, {"mu", 0.52}}), UsageError);
    CHECK_THROWS_WITH(run("smooth", tube, {{"filter", "taubin"}, {"mu", -0.1}}),
                      Catch::Contains("mu"));
}

SCENARIO("remesh decides its edges once and replays them", "[workbench][remesh]") {
    const Surface tube = closed_tube(2.0, 20.0, 40, 60);
    const Outcome first = run("remesh", tube, {});
    CHECK(first.resolved.real("edge") == Approx(0.56).epsilon(0.03));
    CHECK(first.report->at("wall_equiangle_skewness_mean") <= 0.12);
    const Outcome again = run("remesh", tube, first.resolved);
    CHECK(again.scene.surface->points() == first.scene.surface->points());
    CHECK_THROWS_AS(run("remesh", tube, {{"min_edge", 1.0}, {"max_edge", 0.5}}), UsageError);
}

SCENARIO("subdivide makes four triangles of one", "[workbench][subdivide]") {
    const Outcome outcome = run("subdivide", icosphere(5.0, 2), {});
    CHECK(outcome.report->at("triangles_after") == 4 * 320);
}
