#include "meshing/remeshing/cell_estimate.h"

#include <numbers>

#include <catch2/catch.hpp>

#include "meshing/remeshing/local_radius.h"
#include "meshing/remeshing/remesh.h"
#include "meshing/tetrahedra/tetrahedralize.h"
#include "tests/support/shapes.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

/// Of radius 2, with usual triangles of 0.56 mm.
Surface vessel() {
    return closed_tube(2.0, 20.0, 48, 60);
}

double cells_in(const Surface& surface) {
    return static_cast<double>(tetrahedralized(surface, {}).report.quality.cells);
}

}  // namespace

SCENARIO("The cells that will fill a vessel are known from its edges", "[meshing][sizing]") {
    CHECK(kUsualGrowth == TetrahedralizeParameters{}.growth);
    const Surface tube = vessel();
    const std::vector<double> radii = local_radii(tube, nullptr);
    for (const double edge : {0.3, 0.5, 0.8}) {
        const Remeshed remeshed = remesh(tube, {.mode = RemeshMode::Uniform, .edge = edge});
        CHECK(expected_cells(tube, std::vector<double>(tube.vertex_count(), edge), radii) ==
              Approx(cells_in(remeshed.surface)).epsilon(0.1));
    }
}

SCENARIO("Edges become longer for a budget of cells", "[meshing][remesh]") {
    const Remeshed usual = remesh(vessel());
    WHEN("the usual edges need fewer") {
        const Remeshed remeshed = remesh(vessel(), {.cells = 1e5});
        CHECK(remeshed.surface.points() == usual.surface.points());
        CHECK(remeshed.report.cells == 0.0);
    }
    WHEN("they need more") {
        const Remeshed remeshed = remesh(vessel(), {.cells = 6000});
        CHECK(cells_in(usual.surface) > 9000);
        CHECK(cells_in(remeshed.surface) == Approx(6000).epsilon(0.15));
        CHECK(remeshed.report.cells == Approx(6000).epsilon(0.1));
        CHECK(remeshed.report.edge > usual.report.edge);
        THEN("the edge that was decided makes the same triangles when it is given") {
            const Remeshed again = remesh(vessel(), {.edge = remeshed.report.edge,
                                                     .min_edge = remeshed.report.min_edge,
                                                     .max_edge = remeshed.report.max_edge,
                                                     .cells = 6000});
            CHECK(again.surface.points() == remeshed.surface.points());
        }
    }
    WHEN("the budget is too small for the vessel's section") {
        const Remeshed remeshed = remesh(vessel(), {.cells = 1000});
        CHECK(2.0 * std::numbers::pi * remeshed.report.usual_radius / remeshed.report.edge ==
              Approx(12.0).epsilon(0.01));
        CHECK(remeshed.report.cells > 1000);
    }
    WHEN("an edge is given") {
        CHECK(remesh(vessel(), {.edge = 0.4, .cells = 1000}).report.edge == 0.4);
    }
}
