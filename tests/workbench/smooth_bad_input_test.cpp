#include <cmath>
#include <filesystem>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/formats/surface_file.h"
#include "geometry/kernel/errors.h"
#include "tests/support/nasty_shapes.h"
#include "tests/support/paths.h"
#include "tests/support/program.h"
#include "tests/support/shapes.h"
#include "tests/workbench/test_operations.h"
#include "workbench/case/operation.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

const std::vector<std::string> kFilters = {
    "laplace", "laplace-hc", "taubin", "mean-curvature-flow", "anisotropic", "curvature-triggered"};

/// Invalid arguments of `smooth`, and what the error must contain.
struct Nonsense {
    std::vector<std::string> arguments;
    std::vector<std::string> parts;
};

std::vector<Nonsense> nonsense() {
    return {{{"lambda=2"}, {"'lambda'", "'2'", "0 to 1"}},
            {{"lambda=-0.1"}, {"'lambda'", "0 to 1"}},
            {{"lambda=nan"}, {"'lambda'", "'nan'", "0 to 1"}},
            {{"lambda=inf"}, {"'lambda'", "0 to 1"}},
            {{"iterations=-1"}, {"'iterations'", "0 to 10000"}},
            {{"iterations=2.5"}, {"'iterations'", "an integer"}},
            {{"iterations=nan"}, {"'iterations'", "an integer"}},
            {{"filter=taubin", "mu=0.5"}, {"'mu'", "-2 to 0"}},
            {{"filter=taubin", "mu=-0.2"}, {"mu = -0.2", "at most -lambda = -0.5"}},
            {{"alpha=2"}, {"'alpha'", "0 to 1"}},
            {{"beta=-1"}, {"'beta'", "0 to 1"}},
            {{"curvature=0"}, {"'curvature'", "above 0 1/mm"}},
            {{"rings=3"}, {"'rings'", "1 to 2"}},
            {{"filter=anisotropic", "rings=2"}, {"rings = 2", "filter=anisotropic"}},
            {{"tau_max=0"}, {"'tau_max'", "above 0 mm"}},
            {{"tau_max=nan"}, {"'tau_max'", "above 0 mm"}},
            {{"tau_theta=1.5"}, {"'tau_theta'", "0 to 1"}},
            {{"beta_min=-0.1"}, {"'beta_min'", "0 to 1"}},
            {{"staircase=true", "stack_axis=0,0,0"}, {"stack_axis = 0,0,0", "not all of them 0"}},
            {{"stack_axis=0,0,0"}, {"stack_axis = 0,0,0", "not all of them 0"}},
            {{"staircase=true", "stack_axis=0,nan,1"}, {"'stack_axis'", "three numbers"}},
            {{"omega=-1"}, {"'omega'", "above 0 1/mm"}},
            {{"omega=0"}, {"'omega'", "above 0 1/mm"}},
            {{"margin=0"}, {"'margin'", "above 0 mm"}},
            {{"margin=-2"}, {"'margin'", "above 0 mm"}},
            {{"constraint=voxel"}, {"cell, x,y,z", "above 0"}},
            {{"constraint=diamond", "cell=1,0,1"}, {"'cell'", "above 0 mm"}},
            {{"cell=1,-1,1"}, {"'cell'", "above 0 mm"}},
            {{"filter=laplac"}, {"'filter'", "did you mean 'laplace'"}},
            {{"caps=no"}, {"'caps'", "keep, smooth, round"}},
            {{"distance=near"}, {"'distance'", "none, linear, margin, exponential"}}};
}

/// What cannot be smoothed as asked, though every argument is in its range: bad input, exit code 3.
std::vector<Nonsense> missing() {
    return {{{"distance=linear"}, {"neighbour", "load-neighbour"}}, {{"painted=mine"}, {"'mine'"}}};
}

/// Every way to smooth: filters, context, caps.
void check_smooths(const std::string& name, const Surface& surface) {
    Scene scene;
    scene.surface = surface;
    scene.neighbours["beside"] = icosphere(1.0, 1, Vec3(4, 0, 3));
    const std::vector<Arguments> contexts = {
        {},
        {{"staircase", true}, {"stack_axis", Vec3(0.1, 0, 1)}, {"distance", std::string("margin")}},
        {{"staircase", true},
         {"stack_axis", Vec3(0, 0, 1)},
         {"beta_min", 0.3},
         {"weight", std::string("thesis")},
         {"distance", std::string("exponential")},
         {"constraint", std::string("diamond")},
         {"cell", Vec3(0.3, 0.3, 1.0)}}};
    for (const std::string& filter : kFilters)
        for (const char* caps : {"keep", "round", "smooth"})
            for (std::size_t c = 0; c < contexts.size(); ++c) {
                CAPTURE(name, filter, caps, c);
                Arguments arguments = contexts[c];
                arguments.set("filter", filter);
                arguments.set("caps", std::string(caps));
                arguments.set("iterations", std::int64_t{5});
                const Outcome outcome = run("smooth", scene, arguments);
                REQUIRE(outcome.scene.surface->topology == surface.topology);
                const auto finite = [](const Vec3& p) { return p.allFinite(); };
                REQUIRE(std::ranges::all_of(outcome.scene.surface->points(), finite));
                const auto figures = outcome.report->flatten();
                for (const auto& [key, value] : figures.items())
                    if (value.is_number()) REQUIRE(std::isfinite(value.get<double>()));
            }
}

}  // namespace

