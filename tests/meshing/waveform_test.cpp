#include "meshing/products/waveform.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"

using namespace vesselbench;
using Catch::Matchers::Contains;

SCENARIO("The synthetic waveform follows its formula", "[meshing][waveform]") {
    const Waveform wave = synthetic_waveform(1.5);
    CHECK(wave.synthetic);
    CHECK(wave.period() == 1.0);
    CHECK(wave.flows.back() == wave.flows.front());
    CHECK(wave.mean() == Approx(1.5).epsilon(1e-9));
    CHECK(*std::ranges::min_element(wave.flows) > 0.0);
    const double w = 2.0 * std::numbers::pi * wave.times[30];
    CHECK(wave.times[30] == Approx(0.3));
    CHECK(wave.flows[30] ==
          Approx(1.5 * (1.0 + 0.5 * std::cos(w - 1.2) + 0.25 * std::cos(2.0 * w - 2.4) +
                        0.1 * std::cos(3.0 * w - 3.6))));
}

SCENARIO("A waveform is read from commas or spaces", "[meshing][waveform]") {
    const Waveform wave =
        waveform_from_text("# t, Q\n 0.2, 1.0\r\n\n0.4 3\n0.8\t2\n1.2,1.0\n", "pulse.csv");
    THEN("it begins at 0, and is linear between its rows") {
        CHECK(wave.times == std::vector<double>{0.0, 0.4 - 0.2, 0.8 - 0.2, 1.2 - 0.2});
        CHECK(wave.period() == Approx(1.0));
        CHECK(wave.mean() == Approx(0.2 * 2.0 + 0.4 * 2.5 + 0.4 * 1.5));
        CHECK_FALSE(wave.synthetic);
    }
}

SCENARIO("A waveform that is none is refused in one line", "[meshing][waveform]") {
    const auto [text, why] = GENERATE(table<std::string, std::string>(
        {{"0 1\n1 1\n", "fewer than 3 rows"},
         {"0 1\n0.5 2\n1 1.2\n", "does not close: it begins with 1 and ends with 1.2"},
         {"0 1\n0.5 2\n0.5 3\n1 1\n", "line 3: times must increase"},
         {"t Q\n0 1\n0.5 2\n1 1\n", "line 1 is not a time"},
         {"0 1\n0.5 nan\n1 1\n", "line 2 is not a time"},
         {"0 1\n0.5 2 3\n1 1\n", "line 2 is not a time"},
         {"0 -1\n0.5 0.5\n1 -1\n", "no mean flow above 0"}}));
    CAPTURE(text);
    try {
        static_cast<void>(waveform_from_text(text, "pulse.csv"));
        FAIL("it was read");
    } catch (const UsageError& error) {
        CHECK_THAT(error.what(), Contains("pulse.csv") && Contains(why));
        CHECK(std::string(error.what()).find('\n') == std::string::npos);
    }
}
