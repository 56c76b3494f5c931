#include "geometry/kernel/statistics.h"

#include <catch2/catch.hpp>

using namespace vesselbench;

SCENARIO("Mean and median of few values", "[geometry][statistics]") {
    const std::vector<double> none, values = {5.0, 1.0, 3.0, 2.0};
    CHECK(mean(none) == 0.0);
    CHECK(mean(values) == 2.75);
    CHECK(median(none) == 0.0);
    CHECK(median(values) == 3.0);  // the upper of the two in the middle
    CHECK(median(std::vector<float>{2.5F}) == 2.5);
}
