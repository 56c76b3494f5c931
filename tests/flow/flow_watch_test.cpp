#include "workbench/flow/flow_watch.h"

#include <cmath>
#include <filesystem>
#include <fstream>

#include <catch2/catch.hpp>

#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

FlowRecord two_openings() {
    FlowRecord record{.density = 1000.0};
    record.walls = {"wall"};
    record.openings = {{.name = "inlet", .kind = PatchKind::Inlet}, {.name = "outlet_1"}};
    return record;
}

/// Figures that approach their ends as exp(-k / pace), with a residual that falls as fast.
FlowHistory decaying(int iterations, double pace, double amplitude = 1.0) {
    FlowHistory history;
    for (int k = 1; k <= iterations; ++k) {
        const double rest = std::exp(-k / pace);
        history.iterations.push_back(k);
        history.residuals["p"].push_back(rest);
        history.residuals["Ux"].push_back(0.1 * rest);
        history.pressures["inlet"].push_back(100.0 * (1.0 + amplitude * rest));
        history.pressures["outlet_1"].push_back(0.0);
        history.flows["inlet"].push_back(-1.2);
        history.flows["outlet_1"].push_back(1.2 * (1.0 - amplitude * rest));
        history.wall_shear.push_back(2.0 * (1.0 + amplitude * rest));
    }
    return history;
}

}  // namespace

SCENARIO("A run settles when its figures rest and its residuals are low", "[flow][watch]") {
    const FlowRecord record = two_openings();
    const auto settled = [&](const FlowHistory& history) {
        return settling_of(history, record).settled;
    };
    THEN("figures that still change over 50 iterations go on") {
        // Residual exp(-7) = 9e-4; 50 iterations before, figures were off by exp(-2) = 14 %.
        CHECK_FALSE(settled(decaying(70, 10.0)));
        CHECK(settling_of(decaying(70, 10.0), record).residual < 1e-3);
    }
    THEN("resting figures with high residuals go on") {
        CHECK_FALSE(settled(decaying(60, 10.0, 0.0)));
        CHECK(settling_of(decaying(60, 10.0, 0.0), record).change == 0.0);
    }
    THEN("both together end it") {
        CHECK(settled(decaying(115, 10.0)));
        CHECK(settling_of(decaying(115, 10.0), record).remaining == 0.0);
    }
    THEN("it takes at least the window") {
        CHECK_FALSE(settled(decaying(49, 1.0)));
    }
    THEN("one flow that changes is enough to go on") {
        FlowHistory history = decaying(115, 10.0);
        history.flows["outlet_1"][90] *= 1.003;
        CHECK_FALSE(settled(history));
    }
    THEN("what is no number never settles") {
        FlowHistory history = decaying(115, 10.0);
        history.pressures["inlet"].back() = std::nan("");
        CHECK_FALSE(settled(history));
        history = decaying(115, 10.0);
        history.residuals["p"].back() = std::nan("");
        CHECK_FALSE(settled(history));
    }
}

SCENARIO("What is left of a run becomes less", "[flow][watch]") {
    const FlowRecord record = two_openings();
    double before = 1e9;
    for (int iterations = 40; iterations <= 115; iterations += 15) {
        const double left = settling_of(decaying(iterations, 10.0), record).remaining;
        CHECK(left <= before);
        before = left;
    }
}

SCENARIO("A run that went on after a kill has one history", "[flow][watch]") {
    const std::string folder = temporary_folder();
    const auto write = [&](const char* name, int start, int last, const char* row) {
        const std::string place = folder + "/postProcessing/" + name + "/" + std::to_string(start);
        std::filesystem::create_directories(place);
        std::ofstream file(place + "/t.dat");
        file << "# Time p_initial\n";
        for (int k = start + 1; k <= last; ++k) file << k << " " << row << "\n";
        file << last + 1 << " 0.";  // half a line: the solver was killed, or is writing
    };
    for (const char* name : {"residuals", "shear_wall", "pressure_inlet", "pressure_outlet_1",
                             "flow_inlet", "flow_outlet_1"}) {
        write(name, 0, 73, "0.5");
        write(name, 50, 60, "0.25");
    }
    const FlowHistory history = flow_history(folder, two_openings());
    REQUIRE(history.iterations.size() == 60);
    CHECK(history.iterations.back() == 60);
    CHECK(history.residuals.at("p")[49] == 0.5);
    CHECK(history.residuals.at("p")[50] == 0.25);
    CHECK(history.wall_shear.back() == Approx(250.0));
}
