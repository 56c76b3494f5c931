#include "smoothing/quality/processing_table.h"

#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/triangle_shape.h"
#include "meshing/remeshing/subdivide.h"
#include "smoothing/quality/search.h"
#include "smoothing/quality/stepwise_analysis.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

Surface scaled(const Surface& surface, double factor) {
    return mapped(surface, [&](const Vec3& p) { return Vec3(factor * p); });
}

/// The set holds the factor by which the ball grows; beyond 2 it fails.
ProcessingTable growing_ball(int& runs) {
    const Surface ball = icosphere(10.0, 3);
    const auto grow = [ball, &runs](const ParameterSet& set,
                                    const Progress&) -> std::optional<Surface> {
        ++runs;
        if (set[0] > 2.0) return std::nullopt;
        return scaled(ball, set[0]);
    };
    return {ball,
            grow,
            [](const ParameterSet& set) { return set[0] == 1.0; },
            {.set = {1.5}, .name = "factor=1.5"}};
}

SearchSpace growth() {
    return {.parameters = {{.name = "factor",
                            .unit = "-",
                            .values = {1.0, 1.1, 1.2, 3.0},
                            .coarse = 3,
                            .idle = 1.0}},
            .chooser = nullptr};
}

std::vector<double> values_of(const StepwiseAnswer& answer) {
    std::vector<double> values;
    for (const CurvePoint& point : answer.analysis.curves.front().points)
        values.push_back(point.value);
    return values;
}

}  // namespace

SCENARIO("Surfaces with other triangles are measured by distances both ways", "[quality]") {
    const Surface ball = icosphere(10.0, 4);
    const ComparisonMeter meter(ball);
    THEN("the original is at no distance from itself") {
        CHECK(meter.measure(ball).error == Approx(0.0).margin(1e-12));
        CHECK(meter.original().triangles == 5120.0);
        CHECK(meter.original().skewness == triangle_shape(ball).equiangle_skewness.mean);
        CHECK(meter.original().curvature_abs ==
              Approx(4.0 * std::numbers::pi * 10.0).epsilon(0.01));
        CHECK(meter.original().volume == Approx(volume(ball)));
    }
    WHEN("the other one is a ball of other triangles around it") {
        const QualityMeasures other = meter.measure(icosphere(10.5, 3));
        THEN("the mean distance is the gap, but for the flat triangles") {
            CHECK(other.error == Approx(0.5).margin(0.06));
            CHECK(other.triangles == 1280.0);
        }
    }
    WHEN("a half of it is missing") {
        std::vector<Triangle> upper;
        for (const Triangle& t : ball.triangles())
            if (ball.points()[t[0]].z() > 0.0) upper.push_back(t);
        const QualityMeasures other = meter.measure(make_surface(ball.points(), upper));
        THEN("what is missing counts") {
            CHECK(other.error > 1.0);
        }
    }
    WHEN("both are turned and measured in other units") {
        const Eigen::Matrix3d turn =
            Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
        const auto moved = [&](const Surface& s) {
            return mapped(s, [&](const Vec3& p) { return Vec3(0.1 * (turn * p)); });
        };
        const Surface fine = subdivide(ball, 1);
        const QualityMeasures here = meter.measure(fine);
        const QualityMeasures there = ComparisonMeter(moved(ball)).measure(moved(fine));
        THEN("lengths and volumes follow") {
            CHECK(there.error == Approx(0.1 * here.error).epsilon(1e-6));
            CHECK(there.curvature_abs == Approx(0.1 * here.curvature_abs).epsilon(1e-6));
            CHECK(there.volume == Approx(0.001 * here.volume).epsilon(1e-6));
        }
    }
    WHEN("there is nothing to measure") {
        CHECK_THROWS_AS(ComparisonMeter(Surface()), InvalidInput);
        CHECK_THROWS_AS(static_cast<void>(meter.measure(scaled(ball, 0.0))), InvalidInput);
    }
}

