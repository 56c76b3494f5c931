#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/formats/surface_file.h"
#include "geometry/kernel/errors.h"
#include "meshing/tetrahedra/tetrahedralize.h"
#include "tests/flow/planted_flow.h"
#include "tests/support/commands.h"
#include "tests/support/paths.h"
#include "tests/support/program.h"
#include "tests/support/shapes.h"
#include "workbench/export/flow_parameters.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;
using Json = nlohmann::ordered_json;

namespace fs = std::filesystem;

namespace {

constexpr double kRadius = 2.0;  // [mm]

std::string text_of(const std::string& path) {
    std::ifstream file(path);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

/// A tube with a synthetic waveform.
std::string pulsatile_tube(int periods, int steps) {
    const std::string folder = temporary_folder() + "/pulse";
    CfdParameters flow{.flow = 1.2};
    flow.waveform = synthetic_waveform(flow.flow);
    flow.periods = periods;
    flow.steps = steps;
    write_case(folder, tetrahedralized(fine_tube(kRadius, 8.0, 12), {}).mesh, flow);
    return folder;
}

/// Where it is false, the skip is counted.
bool has_pimple() {
    return run_command("pimpleFoam", {"-help"}).has_value();
}

}  // namespace

SCENARIO("A waveform makes a case for pimpleFoam", "[flow][waveform]") {
    const std::string folder = pulsatile_tube(2, 1000);
    const std::string control = text_of(folder + "/system/controlDict");
    CHECK_THAT(control, Contains("application     pimpleFoam;") &&
                            Contains("deltaT          0.001;") && Contains("endTime         2;") &&
                            Contains("timeStart       1.0005;") && Contains("writeInterval   50;"));
    CHECK_THAT(text_of(folder + "/0/U"), Contains("timeVaryingMappedFixedValue"));
    CHECK_THAT(text_of(folder + "/system/fvSchemes"), Contains("default         Euler;"));
    CHECK_THAT(text_of(folder + "/README"), Contains("pulsatile") && Contains("synthetic"));
    THEN("the inlet's velocities are given for all periods") {
        const std::string data = folder + "/constant/boundaryData/inlet";
        CHECK(fs::exists(data + "/points"));
        for (const char* time : {"0", "0.37", "1", "1.37", "2"})
            CHECK(fs::exists(data + "/" + time + "/U"));
        CHECK(text_of(data + "/0.37/U") == text_of(data + "/1.37/U"));
    }
    THEN("the record says so") {
        const Json wave = Json::parse(text_of(folder + "/flow.json")).at("waveform");
        CHECK(wave.at("synthetic") == true);
        CHECK(wave.at("period_s") == 1.0);
        CHECK(wave.at("steps") == 1000);
    }
    THEN("results are refused before it was run") {
        const ProgramRun run = run_program(program_path(), {"results", folder});
        CHECK(run.exit_code != 0);
        CHECK_THAT(run.err, Contains("has no results"));
    }
}

SCENARIO("A pulsatile flow is run, taken up and evaluated over its last period",
         "[flow][waveform]") {
    if (!has_pimple()) return;
    const std::string folder = pulsatile_tube(2, 40);
    const ProgramRun run =
        run_program(program_path(), {"run", folder, "--json", "--processes", "1"});
    CAPTURE(run.err);
    REQUIRE(run.exit_code == 0);
    CHECK_THAT(run.err, Contains("80 steps") && Contains("largest Courant number"));
    const Json results = Json::parse(run.out);
    const Json& figures = results.at("figures");
    CHECK(results.at("solution").at("kind") == "pulsatile");
    CHECK(results.at("solution").at("waveform") == "synthetic");
    THEN("the mean flow is the given one") {
        for (const Json& opening : results.at("openings"))
            CHECK(opening.at("flow_cm3_s").get<double>() == Approx(1.2).epsilon(0.01));
    }
    THEN("a flow that never turns has no oscillating shear") {
        CHECK(figures.at("osi_p95").get<double>() < 0.05);
        CHECK(figures.at("wall_shear_mean_pa").get<double>() > 0.3);
        CHECK(figures.at("rrt_median_per_pa").get<double>() > 0.0);
    }
    THEN("texts say what was done") {
        CHECK_THAT(results.at("methods").get<std::string>(),
                   Contains("pulsatile") && Contains("synthetic (not measured)") &&
                       Contains("pimpleFoam") && !Contains("steady"));
        CHECK_THAT(text_of(folder + "/results/wall.vtp"),
                   Contains("osi") && Contains("rrt_per_pa"));
    }
    THEN("it is not run again") {
        const ProgramRun again = run_program(program_path(), {"run", folder});
        CHECK(again.exit_code == 0);
        CHECK_THAT(again.err, Contains("was solved before, in 80 steps"));
    }
    WHEN("the last step is lost, as of a killed run") {
        fs::remove_all(folder + "/2");
        THEN("results of a part of a period are refused, and the run goes on") {
            const ProgramRun none = run_program(program_path(), {"results", folder});
            CHECK(none.exit_code != 0);
            CHECK_THAT(none.err, Contains("step 78 of 80"));
            const ProgramRun on =
                run_program(program_path(), {"run", folder, "--json", "--processes", "1"});
            CHECK(on.exit_code == 0);
            CHECK_THAT(on.err, Contains("going on after step 78"));
            const Json after = Json::parse(on.out).at("figures");
            for (const char* name : {"wall_shear_mean_pa", "osi_mean", "pressure_drop_pa"})
                CHECK(after.at(name).get<double>() ==
                      Approx(figures.at(name).get<double>()).epsilon(1e-3));
        }
    }
}

SCENARIO("A pulsatile flow is shared by processes", "[flow][waveform]") {
    if (!has_pimple() || !run_command("mpirun", {"--version"})) return;
    const std::string folder = pulsatile_tube(1, 20);
    const ProgramRun run =
        run_program(program_path(), {"run", folder, "--json", "--processes", "2"});
    CAPTURE(run.err);
    REQUIRE(run.exit_code == 0);
    for (const Json& opening : Json::parse(run.out).at("openings"))
        CHECK(opening.at("flow_cm3_s").get<double>() == Approx(1.2).epsilon(0.01));
}

SCENARIO("A waveform that does not close is refused before anything is written",
         "[flow][waveform]") {
    const std::string folder = temporary_folder();
    write_surface(open_tube(kRadius, 20.0, 20, 20), folder + "/tube.stl");
    std::ofstream(folder + "/pulse.csv") << "0,1\n0.5,2\n1,1.5\n";
    for (const char* waveform : {"pulse.csv", "missing.csv"}) {
        CAPTURE(waveform);
        const ProgramRun run =
            run_program(program_path(), {"prepare", folder + "/tube.stl", "--for", "cfd", "--set",
                                         "openfoam.waveform=" + folder + "/" + waveform, "--out",
                                         folder + "/case"});
        CHECK(run.exit_code == 2);
        CHECK_THAT(run.err, Contains("openfoam.waveform: ") && Contains(waveform));
        CHECK(std::count(run.err.begin(), run.err.end(), '\n') == 1);
        CHECK_FALSE(fs::exists(folder + "/case"));
    }
}

SCENARIO("A project keeps a waveform's numbers, and no path", "[flow][waveform]") {
    const std::string folder = temporary_folder();
    std::ofstream(folder + "/pulse.csv") << "# t, Q\n0,1\n0.5,2\n1,1\n";
    CHECK(kept_waveform(folder + "/pulse.csv") == "0:1;0.5:2;1:1");
    CHECK(kept_waveform("0:1;0.5:2;1:1") == "0:1;0.5:2;1:1");
    CHECK(kept_waveform("synthetic") == "synthetic");
    Arguments given;
    given.set("waveform", std::string("0:1;0.5:2;1:1"));
    const CfdParameters flow = flow_from(given);
    REQUIRE(flow.waveform);
    THEN("the flow is the file's") {
        CHECK(flow.flow == Approx(1.5));
        CHECK_FALSE(flow.waveform->synthetic);
    }
    THEN("flows of single inlets are refused beside it") {
        given.set("inlet_flows", std::string("inlet_1:1"));
        CHECK_THROWS_AS(flow_from(given), UsageError);
    }
}
