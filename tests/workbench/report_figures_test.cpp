#include <cmath>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/formats/surface_file.h"
#include "tests/support/paths.h"
#include "tests/support/program.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Json = nlohmann::ordered_json;

namespace {

/// A closed tube with waves, so that different figures have different values.
Surface wavy_tube() {
    return mapped(closed_tube(2.0, 12.0, 40, 50), [](const Vec3& p) {
        const double wave = 1.0 + 0.1 * std::sin(1.7 * p.z());
        return Vec3(wave * p.x(), 1.1 * wave * p.y(), p.z());
    });
}

ProgramRun successful_run(const std::vector<std::string>& arguments) {
    ProgramRun result = run(arguments);
    INFO(result.err);
    REQUIRE(result.exit_code == 0);
    return result;
}

/// No number of the report is one that the change has already. Of `decimate`, the two-sided
/// distance equals the change's one-sided one where that is the larger one.
void check_figures(const Json& edit) {
    const Json change = edit.at("change").flatten(), report = edit.at("report").flatten();
    CHECK(change.size() == 7);
    for (const auto& [its_key, its] : report.items())
        for (const auto& [key, figure] : change.items()) {
            if (!its.is_number() || !figure.is_number()) continue;
            if (its_key.starts_with("/distance/")) continue;
            CAPTURE(edit.at("operation"), its_key, key);
            CHECK(its.get<double>() != Approx(figure.get<double>()).epsilon(1e-9));
        }
}

}  // namespace

SCENARIO("An edit's figures stand under one key each", "[workbench][report]") {
    const std::string folder = temporary_folder(), project = folder + "/case.vbench";
    write_surface(wavy_tube(), folder + "/tube.vtp");
    successful_run({"new", project, folder + "/tube.vtp"});
    const auto applied = [&](std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), {"apply", project});
        arguments.emplace_back("--json");
        return Json::parse(successful_run(arguments).out);
    };
    const std::vector<std::string> dab = {"at=2.2,0,6", "radius=1.5", "strength=0.5"};
    const auto brushed = [&](const std::string& brush) {
        std::vector<std::string> arguments = dab;
        arguments.insert(arguments.begin(), brush);
        return applied(arguments);
    };
    const Json smoothed = applied({"smooth", "iterations=3"});
    check_figures(smoothed);
    CHECK(smoothed["change"]["moved_vertices"] > 0);
    CHECK(smoothed["report"]["local_error"]["largest_mm"] > 0.0);
    for (const char* brush : {"brush-smooth", "brush-inflate", "brush-weight"})
        check_figures(brushed(brush));
    check_figures(applied({"subdivide"}));
    const Json decimated = applied({"decimate"});
    check_figures(decimated);
    CHECK(decimated["report"]["shape_after"]["radius_ratio"]["min"] > 0.0);
}