SCENARIO("An operation's result on a surface is computed once", "[quality]") {
    int runs = 0;
    ProcessingTable table = growing_ball(runs);
    const std::vector<ParameterSet> sets = {{1.0}, {1.1}, {1.2}, {3.0}};
    table.find(sets);
    CHECK(runs == 3);  // the first one changes nothing
    CHECK(table.work().evaluations == 2);
    CHECK(table.at({1.0}) == table.original());
    CHECK(table.at({1.1})->error == Approx(1.0).epsilon(0.02));
    CHECK_FALSE(table.at({3.0}).has_value());
    CHECK(runs == 3);
    CHECK(table.strong().error == Approx(5.0).epsilon(0.02));
    WHEN("the user cancels") {
        std::stop_source stop;
        stop.request_stop();
        const std::vector<ParameterSet> more = {{1.3}};
        CHECK_THROWS_AS(table.find(more, Progress(nullptr, stop.get_token())), Cancelled);
        CHECK_FALSE(table.knows({1.3}));
        THEN("it can be asked again") {
            CHECK(table.at({1.3}).has_value());
        }
    }
}

SCENARIO("A set whose measurement is cancelled is not left out", "[quality]") {
    const Surface ball = icosphere(10.0, 3);
    std::stop_source stop;
    const auto grow = [&](const ParameterSet& set, const Progress&) -> std::optional<Surface> {
        if (set[0] == 1.1) stop.request_stop();  // as a newer value does
        return scaled(ball, set[0]);
    };
    ProcessingTable table(ball, grow, [](const ParameterSet&) { return false; },
                          {{1.5}, "factor=1.5"});
    const std::vector<ParameterSet> sets = {{1.1}};
    CHECK_THROWS_AS(table.find(sets, Progress(nullptr, stop.get_token())), Cancelled);
    CHECK_FALSE(table.knows({1.1}));
    CHECK(table.at({1.1}).has_value());
}

SCENARIO("Searches and graphs work for any operation", "[quality]") {
    int runs = 0;
    const SearchSpace space = growth();
    ParameterSearch search(std::make_shared<ProcessingTable>(growing_ball(runs)), space,
                           {.tau = 0.0});
    CHECK(search.exhaustive(false).values == ParameterSet{1.0});
    CHECK(does_nothing(space, {1.0}));
    CHECK_FALSE(does_nothing(space, {1.1}));
    THEN("the compact score weighs triangles, which are the same here") {
        search.set_score({.form = ScoreForm::Compact, .tau = 1.0});
        const Suggestion found = search.first_look();
        CHECK(found.values == ParameterSet{1.0});
        CHECK(found.score == Approx(1.0));
    }
}

SCENARIO("Graphs of runs are sent value by value", "[quality][live]") {
    int runs = 0;
    ParameterSearch search(std::make_shared<ProcessingTable>(growing_ball(runs)), growth(), {});
    std::vector<StepwiseAnswer> answers;
    std::stop_source stop;
    std::size_t most = 100;
    const auto ask = [&] {
        answers.clear();
        analyse_step_by_step(
            search, search, {1.1},
            [&](const StepwiseAnswer& answer) {
                answers.push_back(answer);
                if (answers.size() == most) stop.request_stop();
            },
            Progress(nullptr, stop.get_token()));
    };
    const std::vector<double> all = {1.0, 1.1, 1.2, 3.0};
    THEN("the value of now is the first, coarse ones follow") {
        ask();
        REQUIRE(answers.size() == 7);
        CHECK(values_of(answers[0]) == std::vector{1.1});
        CHECK(answers[0].analysis.curves.front().least == 1.0);
        CHECK(answers[0].analysis.curves.front().most == 3.0);
        CHECK(values_of(answers[1]) == std::vector{1.1, 3.0});
        CHECK_FALSE(answers[1].analysis.curves.front().points.back().measures);
        CHECK(values_of(answers[2]) == std::vector{1.0, 1.1, 3.0});
        CHECK(values_of(answers[3]) == all);
        CHECK(values_of(answers[6]) == all);
        CHECK(answers[6].complete);
        CHECK(runs == 4);  // three values and the strong change; the fourth value changes nothing
    }
    WHEN("it is interrupted") {
        most = 2;
        CHECK_THROWS_AS(ask(), Cancelled);
        CHECK(runs == 3);
        THEN("nothing is run again, and all that is known comes first") {
            stop = {};
            most = 100;
            ask();
            CHECK(values_of(answers.front()) == std::vector{1.1, 3.0});
            CHECK(answers.back().complete);
            CHECK(runs == 4);
        }
    }
}
