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
    search.answer(given, tau, [&](const LiveSearch::Answer& answer) { last = answer; }, {});
    REQUIRE(last.complete);
    return last;
}

const QualityCurve& curve_of(const LiveSearch::Answer& answer, const std::string& name) {
    for (const QualityCurve& curve : answer.analysis.curves)
        if (curve.name == name) return curve;
    throw InvalidInput("no curve of " + name);
}

/// What a search answers whose first question this is.
void require_fresh(LiveSearch& used, const Scene& scene, const Arguments& given,
                   const std::string& operation = "smooth") {
    LiveSearch fresh(find_operation(operation), scene);
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

SCENARIO("Dragged values are taken as the nearest of the graphs' own",
         "[workbench][suggest][live]") {
    const auto dragged = [](LiveSearch& search, const Arguments& given) {
        LiveSearch::Answer last;
        search.answer_dragged(given, 0.5, [&](const LiveSearch::Answer& a) { last = a; }, {});
        REQUIRE(last.best);
        CHECK_FALSE(last.complete);
        return last;
    };
    const Scene scene = scene_of(fine_tube(4.0, 30.0, 24));
    GIVEN("a filter") {
        LiveSearch search(find_operation("smooth"), scene);
        const auto one = dragged(search, {{"lambda", 0.49}});
        const auto other = dragged(search, {{"lambda", 0.51}});
        CHECK(curve_of(one, "lambda").current == 0.49);
        CHECK(curve_of(other, "lambda").current == 0.51);
        CHECK(curve_of(one, "iterations").suggested == curve_of(other, "iterations").suggested);
        CHECK(one.best == other.best);
        THEN("a value outside the graph stays") {
            const auto many = dragged(search, {{"iterations", std::int64_t{130}}});
            CHECK(curve_of(many, "iterations").points.back().value == 130.0);
        }
        THEN("the answer afterwards is that of the very value") {
            require_fresh(search, scene, {{"lambda", 0.51}});
        }
    }
    GIVEN("an operation whose values take a run each") {
        LiveSearch search(find_operation("remesh"), scene);
        const auto answer = dragged(search, {{"edge", 1.31}, {"gradation", 1.22}});
        CHECK(curve_of(answer, "edge").current == 1.31);
        THEN("what leaves the surface as it is, is none of them") {
            LiveSearch decimation(find_operation("decimate"), scene);
            CHECK(curve_of(dragged(decimation, {{"share", 0.99}}), "share").current == 0.99);
        }
        require_fresh(search, scene, {{"edge", 1.31}, {"gradation", 1.22}}, "remesh");
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
                        {}, 0.5, [&](const LiveSearch::Answer&) { stop.request_stop(); },
                        Progress(nullptr, stop.get_token())),
                    Cancelled);
    require_fresh(search, scene, {});
}

SCENARIO("The graph of a decimation", "[workbench][suggest][live]") {
    const Scene scene = scene_of(fine_tube(4.0, 30.0, 24));
    const auto before = static_cast<double>(scene.surface->triangle_count());
    LiveSearch search(find_operation("decimate"), scene);
    GIVEN("nothing") {
        const auto answer = complete_answer(search, {});
        REQUIRE(answer.analysis.curves.size() == 1);
        const QualityCurve& share = curve_of(answer, "share");
        THEN("it goes from few triangles far away to all of them") {
            CHECK(share.current == 0.5);
            CHECK(share.points.front().measures->triangles < 0.1 * before);
            CHECK(share.points.front().measures->error > 0.0);
            CHECK(share.points.front().measures->skewness > 0.0);
            CHECK(share.points.back().measures->triangles == before);
            CHECK(share.points.back().measures->error == 0.0);
        }
    }
    GIVEN("a target") {
        const auto accurate = complete_answer(search, {}, 0.0);
        const auto small = complete_answer(search, {}, 1.0);
        CHECK((accurate.leave_as_is || accurate.best->real("share") > 0.5));
        CHECK_FALSE(small.leave_as_is);
        CHECK(small.best->real("share") < 0.1);
        CHECK(curve_of(small, "share").suggested == small.best->real("share"));
        THEN("the best of all does not depend on the value of now") {
            CHECK(complete_answer(search, {{"share", 0.37}}, 1.0).best == small.best);
        }
    }
    GIVEN("earlier questions") {
        require_fresh(search, scene, {}, "decimate");
        require_fresh(search, scene, {{"share", 0.33}}, "decimate");
        require_fresh(search, scene, {{"share", 0.33}, {"max_error", 0.05}}, "decimate");
        require_fresh(search, scene, {{"max_error", 0.02}}, "decimate");
    }
    GIVEN("a number of triangles instead of a share") {
        CHECK_THROWS_AS(complete_answer(search, {{"triangles", std::int64_t{300}}}), UsageError);
        require_fresh(search, scene, {}, "decimate");
    }
}

SCENARIO("The graphs of a remeshing", "[workbench][suggest][live]") {
    const Scene scene = scene_of(fine_tube(4.0, 30.0, 24));
    LiveSearch search(find_operation("remesh"), scene);
    THEN("an edge that is not given is the one that the operation takes") {
        const auto answer = complete_answer(search, {});
        REQUIRE(answer.analysis.curves.size() == 2);
        CHECK(curve_of(answer, "edge").current == Approx(0.28 * 4.0).epsilon(0.1));
        CHECK(curve_of(answer, "gradation").current == 1.5);
        CHECK(curve_of(answer, "edge").unit == "mm");
    }
    THEN("longer edges make fewer triangles, and the suggestion leaves the gradation") {
        const Arguments given = {{"edge", 1.3}, {"gradation", 1.2}};
        const auto answer = complete_answer(search, given, 0.8);
        const QualityCurve& edge = curve_of(answer, "edge");
        CHECK(edge.points.front().measures->triangles > edge.points.back().measures->triangles);
        CHECK(edge.points.front().measures->error < edge.points.back().measures->error);
        REQUIRE(answer.best);
        CHECK_FALSE(answer.best->has("gradation"));
        require_fresh(search, scene, given, "remesh");
    }
    THEN("a print, which takes no edge, has graphs as well") {
        const auto answer = complete_answer(search, {{"print_resolution", 0.1}});
        CHECK(curve_of(answer, "edge").current > 0.5);
    }
}

SCENARIO("The graph of a subdivision", "[workbench][suggest][live]") {
    LiveSearch search(find_operation("subdivide"), scene_of(icosphere(10.0, 2)));
    const auto answer = complete_answer(search, {}, 0.0);
    const QualityCurve& iterations = curve_of(answer, "iterations");
    CHECK(iterations.current == 1.0);
    CHECK(iterations.points.front().value == 0.0);
    CHECK(iterations.points.back().measures->triangles == 64.0 * 320.0);
    CHECK(answer.leave_as_is);
}

SCENARIO("Graphs of triangles can be interrupted at any answer", "[workbench][suggest][live]") {
    const Scene scene = scene_of(fine_tube(4.0, 30.0, 24));
    for (const char* operation : {"decimate", "remesh"}) {
        LiveSearch search(find_operation(operation), scene);
        for (const int most : {1, 2, 5}) {
            std::stop_source stop;
            int answers = 0;
            CHECK_THROWS_AS(search.answer(
                                {}, 0.5,
                                [&](const LiveSearch::Answer& answer) {
                                    CHECK_FALSE(answer.complete);
                                    if (++answers == most) stop.request_stop();
                                },
                                Progress(nullptr, stop.get_token())),
                            Cancelled);
            CHECK(answers == most);
        }
        require_fresh(search, scene, {}, operation);
    }
}
