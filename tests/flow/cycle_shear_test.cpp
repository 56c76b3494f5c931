#include "workbench/flow/cycle_shear.h"

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include <catch2/catch.hpp>

#include "workbench/flow/flow_results.h"

using namespace vesselbench;

namespace {

constexpr int kSteps = 1000;

/// Of a stress [Pa] at a phase in [0, 1), averaged over as many steps as a case has.
CycleShear over_a_period(const std::function<Vec3(double)>& stress) {
    Vec3 mean = Vec3::Zero();
    double magnitude = 0.0;
    for (int k = 0; k < kSteps; ++k) {
        const Vec3 now = stress((k + 0.5) / kSteps);
        mean += now / kSteps;
        magnitude += now.norm() / kSteps;
    }
    return cycle_shear(mean, magnitude);
}

}  // namespace

SCENARIO("Figures of planted stresses are those of their closed forms", "[flow][cycle]") {
    const double pi = std::numbers::pi;
    GIVEN("a constant stress of 2 Pa") {
        const CycleShear shear = over_a_period([](double) { return Vec3(0, 1.2, -1.6); });
        CHECK(shear.tawss == Approx(2.0).epsilon(1e-6));
        CHECK(shear.osi == Approx(0.0).margin(1e-6));
        CHECK(shear.rrt == Approx(0.5).epsilon(1e-6));
        CHECK(shear.ecap == Approx(0.0).margin(1e-6));
    }
    GIVEN("one that changes its sign after half a period") {
        const CycleShear shear =
            over_a_period([](double t) { return Vec3(t < 0.5 ? 3.0 : -3.0, 0, 0); });
        CHECK(shear.tawss == Approx(3.0).epsilon(1e-6));
        CHECK(shear.osi == Approx(0.5).margin(1e-6));
        CHECK(shear.rrt > 1e6);
        CHECK(shear.ecap == Approx(0.5 / 3.0).epsilon(1e-6));
    }
    GIVEN("one that is turned over for a quarter of the period") {
        // mean 0.75 - 0.25 = 0.5 of the magnitude 4
        const CycleShear shear =
            over_a_period([](double t) { return Vec3(0, t < 0.25 ? -4.0 : 4.0, 0); });
        CHECK(shear.osi == Approx(0.25).epsilon(1e-6));
        CHECK(shear.rrt == Approx(0.5).epsilon(1e-6));
        CHECK(shear.ecap == Approx(0.0625).epsilon(1e-6));
    }
    GIVEN("a wave of 2 Pa that stays forward, 2 + sin") {
        const CycleShear shear =
            over_a_period([&](double t) { return Vec3(2.0 + std::sin(2.0 * pi * t), 0, 0); });
        CHECK(shear.tawss == Approx(2.0).epsilon(1e-6));
        CHECK(shear.osi == Approx(0.0).margin(1e-6));
    }
    GIVEN("one that turns once round in the wall's plane") {
        const CycleShear shear = over_a_period(
            [&](double t) { return Vec3(std::cos(2.0 * pi * t), std::sin(2.0 * pi * t), 0); });
        CHECK(shear.tawss == Approx(1.0).epsilon(1e-6));
        CHECK(shear.osi == Approx(0.5).margin(1e-6));
    }
    GIVEN("none") {
        const CycleShear shear = over_a_period([](double) { return Vec3(0, 0, 0); });
        CHECK(shear.osi == 0.0);
        CHECK(shear.ecap == 0.0);
        CHECK(shear.rrt == std::numeric_limits<double>::infinity());
    }
}

SCENARIO("Figures over a wall are weighted by area", "[flow][cycle]") {
    const std::vector<CycleShear> values = {cycle_shear(Vec3(2, 0, 0), 2.0),
                                            cycle_shear(Vec3(2, 0, 0), 4.0)};
    const CycleFigures figures = cycle_figures(values, {3.0, 1.0});
    CHECK(figures.osi_mean == Approx(0.25 * 0.25));
    CHECK(figures.osi_p95 == Approx(0.25));
    CHECK(figures.ecap_p95 == Approx(0.0625));
    CHECK(figures.rrt_median == Approx(0.5));
}
