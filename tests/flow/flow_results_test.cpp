#include "workbench/flow/flow_results.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/formats/surface_file.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "meshing/tetrahedra/tetrahedralize.h"
#include "tests/flow/planted_flow.h"
#include "tests/support/program.h"
#include "tests/support/sac_on_tube.h"
#include "tests/support/shapes.h"
#include "workbench/flow/methods_text.h"
#include "workbench/flow/results_files.h"
#include "workbench/flow/results_json.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;

namespace fs = std::filesystem;

namespace {

constexpr double kRadius = 2.0, kLength = 8.0;  // [mm]

const VolumeMesh& tube_mesh() {
    static const VolumeMesh mesh = tetrahedralized(fine_tube(kRadius, kLength, 18), {}).mesh;
    return mesh;
}

/// A vessel along x with a sac; its rounded ends are its openings.
Surface sac_between_openings() {
    const Surface surface = sac_on_tube(0.3);
    PatchLabels labels;
    for (const auto& [a, b, c] : surface.triangles()) {
        const double x =
            (surface.points()[a].x() + surface.points()[b].x() + surface.points()[c].x()) / 3.0;
        labels.push_back(x < -9.0 ? 1 : x > 9.0 ? 2 : 0);
    }
    return surface.with_patches(
        labels,
        {{"wall", PatchKind::Wall}, {"inlet", PatchKind::Inlet}, {"outlet_1", PatchKind::Outlet}});
}

/// A wall shear stress [Pa] along +z: low in the first quarter, growing behind it.
double planted_shear(const Vec3& place) {
    return place.z() < 0.25 * kLength ? 0.2 : 1.0 + place.z();
}

/// A solved case with the planted stress, for blood of this density [kg/m^3].
std::string solved_case(double density, PlantedFlow flow = {}) {
    const std::string folder = temporary_folder() + "/case";
    write_case(folder, tube_mesh(), {.density = density});
    flow.wall_shear = [density](const Vec3& place) {
        return Vec3(0.0, 0.0, -planted_shear(place) / density);
    };
    plant_flow(folder, tube_mesh(), flow);
    return folder;
}

FlowResults results_in(const std::string& folder) {
    return read_flow_results(find_flow_case(folder));
}

/// The planted figures, from the mesh itself.
struct Expected {
    double area = 0.0, mean = 0.0, low = 0.0;
};

Expected expected() {
    Expected sums;
    const VolumeMesh& mesh = tube_mesh();
    for (std::size_t b = 0; b < mesh.boundary.size(); ++b) {
        if (mesh.boundary_patches[b] != 0) continue;
        const auto& [i, j, k] = mesh.boundary[b];
        const double area = triangle_area(mesh.points, mesh.boundary[b]);
        const double shear = planted_shear((mesh.points[i] + mesh.points[j] + mesh.points[k]) / 3);
        sums.area += area;
        sums.mean += area * shear;
        if (shear < kLowShear) sums.low += area;
    }
    sums.mean /= sums.area;
    return sums;
}

constexpr double kTolerance = 1e-6;

}  // namespace

SCENARIO("Planted fields give their own figures, without a solver", "[flow][results]") {
    const double density = GENERATE(1000.0, 1060.0);
    const FlowResults results = results_in(solved_case(density));
    const Expected planted = expected();
    THEN("wall shear stress is in Pa, and along the flow") {
        CHECK(results.shear.mean == Approx(planted.mean).epsilon(kTolerance));
        for (const Vec3& shear : results.wall.shear) REQUIRE(shear.z() > 0.0);
    }
    THEN("areas and the area of low shear are the mesh's") {
        CHECK(results.shear.area == Approx(planted.area).epsilon(kTolerance));
        CHECK(results.shear.low_area == Approx(planted.low).epsilon(kTolerance));
    }
    THEN("percentiles are of the area") {
        CHECK(results.shear.p1 == Approx(0.2).epsilon(kTolerance));
        // A quarter has 0.2 Pa; the median is where half of the tube's length has less.
        CHECK(results.shear.median == Approx(1.0 + 0.5 * kLength).epsilon(0.05));
        CHECK(results.shear.largest < 1.0 + kLength);
    }
    THEN("pressures and flows are those of the tables") {
        CHECK(results.pressure_drop == Approx(0.25 * density).epsilon(kTolerance));
        REQUIRE(results.openings.size() == 2);
        for (const OpeningFigures& opening : results.openings)
            CHECK(opening.flow == Approx(1.2).epsilon(kTolerance));
        CHECK(results.imbalance == Approx(0.0).margin(kTolerance));
        for (const double pressure : results.wall.pressure)
            REQUIRE(pressure == Approx(0.5 * density).epsilon(kTolerance));
    }
    THEN("the flow has settled") {
        CHECK(results.converged);
    }
}

