#include "geometry/vessel/openings/vessel_check.h"

#include <cmath>

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/vessel/centerlines/centerlines.h"
#include "tests/support/iso_surface.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;

namespace {

Surface wavy_sheet(int cells, double height) {
    Positions points;
    std::vector<Triangle> triangles;
    for (int i = 0; i <= cells; ++i)
        for (int j = 0; j <= cells; ++j) points.emplace_back(i, j, height * std::sin(0.3 * i));
    const auto id = [&](int i, int j) { return static_cast<VertexId>(i * (cells + 1) + j); };
    for (int i = 0; i < cells; ++i)
        for (int j = 0; j < cells; ++j) {
            triangles.push_back({id(i, j), id(i + 1, j), id(i, j + 1)});
            triangles.push_back({id(i + 1, j), id(i + 1, j + 1), id(i, j + 1)});
        }
    return make_surface(std::move(points), std::move(triangles));
}

/// The boundary of a sponge: loops in all directions.
Surface sponge() {
    const auto gyroid = [](const Vec3& p) {
        const double inside = std::sin(p.x()) * std::cos(p.y()) +
                              std::sin(p.y()) * std::cos(p.z()) + std::sin(p.z()) * std::cos(p.x());
        return std::max(inside, p.cwiseAbs().maxCoeff() - 15.0);
    };
    return iso_surface(gyroid, {Vec3::Constant(-16.0), Vec3::Constant(16.0)}, 0.8);
}

bool has_tube_in(const Surface& surface) {
    return has_tube(*centerlines_of(surface, {}, {}));
}

}  // namespace

SCENARIO("A sheet and noise have no lumen", "[geometry][openings]") {
    CHECK_THROWS_WITH(require_lumen(wavy_sheet(40, 0.0)),
                      Contains("no vessel") && Contains("sheet"));
    CHECK_THROWS_WITH(require_lumen(wavy_sheet(40, 0.2)), Contains("sheet"));
    CHECK_THROWS_WITH(require_lumen(sponge()), Contains("no vessel") && Contains("noise"));
    CHECK_THROWS_WITH(require_lumen(sponge(), SurfaceOrigin::Mask),
                      Contains("noise") && !Contains("threshold") && !Contains("add a mask"));
    CHECK_THROWS_WITH(require_lumen(sponge(), SurfaceOrigin::File), Contains("from its image"));
    CHECK_NOTHROW(require_lumen(open_tube(0.5, 200.0, 12, 300)));
    CHECK_NOTHROW(require_lumen(closed_tube(2.0, 30.0, 40, 90)));
    CHECK_NOTHROW(require_lumen(icosphere(5.0, 3)));
}

SCENARIO("What encloses more than a heart with its great vessels is no vessel",
         "[geometry][openings]") {
    const Surface body = icosphere(90.0, 3), heart = icosphere(60.0, 3);
    CHECK_THROWS_WITH(require_vessel_size(body),
                      Contains("no vessel") && Contains("3.0") && Contains("--mask"));
    CHECK_THROWS_WITH(require_vessel_size(body, SurfaceOrigin::Mask),
                      Contains("labels") && !Contains("--mask"));
    CHECK_THROWS_WITH(require_vessel_size(body, SurfaceOrigin::File), Contains("unit"));
    CHECK_NOTHROW(require_vessel_size(heart));
    CHECK_NOTHROW(require_vessel_size(open_tube(15.0, 1000.0, 40, 200)));
}

SCENARIO("A blob has no tube, a capsule has", "[geometry][openings]") {
    const Eigen::AlignedBox3d box(Vec3(-5, -5, -13), Vec3(5, 5, 13));
    const auto capsule_of = [&](double half) {
        return iso_surface(
            [&](const Vec3& p) { return capsule(p, Vec3(0, 0, -half), Vec3(0, 0, half), 3.0); },
            box, 0.6);
    };
    CHECK_FALSE(has_tube_in(icosphere(5.0, 4)));
    CHECK_FALSE(has_tube_in(capsule_of(1.0)));
    CHECK(has_tube_in(capsule_of(8.0)));
}
