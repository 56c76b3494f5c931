#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>
#include <thread>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "meshing/tetrahedra/tetrahedralize.h"
#include "tests/flow/planted_flow.h"
#include "tests/support/child_process.h"
#include "tests/support/commands.h"
#include "tests/support/paths.h"
#include "tests/support/program.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;
using Json = nlohmann::ordered_json;

namespace fs = std::filesystem;

namespace {

constexpr double kRadius = 2.0, kLength = 12.0;  // [mm]

std::string tube_case(int around = 18) {
    const std::string folder = temporary_folder() + "/tube";
    write_case(folder, tetrahedralized(fine_tube(kRadius, kLength, around), {}).mesh);
    return folder;
}

ProgramRun run_case(const std::string& folder, const std::string& before = "",
                    std::vector<std::string> more = {}) {
    more.insert(more.begin(), {"run", folder});
    return run_program(program_path(), more, before);
}

bool has_openfoam() {
    return run_command("simpleFoam", {"-help"}).has_value();
}

/// A folder with programs of these names in place of OpenFOAM's, as a shell's first words.
std::string programs(const std::string& name, const std::string& script) {
    const std::string folder = temporary_folder();
    std::ofstream(folder + "/" + name) << "#!/bin/sh\n" << script;
    fs::permissions(folder + "/" + name, fs::perms::owner_all);
    return "export PATH=" + folder + ":/usr/bin:/bin;";
}

/// Whether the process of this number runs: one that has ended may wait to be collected.
bool runs(const std::string& pid_file) {
    std::ifstream file(pid_file);
    int pid = 0;
    if (!(file >> pid)) return false;
    std::ifstream stat("/proc/" + std::to_string(pid) + "/stat");
    std::string number, name, state;
    return stat >> number >> name >> state && state != "Z";
}

/// Waits up to two minutes.
bool comes_true(const std::function<bool()>& holds) {
    for (int k = 0; k < 6000; ++k, std::this_thread::sleep_for(20ms))
        if (holds()) return true;
    return false;
}

}  // namespace

SCENARIO("A tube's flow is Hagen and Poiseuille's", "[flow][run]") {
    if (!has_openfoam()) return;
    const std::string folder = tube_case(30);
    const ProgramRun run = run_case(folder, "", {"--json"});
    CAPTURE(run.err);
    REQUIRE(run.exit_code == 0);
    const Json results = Json::parse(run.out);
    const Json& figures = results["figures"];
    // 8 mu L Q / (pi R^4) and 4 mu Q / (pi R^3)
    const double mu = 4e-3, flow = 1.2e-6, metre = 1e-3, pi = std::numbers::pi;
    const double drop = 8 * mu * kLength * metre * flow / (pi * std::pow(kRadius * metre, 4));
    const double shear = 4 * mu * flow / (pi * std::pow(kRadius * metre, 3));
    CHECK(figures["pressure_drop_pa"].get<double>() == Approx(drop).epsilon(0.03));
    CHECK(figures["wall_shear_mean_pa"].get<double>() == Approx(shear).epsilon(0.03));
    CHECK(figures["wall_shear_median_pa"].get<double>() == Approx(shear).epsilon(0.03));
    CHECK(figures["mass_imbalance_percent"].get<double>() < 0.1);
    CHECK(results["solution"]["ended_by"] == "figures");
    CHECK(results["solution"]["iterations"].get<int>() <= 200);
    THEN("files lie in the case, and running it again solves nothing") {
        CHECK(fs::exists(folder + "/results/wall.vtp"));
        const ProgramRun again = run_case(folder);
        CHECK(again.exit_code == 0);
        CHECK_THAT(again.err, Contains("was solved before"));
        const ProgramRun read = run_program(program_path(), {"results", folder, "--json"});
        CHECK(Json::parse(read.out)["figures"] == figures);
    }
}

SCENARIO("Two processes find what one finds", "[flow][run]") {
    if (!has_openfoam()) return;
    const auto figures = [](const std::string& processes) {
        const std::string folder = tube_case();
        const ProgramRun run = run_case(folder, "", {"--json", "--processes", processes});
        CAPTURE(run.err);
        REQUIRE(run.exit_code == 0);
        CHECK_FALSE(fs::exists(folder + "/processor0"));
        return Json::parse(run.out)["figures"];
    };
    const Json one = figures("1"), two = figures("2");
    for (const char* figure : {"pressure_drop_pa", "wall_shear_mean_pa", "wall_shear_p99_pa"})
        CHECK(one[figure].get<double>() == Approx(two[figure].get<double>()).epsilon(0.005));
}

SCENARIO("A run that was killed goes on", "[flow][run]") {
    if (!has_openfoam()) return;
    const std::string processes = GENERATE("1", "2");
    const std::string folder = tube_case(24);
    const std::string half = processes == "1" ? folder + "/50/U" : folder + "/processor0/50/U";
    {
        ChildProcess child(program_path(), {"run", folder, "--processes", processes});
        REQUIRE(comes_true([&] { return fs::exists(half); }));
        child.signal(SIGKILL);
        child.wait();
    }
    // The solver holds the log's lock for as long as it lives: a second run would be refused.
    std::this_thread::sleep_for(200ms);
    const ProgramRun run = run_case(folder, "", {"--processes", processes});
    CAPTURE(run.err);
    CHECK(run.exit_code == 0);
}

