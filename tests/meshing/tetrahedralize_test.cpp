#include "meshing/tetrahedra/tetrahedralize.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <catch2/catch.hpp>

#include "geometry/formats/surface_file.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "meshing/tetrahedra/tetgen_run.h"
#include "tests/support/shapes.h"

using namespace vesselbench;

namespace {

std::string failure_of(const Surface& surface) {
    try {
        (void)tetrahedralized(surface, {});
    } catch (const InvalidInput& error) {
        return error.what();
    }
    return {};
}

void check_sound(const TetrahedralizeResult& result, const Surface& surface) {
    const VolumeQuality& quality = result.report.quality;
    CHECK(quality.volume == Approx(volume(surface)).epsilon(1e-9));
    CHECK(quality.smallest_cell > 0.0);
    CHECK(result.mesh.boundary.size() == surface.triangle_count());
    for (std::size_t k = 0; k < surface.patches.size(); ++k)
        CHECK(std::count(result.mesh.boundary_patches.begin(), result.mesh.boundary_patches.end(),
                         k) ==
              std::count(surface.patch_labels->begin(), surface.patch_labels->end(), k));
}

void check_openfoam_limits(const VolumeQuality& quality) {
    CHECK(quality.largest_skewness < 2.0);
    CHECK(quality.largest_aspect_ratio < 20.0);
    CHECK(quality.mean_non_orthogonality < 25.0);
    CHECK(quality.faces_over_70_deg <= quality.faces / 5000);
}

}  // namespace

SCENARIO("closed surfaces are filled with well-shaped cells", "[meshing][tetrahedralize]") {
    GIVEN("a cube of twelve triangles") {
        const Surface cube = test::cube(2.0);
        const auto result = tetrahedralized(cube, {});
        THEN("volume and triangles are kept") {
            check_sound(result, cube);
        }
    }
    GIVEN("a sphere of radius 3 mm") {
        const Surface sphere = test::icosphere(3.0, 3);
        const auto result = tetrahedralized(sphere, {});
        THEN("nothing is lost and OpenFOAM's limits are met") {
            check_sound(result, sphere);
            check_openfoam_limits(result.report.quality);
        }
        THEN("improvement raised the smallest dihedral angle above 15 degrees") {
            CHECK(result.report.quality.smallest_dihedral > 15.0);
            CHECK(result.report.quality.smallest_dihedral > result.report.raw.smallest_dihedral);
        }
    }
    GIVEN("a turned, bent tube with inlet and outlet") {
        const Surface straight = test::fine_tube(2.0, 12.0, 24);
        const Surface bent = test::mapped(straight, [](const Vec3& p) {
            const double angle = p.z() / 12.0, r = 12.0 + p.x();
            return Vec3(test::skew_rotation() *
                        Vec3(r * std::cos(angle) - 12.0, p.y(), r * std::sin(angle)));
        });
        const auto result = tetrahedralized(bent, {});
        THEN("patches, volume and quality hold") {
            check_sound(result, bent);
            check_openfoam_limits(result.report.quality);
            CHECK(result.report.surface_kept);
        }
        THEN("every boundary triangle faces outward") {
            const Surface boundary = boundary_surface(result.mesh);
            CHECK(volume(boundary) == Approx(volume(bent)).epsilon(1e-9));
            CHECK(connectivity(*boundary.topology).closed);
        }
        THEN("the same input gives the same bits") {
            const auto again = tetrahedralized(bent, {});
            CHECK(again.mesh.tetrahedra == result.mesh.tetrahedra);
            CHECK(again.mesh.points == result.mesh.points);
        }
    }
    GIVEN("a surface with a vertex that no triangle uses") {
        const Surface cube = test::cube(1.0);
        Positions points = cube.points();
        points.emplace_back(0.5, 0.5, 0.5);
        const Surface loose =
            make_surface(points, {cube.triangles().begin(), cube.triangles().end()});
        THEN("the vertex is left out") {
            check_sound(tetrahedralized(loose, {}), loose);
        }
    }
}

