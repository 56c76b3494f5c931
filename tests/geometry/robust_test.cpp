#include "geometry/kernel/robust.h"

#include <random>

#include <catch2/catch.hpp>

using namespace vesselbench;

SCENARIO("Tukey's biweight falls from 1 to 0 at its reach", "[geometry][statistics]") {
    CHECK(biweight(0.0, 2.0) == 1.0);
    CHECK(biweight(1.0, 2.0) == 0.5625);
    CHECK(biweight(-1.0, 2.0) == biweight(1.0, 2.0));
    CHECK(biweight(2.0, 2.0) == 0.0);
    CHECK(biweight(100.0, 2.0) == 0.0);
}

SCENARIO("The robust scatter is a normal distribution's standard deviation, whatever lies far off",
         "[geometry][statistics]") {
    std::mt19937 random(7);
    std::normal_distribution<double> normal(0.0, 3.0);
    std::vector<double> deviations(20001);
    for (double& deviation : deviations) deviation = normal(random);
    CHECK(scatter_of(deviations) == Approx(3.0).epsilon(0.02));
    deviations.insert(deviations.end(), 1000, 1e6);
    CHECK(scatter_of(deviations) == Approx(3.0).epsilon(0.1));
    CHECK(scatter_of({}) == 0.0);
}
