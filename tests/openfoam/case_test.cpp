#include <algorithm>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "meshing/layers/layered_mesh.h"
#include "meshing/products/openfoam_case.h"
#include "meshing/tetrahedra/tetrahedralize.h"
#include "tests/support/commands.h"
#include "tests/support/shapes.h"

using namespace vesselbench;

namespace {

std::string text_of(const std::string& path) {
    std::ifstream file(path);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

// The last value of a function object's table: simpleFoam's mean pressure of the inlet.
double last_value(const std::string& path) {
    std::istringstream text(text_of(path));
    double value = 0.0;
    for (std::string line; std::getline(text, line);)
        if (!line.empty() && line[0] != '#') {
            double step = 0.0;
            std::istringstream(line) >> step >> value;
        }
    return value;
}

double number_after(const std::string& text, const std::string& words) {
    const auto at = text.find(words);
    return at == std::string::npos ? -1.0 : std::stod(text.substr(at + words.size()));
}

/// \param output of checkMesh, which measures the same mesh
void check_same_quality(const std::string& output, const VolumeQuality& quality) {
    CHECK(number_after(output, "Mesh non-orthogonality Max: ") ==
          Approx(quality.largest_non_orthogonality).epsilon(1e-3));
    CHECK(number_after(output, " average: ") ==
          Approx(quality.mean_non_orthogonality).epsilon(1e-3));
    CHECK(number_after(output, "Max skewness = ") ==
          Approx(quality.largest_skewness).epsilon(1e-3));
    CHECK(number_after(output, "Max aspect ratio = ") ==
          Approx(quality.largest_aspect_ratio).epsilon(1e-3));
    CHECK(number_after(output, "Total volume = ") == Approx(quality.volume * 1e-9).epsilon(1e-5));
}

}  // namespace

SCENARIO("the OpenFOAM case has what a solver needs", "[meshing][openfoam]") {
    const VolumeMesh mesh = tetrahedralized(test::fine_tube(2.0, 8.0, 18), {}).mesh;
    const std::string folder = test::temporary_folder() + "/case";
    write_openfoam_case(folder, mesh, {});
    THEN("patches and their types are listed") {
        const std::string boundary = text_of(folder + "/constant/polyMesh/boundary");
        CHECK(boundary.find("wall\n    {\n        type wall;") != std::string::npos);
        CHECK(boundary.find("inlet\n    {\n        type patch;") != std::string::npos);
        CHECK(boundary.find("outlet_1\n    {\n        type patch;") != std::string::npos);
    }
    THEN("the viscosity is kinematic and the outlet is safe against backflow") {
        CHECK(number_after(text_of(folder + "/constant/transportProperties"), "] ") ==
              Approx(4e-6));
        CHECK(text_of(folder + "/0/U").find("inletOutlet") != std::string::npos);
    }
    THEN("checkMesh is content, and finds our own figures") {
        const auto run = test::run_command("checkMesh", {"-case", folder});
        if (!run) return;
        CAPTURE(run->output);
        CHECK(run->output.find("Mesh OK") != std::string::npos);
        check_same_quality(run->output, volume_quality(mesh));
    }
    THEN("a second export replaces it") {
        CHECK_NOTHROW(write_openfoam_case(folder, mesh, {.flow = 2.0}));
    }
    THEN("a folder with something else in it is left alone") {
        const std::string other = test::temporary_folder();
        std::ofstream(other + "/letter.txt") << "dear";
        CHECK_THROWS_AS(write_openfoam_case(other, mesh, {}), IoError);
        CHECK_FALSE(std::filesystem::exists(other + "/0"));
    }
}

SCENARIO("checkMesh is content with wall layers, and finds our own figures",
         "[meshing][openfoam][layers]") {
    const Surface tube = test::fine_tube(2.0, 8.0, 24);
    const LayeredMesh layered = layered_mesh(tube, {}, {.layers = 4});
    const std::string folder = test::temporary_folder() + "/layers";
    write_openfoam_case(folder, layered.mesh, {});
    THEN("the inflow has a value for each triangle and quadrilateral of the inlet") {
        const std::string boundary = text_of(folder + "/constant/polyMesh/boundary");
        const auto faces =
            static_cast<int>(number_after(boundary.substr(boundary.find("inlet")), "nFaces "));
        CHECK(faces > std::count(tube.patch_labels->begin(), tube.patch_labels->end(), 1));
        CHECK(text_of(folder + "/0/U").find("List<vector>\n" + std::to_string(faces) + "\n") !=
              std::string::npos);
    }
    THEN("checkMesh agrees") {
        const auto run = test::run_command("checkMesh", {"-case", folder});
        if (!run) return;
        CAPTURE(run->output);
        CHECK(run->output.find("Mesh OK") != std::string::npos);
        CHECK(number_after(run->output, "    prisms:") ==
              static_cast<double>(layered.mesh.prisms.size()));
        check_same_quality(run->output, layered.report.quality);
    }
}

SCENARIO("simpleFoam finds Hagen and Poiseuille's pressure drop in a tube", "[meshing][openfoam]") {
    const double radius = 2.0, length = 12.0;
    const VolumeMesh mesh = tetrahedralized(test::fine_tube(radius, length, 30), {}).mesh;
    const std::string folder = test::temporary_folder() + "/tube";
    const CfdParameters parameters;
    write_openfoam_case(folder, mesh, parameters);
    const auto run = test::run_command("simpleFoam", {"-case", folder});
    if (!run) return;
    REQUIRE(run->exit_code == 0);
    CHECK(run->output.find("SIMPLE solution converged") != std::string::npos);
    const double pressure =
        last_value(folder + "/postProcessing/pressure_inlet/0/surfaceFieldValue.dat") *
        parameters.density;
    const double metres = 1e-3;
    const double exact = 8.0 * parameters.viscosity * length * metres * parameters.flow * 1e-6 /
                         (std::numbers::pi * std::pow(radius * metres, 4));
    CHECK(pressure == Approx(exact).epsilon(0.03));
    CHECK(last_value(folder + "/postProcessing/flow_outlet_1/0/surfaceFieldValue.dat") ==
          Approx(parameters.flow * 1e-6).epsilon(1e-3));
}
