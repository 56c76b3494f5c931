#include "workbench/review/page_choices.h"

#include <cmath>

#include <catch2/catch.hpp>

using namespace vesselbench;

namespace {

constexpr ByHand kAll{.inlet = true, .ends = true, .directions = true};

/// An inlet of 10 mm and an outlet of 5 mm.
DecidedOpenings two_openings() {
    return {.openings = {{.name = "inlet", .inlet = true, .tip = {0, 0, 0}, .diameter = 10.0},
                         {.name = "outlet_1", .tip = {0, 0, 100}, .diameter = 5.0}},
            .ends = {{.place = {0, 0, 100}, .diameter = 5.0, .opening = 0.9}}};
}

}  // namespace

SCENARIO("Decisions that agree with the program's are no item", "[review]") {
    CHECK(compared(two_openings(), two_openings(), kAll).empty());
}

SCENARIO("A narrow inlet is more doubtful than a wide one", "[review]") {
    DecidedOpenings given = two_openings(), own = two_openings();
    std::swap(given.openings[0].inlet, given.openings[1].inlet);
    const auto narrow = compared(given, own, kAll);
    REQUIRE(narrow.size() == 1);
    CHECK(narrow[0].doubt == Approx(1.0 - std::pow(0.5, 3)));
    own.openings[1].diameter = 9.9;
    CHECK(compared(given, own, kAll)[0].doubt < 0.05);
}

SCENARIO("A turned cut is as doubtful as its rim moves", "[review]") {
    DecidedOpenings given = two_openings(), own = two_openings();
    const double turn = 10.0 / 57.29577951308232;
    given.openings[1].normal = Vec3(std::sin(turn), 0.0, std::cos(turn));
    const auto others = compared(given, own, kAll);
    REQUIRE(others.size() == 1);
    CHECK(others[0].doubt == Approx(std::tan(turn)));
    CHECK(others[0].what.find("10 degrees") != std::string::npos);
    THEN("unless the direction is not known better") {
        own.openings[1].direction_sd = 12.0;
        CHECK(compared(given, own, kAll).empty());
    }
    THEN("unless the program decided it, on an earlier surface") {
        CHECK(compared(given, own, {.inlet = true}).empty());
    }
}

SCENARIO("Ends that are closed or opened by hand are weighed by their odds", "[review]") {
    DecidedOpenings fewer = two_openings();
    fewer.openings.pop_back();
    const auto closed = compared(fewer, two_openings(), kAll);
    REQUIRE(closed.size() == 1);
    CHECK(closed[0].doubt == Approx(0.9 * 0.5));
    DecidedOpenings own = fewer;
    own.ends[0].opening = 0.2;
    const auto opened = compared(two_openings(), own, kAll);
    REQUIRE(opened.size() == 1);
    CHECK(opened[0].doubt == Approx(0.8 * 0.5));
}