SCENARIO("Beyond the ends that were made, the wall is not the vessel's own", "[flow][results]") {
    const std::string folder = solved_case(1000.0);
    constexpr double half_a_diameter = kRadius, cut = 7.0;
    write_flow_record(
        folder, tube_mesh(), {},
        {.ends = {{.centre = Vec3(0, 0, cut), .outward = Vec3(0, 0, 1), .diameter = 2 * kRadius}}});
    double area = 0.0;
    for (std::size_t b = 0; b < tube_mesh().boundary.size(); ++b) {
        const Triangle& triangle = tube_mesh().boundary[b];
        const bool own = std::ranges::all_of(triangle, [](VertexId v) {
            return tube_mesh().points[v].z() <= cut - half_a_diameter;
        });
        if (tube_mesh().boundary_patches[b] == 0 && own)
            area += triangle_area(tube_mesh().points, triangle);
    }
    const FlowResults results = results_in(folder);
    CHECK(results.shear.area == Approx(area).epsilon(kTolerance));
    CHECK(results.shear.largest < 1.0 + cut - half_a_diameter);
}

SCENARIO("A sac's wall and its parent's have figures of their own", "[flow][results]") {
    constexpr double density = 1000.0, neck = 2.2, still = 0.2, flushed = 2.0;
    const VolumeMesh mesh = tetrahedralized(sac_between_openings(), {}).mesh;
    const std::string folder = temporary_folder() + "/case";
    write_case(folder, mesh, {.density = density});
    const SacNeck marked{sac_dome(), {Vec3(0, 0, neck), Vec3::UnitZ()}};
    write_flow_record(folder, mesh, {.density = density}, {.neck = RecordedNeck{.neck = marked}});
    PlantedFlow flow;
    flow.wall_shear = [&](const Vec3& place) {
        return Vec3(-(place.z() > neck ? still : flushed) / density, 0.0, 0.0);
    };
    plant_flow(folder, mesh, flow);
    const FlowResults results = results_in(folder);
    REQUIRE(results.regions.size() == 2);
    const RegionShear &sac = results.regions[0], &parent = results.regions[1];
    CHECK(sac.region == "sac");
    CHECK(sac.shear.mean == Approx(still).epsilon(0.01));
    CHECK(sac.shear.area == Approx(sphere_above(neck).dome_area).epsilon(0.02));
    CHECK(sac.shear.low_area == Approx(sac.shear.area).epsilon(0.01));
    CHECK(parent.region == "parent");
    CHECK(parent.shear.mean == Approx(flushed).epsilon(0.02));
    const nlohmann::ordered_json figures = results_json(results)["figures"];
    CHECK(figures["sac_wall_shear_mean_pa"] == sac.shear.mean);
    CHECK(figures["parent_wall_shear_max_pa"] == parent.shear.largest);
}

SCENARIO("A marked neck is kept with the case; without its sac there are no regions",
         "[flow][results]") {
    const std::string folder = solved_case(1000.0);
    const SacNeck neck{Vec3(1, 2, 3), {Vec3(0.1, 0.2, 0.3), Vec3(0, 0, 1)}};
    write_flow_record(folder, tube_mesh(), {}, {.neck = RecordedNeck{.neck = neck, .reach = 1.5}});
    const auto kept = read_flow_record(folder).neck;
    REQUIRE(kept);
    CHECK(kept->neck.dome == neck.dome);
    CHECK(kept->neck.plane.point == neck.plane.point);
    CHECK(kept->neck.plane.normal == neck.plane.normal);
    CHECK(kept->reach == 1.5);
    REQUIRE(kept->inlet);
    const FlowResults results = results_in(folder);
    CHECK(results.regions.empty());
    CHECK(results.shear.mean > 0.0);
}

SCENARIO("What flows in and not out is the imbalance", "[flow][results]") {
    const FlowResults results = results_in(solved_case(1000.0, {.outflow = 1.188e-6}));
    CHECK(results.imbalance == Approx(0.01).epsilon(kTolerance));
}

SCENARIO("A flow that has not settled says so everywhere", "[flow][results]") {
    const FlowResults results =
        results_in(solved_case(1000.0, {.residual = [](int) { return 2e-3; }}));
    CHECK_FALSE(results.converged);
    CHECK_THAT(methods_text(results), Contains("NOT converged"));
    CHECK(results_json(results)["solution"]["converged"] == false);
}

SCENARIO("Figures are the same in another place and turned", "[flow][results]") {
    const Eigen::Matrix3d rotation = skew_rotation();
    VolumeMesh turned = tube_mesh();
    for (Vec3& point : turned.points) point = rotation * point + Vec3(30, -50, 80);
    const std::string folder = temporary_folder() + "/turned";
    write_case(folder, turned);
    plant_flow(folder, turned, {.wall_shear = [&](const Vec3& place) {
                   const Vec3 there = rotation.transpose() * (place - Vec3(30, -50, 80));
                   return Vec3(rotation * Vec3(0.0, 0.0, -planted_shear(there) / 1000.0));
               }});
    const FlowResults results = results_in(folder);
    CHECK(results.shear.mean == Approx(expected().mean).epsilon(1e-5));
    CHECK(results.shear.low_area == Approx(expected().low).epsilon(1e-5));
}

