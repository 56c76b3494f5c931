#include "workbench/suggest/live_search.h"

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "tests/support/shapes.h"
#include "tests/support/stack_phantoms.h"
#include "workbench/operations/table.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

Scene scene_of(Surface surface) {
    Scene scene;
    scene.surface = std::move(surface);
    return scene;
}

LiveSearch::Answer complete_answer(LiveSearch& search, const Arguments& given, double tau = 0.5) {
    LiveSearch::Answer last;
    search.answer(given, {.tau = tau}, [&](const LiveSearch::Answer& answer) { last = answer; },
                  {});
    REQUIRE(last.complete);
    return last;
}

const QualityCurve& curve_of(const LiveSearch::Answer& answer, const std::string& name) {
    for (const QualityCurve& curve : answer.analysis.curves)
        if (curve.name == name) return curve;
    throw InvalidInput("no curve of " + name);
}

/// What a search answers whose first question this is.
void require_fresh(LiveSearch& used, const Scene& scene, const Arguments& given) {
    LiveSearch fresh(find_operation("smooth"), scene);
    const auto a = complete_answer(used, given), b = complete_answer(fresh, given);
    REQUIRE(a.best == b.best);
    REQUIRE(a.analysis.curves.size() == b.analysis.curves.size());
    for (std::size_t i = 0; i < a.analysis.curves.size(); ++i) {
        const QualityCurve &one = a.analysis.curves[i], &other = b.analysis.curves[i];
        REQUIRE(one.current == other.current);
        REQUIRE(one.suggested == other.suggested);
        REQUIRE(one.points.size() == other.points.size());
        for (std::size_t k = 0; k < one.points.size(); ++k)
            REQUIRE(one.points[k].measures == other.points[k].measures);
    }
}

}  // namespace

SCENARIO("Earlier questions do not change later answers", "[workbench][suggest][live]") {
    GIVEN("a filter") {
        const Scene scene = scene_of(fine_tube(4.0, 30.0, 24));
        LiveSearch search(find_operation("smooth"), scene);
        require_fresh(search, scene, {});
        require_fresh(search, scene, {{"lambda", 0.7}});
        require_fresh(search, scene, {{"filter", std::string("taubin")}, {"lambda", 0.4}});
        require_fresh(search, scene, {{"iterations", std::int64_t{9}}});
    }
    GIVEN("staircases") {
        const Scene scene = scene_of(of_mask(vessel_in_slices()));
        LiveSearch search(find_operation("smooth"), scene);
        const Arguments aware = {{"staircase", true}, {"filter", std::string("laplace")}};
        require_fresh(search, scene, aware);
        Arguments changed = aware;
        changed.set("beta_min", 0.3);
        require_fresh(search, scene, changed);
        CHECK(curve_of(complete_answer(search, changed), "beta_min").current == 0.3);
        require_fresh(search, scene, aware);
    }
}

SCENARIO("The target smoothness moves the suggestion, not the measures",
         "[workbench][suggest][live]") {
    LiveSearch search(find_operation("smooth"), scene_of(fine_tube(4.0, 30.0, 24)));
    const Arguments given = {{"filter", std::string("laplace")}};
    const auto accurate = complete_answer(search, given, 0.0);
    const auto smooth = complete_answer(search, given, 1.0);
    CHECK(accurate.best->integer("iterations") == 0);
    CHECK(smooth.best->integer("iterations") > 0);
    const QualityCurve &a = curve_of(accurate, "lambda"), &b = curve_of(smooth, "lambda");
    CHECK(a.points.front().measures == b.points.front().measures);
    CHECK(a.suggested <= b.suggested);
}

SCENARIO("A cancelled analysis can be asked again", "[workbench][suggest][live]") {
    const Scene scene = scene_of(fine_tube(4.0, 30.0, 24));
    LiveSearch search(find_operation("smooth"), scene);
    std::stop_source stop;
    CHECK_THROWS_AS(search.answer(
                        {}, {}, [&](const LiveSearch::Answer&) { stop.request_stop(); },
                        Progress(nullptr, stop.get_token())),
                    Cancelled);
    require_fresh(search, scene, {});
}