SCENARIO("smooth refuses nonsense by the parameter's name and range", "[workbench][smooth]") {
    const std::string folder = temporary_folder(), project = folder + "/p.vbench";
    write_surface(closed_tube(2.0, 6.0, 12, 8), folder + "/tube.vtp");
    const auto program = [&](std::vector<std::string> arguments) {
        return run_program(test::program_path(), arguments);
    };
    REQUIRE(program({"new", project, folder + "/tube.vtp"}).exit_code == 0);
    const auto check = [&](const std::vector<Nonsense>& cases, int exit_code) {
        for (const auto& [arguments, parts] : cases) {
            std::vector<std::string> command = {"apply", project, "smooth"};
            command.insert(command.end(), arguments.begin(), arguments.end());
            const ProgramRun result = program(command);
            INFO(arguments.back() << ": " << result.err);
            CHECK(result.exit_code == exit_code);
            CHECK(result.out.empty());
            CHECK_THAT(result.err, Catch::Contains("smooth: "));
            for (const std::string& part : parts) CHECK_THAT(result.err, Catch::Contains(part));
        }
    };
    check(nonsense(), 2);
    check(missing(), 1);
    const ProgramRun log = program({"log", project, "--json"});
    CHECK(nlohmann::json::parse(log.out)["edits"].size() == 1);  // none of it left a trace
}

SCENARIO("An empty neighbour is refused by its name", "[workbench][smooth]") {
    Scene scene;
    scene.surface = icosphere(3.0, 2);
    scene.neighbours["tumour"] = make_surface({}, {});
    const auto distance = GENERATE(as<std::string>(), "linear", "margin", "exponential");
    CHECK_THROWS_AS(run("smooth", scene, {{"distance", distance}}), AlgorithmFailure);
    CHECK_THROWS_WITH(run("smooth", scene, {{"distance", distance}}),
                      Catch::Contains("'tumour' has no triangles"));
}

SCENARIO("A neighbour file without a surface is bad input and no edit", "[workbench][smooth]") {
    const std::string folder = temporary_folder(), project = folder + "/p.vbench";
    write_surface(closed_tube(2.0, 6.0, 12, 8), folder + "/tube.vtp");
    write_text(folder + "/empty.stl", "solid empty\nendsolid empty\n");
    write_text(folder + "/nowhere.off", "OFF\n3 1 0\n0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n");
    REQUIRE(run_program(test::program_path(), {"new", project, folder + "/tube.vtp"}).exit_code ==
            0);
    for (const std::string name : {"empty.stl", "nowhere.off", "missing.stl"}) {
        const ProgramRun result = run_program(
            test::program_path(),
            {"apply", project, "load-neighbour", "name=tumour", "file=" + folder + "/" + name});
        INFO(result.err);
        CHECK(result.exit_code == 3);
        CHECK_THAT(result.err, Catch::Contains(name));
    }
    const ProgramRun log = run_program(test::program_path(), {"log", project, "--json"});
    CHECK(nlohmann::json::parse(log.out)["edits"].size() == 1);
}

SCENARIO("A surface without triangles or with non-finite positions is rejected",
         "[workbench][smooth]") {
    const auto filter = GENERATE(from_range(kFilters));
    CHECK_THROWS_AS(run("smooth", make_surface({}, {}), {{"filter", filter}}), AlgorithmFailure);
    CHECK_THROWS_AS(run("smooth", make_surface({{1, 2, 3}}, {}), {{"filter", filter}}),
                    AlgorithmFailure);
    Positions points = icosphere(3.0, 2).points();
    points[7].y() = std::nan("");
    CHECK_THROWS_WITH(run("smooth", icosphere(3.0, 2).with_positions(points), {{"filter", filter}}),
                      Catch::Contains("vertex 7"));
}

SCENARIO("smooth accepts any shape, however broken", "[workbench][smooth]") {
    for (const auto& [name, surface] : nasty_shapes()) check_smooths(name, surface);
}

SCENARIO("smooth accepts broken foreign files", "[workbench][smooth]") {
    const std::string folder = shared_data("nasty");
    if (folder.empty()) return;
    std::size_t smoothed = 0;
    for (const std::string& file : names_in(folder)) {
        Surface surface;
        try {
            surface = read_surface(folder + "/" + file).surface;
        } catch (const InvalidInput&) {
            continue;  // unreadable input is rejected earlier
        }
        if (surface.vertex_count() > 5000) continue;
        check_smooths(file, surface);
        ++smoothed;
    }
    CHECK(smoothed >= 12);
}
