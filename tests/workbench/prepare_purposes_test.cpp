// Models for treatment planning and for surgery simulation (thesis Table 2.1).

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/formats/surface_file.h"
#include "geometry/kernel/surface_distance.h"
#include "tests/support/paths.h"
#include "tests/support/program.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;
using Json = nlohmann::ordered_json;
using Names = std::vector<std::string>;

namespace {

ProgramRun run(const std::vector<std::string>& arguments) {
    return run_program(test::program_path(), arguments);
}

std::string text_of(const std::string& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// A built-in phantom as a case folder.
std::string phantom(const std::string& name) {
    const std::string folder = temporary_folder() + "/phantom-" + name;
    REQUIRE(run({"phantom", name, "--out", folder}).exit_code == 0);
    return folder;
}

/// Prepares and returns the report.
Json prepared(const std::string& input, const std::string& purpose, const std::string& out,
              const std::vector<std::string>& more = {}) {
    std::vector<std::string> words = {"prepare", input, "--for", purpose, "--out", out};
    words.insert(words.end(), more.begin(), more.end());
    const ProgramRun result = run(words);
    INFO(result.err);
    REQUIRE(result.exit_code == 0);
    return Json::parse(text_of(out + "/report.json"));
}

double least_distance(const Surface& a, const Surface& b) {
    double least = 1e9;
    for (const SurfacePoint& found : SurfaceDistance(b).closest_points(a.points()))
        least = std::min(least, found.distance);
    return least;
}

}  // namespace

SCENARIO("A phantom becomes a model for planning and one for surgery simulation",
         "[workbench][prepare]") {
    for (const std::string purpose : {"planning", "simulation"}) {
        CAPTURE(purpose);
        const std::string out = temporary_folder() + "/" + purpose;
        const ProgramRun result = run({"prepare", phantom("tube"), "--for", purpose, "--out", out});
        INFO(result.err);
        REQUIRE(result.exit_code == 0);
        CHECK(names_in(out) ==
              Names{"project.vbench", "report.html", "report.json", "surface.stl", "surface.vtp"});
        const Json report = Json::parse(text_of(out + "/report.json"));
        CHECK(report["purpose"] == purpose);
        const double skewness = report["quality"]["after"]["equiangle_skewness"]["mean"];
        CHECK((purpose == "planning") == (skewness > 0.2));  // only simulation asks for good ones
        CHECK_THAT(text_of(out + "/report.html"), Contains("Model for"));
    }
}

SCENARIO("A mask's model for simulation is smoother than the one for planning",
         "[workbench][prepare]") {
    const std::string mask = phantom("vessel") + "/mask.nii.gz";
    const auto figures = [&](const std::string& purpose) {
        return prepared(mask, purpose, temporary_folder() + "/mask-" + purpose)["quality"]["after"];
    };
    const Json planning = figures("planning"), simulation = figures("simulation");
    CAPTURE(planning.dump(), simulation.dump());
    // The absolute mean curvature beyond that of a convex wall, whatever the triangles' size.
    const auto roughness = [](const Json& quality) {
        const Json& curvature = quality["mean_curvature"];
        return curvature["integral_abs"].get<double>() / curvature["integral"].get<double>() - 1.0;
    };
    CHECK(roughness(simulation) < 0.2 * roughness(planning));
    CHECK(simulation["volume"].get<double>() ==
          Approx(planning["volume"].get<double>()).epsilon(0.01));
}

SCENARIO("A model for planning keeps its distance to a neighbour", "[workbench][prepare]") {
    const std::string folder = phantom("tumour"), out = temporary_folder() + "/planned";
    const std::string neighbour = folder + "/neighbour.vtp";
    const double exact = least_distance(read_surface(folder + "/exact.vtp").surface,
                                        read_surface(neighbour).surface);  // [mm]
    GIVEN("a mask") {
        const Json report =
            prepared(folder + "/mask.nii.gz", "planning", out, {"--neighbour", neighbour});
        THEN("the report says how near it comes, within a quarter of a voxel of the truth") {
            const double found = report["neighbours"]["neighbour"]["distance_mm"];
            CHECK(std::abs(found - exact) < 0.25 * 0.453);
            CHECK(report["neighbours"]["neighbour"]["place_mm"].size() == 3);
            CHECK_THAT(text_of(out + "/report.html"), Contains("<h2>Neighbours</h2>"));
        }
        THEN("--resume with the same neighbour makes no edit twice") {
            const auto edits = [&] {
                return Json::parse(run({"log", out + "/project.vbench", "--json"}).out)["edits"]
                    .size();
            };
            const std::size_t made = edits();
            prepared(folder + "/mask.nii.gz", "planning", out,
                     {"--neighbour", neighbour, "--resume"});
            CHECK(edits() == made);
        }
    }
    GIVEN("a mask whose staircases are smoothed") {
        const Json report =
            prepared(folder + "/mask.nii.gz", "planning", out,
                     {"--neighbour", neighbour, "--set", "extract-surface.mask_surface=midway"});
        THEN("smoothing is aware of the distance and keeps it") {
            const Json& steps = report["steps"];
            const auto smooth = std::ranges::find_if(
                steps, [](const Json& step) { return step["operation"] == "smooth"; });
            REQUIRE(smooth != steps.end());
            CHECK((*smooth)["resolved"]["distance"] == "linear");
            const Json& figures = (*smooth)["report"];
            CHECK(figures["smallest_neighbour_distance_after_mm"].get<double>() ==
                  Approx(figures["smallest_neighbour_distance_mm"].get<double>()).margin(1e-6));
        }
    }
}

SCENARIO("A label map's other labels are neighbours", "[workbench][prepare]") {
    const std::string mask = phantom("tumour") + "/mask.nii.gz";
    const std::string out = temporary_folder() + "/labelled";
    const Json report = prepared(mask, "planning", out, {"--neighbour", "1"});
    CHECK(report["neighbours"]["label-1"]["distance_mm"] == Approx(0.0).margin(0.05));  // itself
    THEN("a surface has none") {
        const ProgramRun result = run({"prepare", out + "/surface.stl", "--for", "planning",
                                       "--neighbour", "1", "--out", out + "-2"});
        CHECK(result.exit_code == 2);
        CHECK_THAT(result.err, Contains("labels need a label map"));
    }
    THEN("a file that does not exist is an error") {
        const ProgramRun result = run({"prepare", mask, "--for", "planning", "--neighbour",
                                       out + "/absent.stl", "--out", out + "-3"});
        CHECK(result.exit_code == 3);
        CHECK_THAT(result.err, Contains("the neighbour 'absent.stl' does not exist"));
        CHECK(names_in(out + "-3").empty());
    }
}