SCENARIO("filling and improving report their progress", "[meshing][tetrahedralize]") {
    std::vector<double> reports;
    const Progress progress([&](double fraction, auto) { reports.push_back(fraction); }, {});
    const auto result =
        tetrahedralized(test::fine_tube(2.0, 10.0, 24), {.cells = 40000.0}, progress);
    REQUIRE(result.mesh.tetrahedra.size() > 20'000);
    const auto within = [&](double from, double to) {
        return std::ranges::count_if(reports, [&](double at) { return from < at && at < to; });
    };
    CHECK(within(0.1, 0.5) >= 2);    // in TetGen
    CHECK(within(0.5, 0.95) >= 10);  // in the improvement
    CHECK(std::ranges::is_sorted(reports));
}

SCENARIO("the number of cells follows the request", "[meshing][tetrahedralize]") {
    const Surface tube = test::fine_tube(2.0, 10.0, 24);
    for (const double cells : {5000.0, 12000.0, 40000.0, 120000.0}) {
        const auto result = tetrahedralized(tube, {.cells = cells});
        CAPTURE(cells, result.report.attempts);
        CHECK(result.report.attempts.size() == 1);
        CHECK(static_cast<double>(result.mesh.tetrahedra.size()) == Approx(cells).epsilon(0.2));
        check_openfoam_limits(result.report.quality);
        WHEN("the factor that was found is given instead, " + std::to_string(int(cells))) {
            const auto replay = tetrahedralized(tube, {.size = result.report.size});
            THEN("the mesh is the same") {
                CHECK(replay.mesh.tetrahedra == result.mesh.tetrahedra);
            }
        }
    }
}

SCENARIO("a number of cells that the surface does not allow is not tried again and again",
         "[meshing][tetrahedralize]") {
    const auto result = tetrahedralized(test::fine_tube(2.0, 10.0, 24), {.cells = 100.0});
    CAPTURE(result.report.attempts, result.report.warnings.size());
    CHECK(result.report.attempts.size() == 2);
    REQUIRE(result.report.warnings.size() == 1);
    CHECK(result.report.warnings[0].code == "cells-limited");
}

SCENARIO("surfaces that cannot be filled are refused with cause and place",
         "[meshing][tetrahedralize]") {
    GIVEN("an open tube") {
        const std::string text = failure_of(test::open_tube(2.0, 10.0, 12, 8));
        THEN("the text speaks of the gap") {
            CHECK(text.find("gap") != std::string::npos);
            CHECK(text.find("clip-opening") != std::string::npos);
        }
    }
    GIVEN("a coordinate that is no number") {
        Positions points = test::icosphere(1.0, 2).points();
        points[7].y() = std::numeric_limits<double>::quiet_NaN();
        const std::string text = failure_of(test::icosphere(1.0, 2).with_positions(points));
        THEN("the text says so") {
            CHECK(text.find("not a finite number") != std::string::npos);
        }
    }
    GIVEN("a sphere with a vertex pushed through the other side") {
        Positions points = test::icosphere(1.0, 2).points();
        points[0] *= -1.5;
        const std::string text = failure_of(test::icosphere(1.0, 2).with_positions(points));
        THEN("the text names an intersection and a place") {
            CHECK(text.find("intersect") != std::string::npos);
            CHECK(text.find("at (") != std::string::npos);
        }
    }
    GIVEN("a triangle that is there twice") {
        const Surface sphere = test::icosphere(1.0, 1);
        std::vector<Triangle> triangles(sphere.triangles().begin(), sphere.triangles().end());
        triangles.push_back(triangles[5]);
        THEN("the text says so") {
            CHECK(failure_of(make_surface(sphere.points(), triangles)).find("twice") !=
                  std::string::npos);
        }
    }
    GIVEN("an inside-out sphere") {
        const Surface sphere = test::icosphere(1.0, 2);
        const Surface turned = test::mapped(sphere, [](const Vec3& p) { return Vec3(-p); });
        THEN("the text says so") {
            CHECK(failure_of(turned).find("inward") != std::string::npos);
        }
    }
    GIVEN("nothing") {
        THEN("that is an error too") {
            CHECK(failure_of(make_surface({}, {})).find("no triangles") != std::string::npos);
        }
    }
}

SCENARIO("an error inside TetGen does not end the program", "[meshing][tetgen]") {
    GIVEN("two facets that cross, given to TetGen unchecked") {
        Positions points = test::icosphere(1.0, 2).points();
        points[0] *= -1.5;
        const Surface spoiled = test::icosphere(1.0, 2).with_positions(points);
        const TetgenResult result = run_tetgen(spoiled, "pYq1.2");
        THEN("the code and its meaning come back") {
            CHECK(result.error_code != 0);
            CHECK_FALSE(result.error.empty());
            CHECK(result.mesh.tetrahedra.empty());
        }
        THEN("the crossing facets can be named") {
            CHECK_FALSE(tetgen_intersecting_facets(spoiled).empty());
        }
    }
}

SCENARIO("a coarse real aneurysm is filled", "[meshing][tetrahedralize]") {
    const std::string path = test::shared_data("surfaces/vasp_small_aneurysm_fluidboundary.vtp");
    if (path.empty()) return;
    const Surface surface = read_surface(path, LengthUnit::Metre).surface;
    const auto result = tetrahedralized(surface, {});
    check_sound(result, surface);
}