SCENARIO("The methods paragraph has the case's own numbers and references", "[flow][results]") {
    const FlowResults results = results_in(solved_case(1060.0));
    const std::string text = methods_text(results);
    for (const char* part :
         {"steady, laminar", "1060 kg/m^3", "0.004 Pa s", "1.2 ml/s", "after 60 iterations",
          "less than 0.2 % over 50 iterations", "no average over a cardiac cycle"})
        CHECK_THAT(text, Contains(part));
    CHECK_THAT(text, Contains(std::to_string(tube_mesh().tetrahedra.size()) + " cells"));
    for (std::size_t k = 1; k <= method_references(results).size(); ++k)
        CHECK_THAT(text, Contains("[" + std::to_string(k) + "]"));
}

SCENARIO("The wall's arrays can be read again", "[flow][results]") {
    const FlowResults results = results_in(solved_case(1000.0));
    const std::string folder = temporary_folder() + "/results";
    const WrittenResults written = write_flow_results(results, folder, {});
    for (const std::string& name : written.names) CHECK(fs::file_size(fs::path(folder) / name) > 0);
    const Surface wall = read_surface(folder + "/wall.vtp").surface;
    CHECK(wall.triangle_count() == results.wall.surface.triangle_count());
    REQUIRE(wall.attributes.contains(wall_arrays::kShear));
    const auto& shear = *wall.attributes.at(wall_arrays::kShear);
    for (std::size_t v = 0; v < wall.vertex_count(); ++v)
        if (const double z = wall.points()[v].z(); z > 0.5 * kLength && z < 0.9 * kLength)
            CHECK(shear[v] == Approx(1.0 + z).epsilon(0.05));
}

SCENARIO("Results of another mesh are refused", "[flow][results]") {
    const std::string folder = solved_case(1000.0);
    GIVEN("a case whose mesh was replaced") {
        const std::string other = temporary_folder() + "/other";
        write_case(other, tetrahedralized(fine_tube(kRadius, kLength, 24), {}).mesh);
        fs::remove_all(folder + "/constant/polyMesh");
        fs::copy(other + "/constant/polyMesh", folder + "/constant/polyMesh");
        CHECK_THROWS_WITH(results_in(folder), Contains("another mesh"));
    }
    GIVEN("fields of another mesh") {
        const std::string other = temporary_folder() + "/other";
        const VolumeMesh finer = tetrahedralized(fine_tube(kRadius, kLength, 24), {}).mesh;
        write_case(other, finer);
        plant_flow(other, finer, {});
        fs::remove_all(folder + "/60");
        fs::copy(other + "/60", folder + "/60");
        CHECK_THROWS_AS(results_in(folder), InvalidInput);
    }
    GIVEN("a preparation with the surface of another mesh") {
        const std::string prepared = temporary_folder() + "/prepared";
        fs::create_directories(prepared);
        fs::rename(folder, prepared + "/openfoam");
        write_surface(boundary_surface(tube_mesh()), prepared + "/surface.vtp");
        CHECK_NOTHROW(results_in(prepared));
        write_surface(fine_tube(kRadius, kLength, 24), prepared + "/surface.vtp");
        CHECK_THROWS_WITH(results_in(prepared), Contains("another mesh"));
    }
}

SCENARIO("A folder without results is refused in one line", "[flow][results]") {
    const std::string folder = solved_case(1000.0);
    CHECK_THROWS_WITH(results_in(folder + "/none"), Contains("there is no folder 'none'"));
    CHECK_THROWS_WITH(results_in(folder + "/0"), Contains("holds no OpenFOAM case"));
    SECTION("never run") {
        fs::remove_all(folder + "/60");
        CHECK_THROWS_WITH(results_in(folder), Contains("vesselbench run"));
    }
    SECTION("its last time was cut off") {
        std::ofstream(folder + "/60/U") << "FoamFile";
        CHECK_THROWS_WITH(results_in(folder), Contains("vesselbench run"));
    }
    SECTION("no tables") {
        fs::remove_all(folder + "/postProcessing");
        CHECK_THROWS_WITH(results_in(folder), Contains("postProcessing"));
    }
    SECTION("no wall shear stress") {
        fs::remove(folder + "/60/wallShearStress");
        CHECK_THROWS_WITH(results_in(folder), Contains("wallShearStress"));
    }
    SECTION("of an earlier version") {
        fs::remove(folder + "/flow.json");
        CHECK_THROWS_WITH(results_in(folder), Contains("export it again"));
    }
}