SCENARIO("A cancel ends the solver and what it started", "[flow][run]") {
    const std::string pid = temporary_folder() + "/pid";
    const std::string path = programs("simpleFoam", "sleep 600 & echo $! > " + pid + "; wait\n");
    const std::string folder = tube_case();
    ChildProcess child(
        "/bin/sh", {"-c", path + " exec " + program_path() + " run " + folder + " --processes 1"});
    REQUIRE(comes_true([&] { return runs(pid); }));
    child.signal(SIGTERM);
    CHECK(child.wait() == 1);
    CHECK_FALSE(runs(pid));
}

SCENARIO("Without OpenFOAM one line names the package", "[flow][run]") {
    const std::string folder = tube_case();
    const ProgramRun run = run_case(folder, "export PATH=/nowhere;");
    CHECK(run.exit_code == 1);
    CHECK_THAT(run.err, Contains("apt install openfoam"));
    CHECK(fs::exists(folder + "/system/controlDict"));
}

SCENARIO("A solver that fails is reported with its last lines", "[flow][run]") {
    const std::string folder = tube_case();
    const ProgramRun run =
        run_case(folder,
                 programs("simpleFoam",
                          "echo '--> FOAM FATAL ERROR:'; echo 'the flux is too large'; exit 1\n"),
                 {"--processes", "1"});
    CHECK(run.exit_code == 1);
    CHECK_THAT(run.err, Contains("simpleFoam failed"));
    CHECK_THAT(run.err, Contains("FOAM FATAL ERROR: | the flux is too large"));
}

/// The zero of a function that grows.
double zero_of(const std::function<double(double)>& f, double low, double high) {
    for (int k = 0; k < 100; ++k) (f(0.5 * (low + high)) < 0.0 ? low : high) = 0.5 * (low + high);
    return low;
}

/// The wall shear stress [Pa] of a developed flow [m^3/s] of Carreau's blood in a tube [m].
double carreau_wall_shear(double flow, double radius) {
    const auto viscosity = [](double rate) {
        return carreau::kAtShear +
               (carreau::kAtRest - carreau::kAtShear) *
                   std::pow(1.0 + std::pow(carreau::kTime * rate, 2), (carreau::kExponent - 1) / 2);
    };
    const auto flow_at = [&](double wall_shear) {  // pi times the integral of r^2 rate(r)
        const int steps = 400;
        double sum = 0.0;
        for (int k = 0; k < steps; ++k) {
            const double r = radius * (k + 0.5) / steps, stress = wall_shear * r / radius;
            const double rate =
                zero_of([&](double g) { return viscosity(g) * g - stress; }, 0.0, 1e5);
            sum += r * r * rate * radius / steps;
        }
        return std::numbers::pi * sum;
    };
    return zero_of([&](double wall_shear) { return flow_at(wall_shear) - flow; }, 0.0, 100.0);
}

SCENARIO("Carreau's blood has the wall shear stress of its developed flow", "[flow][run]") {
    if (!has_openfoam()) return;
    const std::string folder = temporary_folder() + "/carreau";
    write_case(folder, tetrahedralized(fine_tube(kRadius, kLength, 30), {}).mesh,
               {.viscosity_model = ViscosityModel::Carreau});
    const ProgramRun run = run_case(folder, "", {"--json"});
    CAPTURE(run.err);
    REQUIRE(run.exit_code == 0);
    const Json figures = Json::parse(run.out)["figures"];
    // The inlet's profile is that of Newtonian blood.
    CHECK(figures["wall_shear_median_pa"].get<double>() ==
          Approx(carreau_wall_shear(1.2e-6, 1e-3 * kRadius)).epsilon(0.04));
}

SCENARIO("A flow that uses up its iterations has not converged", "[flow][run]") {
    if (!has_openfoam()) return;
    const std::string folder = temporary_folder() + "/tube";
    write_case(folder, tetrahedralized(fine_tube(kRadius, kLength, 18), {}).mesh,
               {.iterations = 5});
    const ProgramRun run = run_case(folder, "", {"--json"});
    CHECK(run.exit_code == 1);
    CHECK_THAT(run.err, Contains("has not converged after 5 iterations"));
    CHECK(Json::parse(run.out)["solution"]["converged"] == false);
}

SCENARIO("A wrong folder gets one clear line", "[flow][run]") {
    const std::string empty = temporary_folder();
    for (const char* command : {"run", "results"}) {
        const ProgramRun run = run_program(program_path(), {command, empty});
        CHECK(run.exit_code == 3);
        CHECK_THAT(run.err, Contains("holds no OpenFOAM case"));
    }
    const ProgramRun print = run_program(
        program_path(), {"prepare", "x.stl", "--for", "rp", "--run", "--out", empty + "/o"});
    CHECK(print.exit_code == 2);
    CHECK_THAT(print.err, Contains("--run"));
}
