#include "meshing/products/inflow.h"

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "meshing/products/cfd_parameters.h"
#include "tests/support/shapes.h"

using namespace vesselbench;

namespace {

std::vector<Triangle> triangles_of(const Surface& surface, std::uint16_t patch) {
    std::vector<Triangle> triangles;
    for (TriangleId t = 0; t < surface.triangle_count(); ++t)
        if ((*surface.patch_labels)[t] == patch) triangles.push_back(surface.triangles()[t]);
    return triangles;
}

}  // namespace

SCENARIO("the developed profile is the parabola on a circle", "[meshing][inflow]") {
    const Surface tube = test::fine_tube(2.0, 6.0, 36);
    const auto cap = triangles_of(tube, 1);
    const auto profile = developed_profile(tube.points(), cap);
    double flux = 0.0, area = 0.0;
    for (std::size_t t = 0; t < cap.size(); ++t) {
        const double part = 0.5 * area_normal(tube.points(), cap[t]).norm();
        const Vec3 centre =
            (tube.points()[cap[t][0]] + tube.points()[cap[t][1]] + tube.points()[cap[t][2]]) / 3.0;
        flux += part * profile[t];
        area += part;
        CHECK(profile[t] == Approx(2.0 * (1.0 - centre.squaredNorm() / 4.0)).margin(0.04));
    }
    CHECK(flux == Approx(area));
}

SCENARIO("a coarse fan still gets the parabola", "[meshing][inflow]") {
    const Surface tube = test::closed_tube(1.0, 3.0, 24, 5);
    const auto profile = developed_profile(tube.points(), triangles_of(tube, 1));
    for (const double u : profile) CHECK(u == Approx(1.0).epsilon(1e-6));  // all slices are alike
}

SCENARIO("Several inlets share the flow by area, or as given", "[meshing][inflow]") {
    const Surface tube = test::fine_tube(2.0, 8.0, 60);
    const Surface two = tube.with_patches(
        *tube.patch_labels,
        {{"wall", PatchKind::Wall}, {"a", PatchKind::Inlet}, {"b", PatchKind::Inlet}});
    CHECK_THROWS_AS(flow_summary(two, {}), AlgorithmFailure);  // no outlet
    // A third patch: one triangle of the wall.
    PatchLabels labels = *tube.patch_labels;
    *std::ranges::find(labels, 0) = 3;
    const Surface three = tube.with_patches(std::move(labels), {{"wall", PatchKind::Wall},
                                                                {"a", PatchKind::Inlet},
                                                                {"b", PatchKind::Inlet},
                                                                {"c", PatchKind::Outlet}});
    THEN("of equal areas, each carries half") {
        const FlowSummary summary = flow_summary(three, {.flow = 3.0});
        REQUIRE(summary.inlets.size() == 2);
        CHECK(summary.inlets[0].flow == Approx(1.5));
        CHECK(summary.inlets[1].mean_velocity == Approx(1.5 / summary.inlets[1].area));
    }
    THEN("by the cubes of the diameters, a wide inlet carries more than by area") {
        PatchLabels unequal = *three.patch_labels;
        *std::ranges::find(unequal, 2) = 3;
        const Surface narrower = three.with_patches(std::move(unequal), three.patches);
        const FlowSummary by_area = flow_summary(narrower, {.flow = 3.0});
        const FlowSummary summary =
            flow_summary(narrower, {.flow = 3.0, .split = FlowSplit::Cubes});
        const auto &a = summary.inlets[0], &b = summary.inlets[1];
        CHECK(a.flow + b.flow == Approx(3.0));
        CHECK(a.flow / b.flow == Approx(std::pow(a.area / b.area, 1.5)));
        CHECK(by_area.inlets[0].flow / by_area.inlets[1].flow == Approx(a.area / b.area));
    }
    THEN("flows that are given by name count") {
        const FlowSummary summary = flow_summary(three, {.inlet_flows = {{"b", 2.0}, {"a", 0.5}}});
        CHECK(summary.inlets[0].flow == 0.5);
        CHECK(summary.inlets[1].flow == 2.0);
    }
    THEN("each inlet has to be named once") {
        CHECK_THROWS_AS(flow_summary(three, {.inlet_flows = {{"a", 2.0}}}), InvalidInput);
        CHECK_THROWS_AS(flow_summary(three, {.inlet_flows = {{"a", 2.0}, {"a", 1.0}}}),
                        InvalidInput);
        CHECK_THROWS_AS(flow_summary(three, {.inlet_flows = {{"a", 2.0}, {"c", 1.0}}}),
                        InvalidInput);
    }
}

SCENARIO("Outlets share the flow as they are told to", "[meshing][inflow]") {
    const Surface tube = test::closed_tube(2.0, 8.0, 24, 8);
    PatchLabels labels = *tube.patch_labels;  // the outlet's disc in parts of 8 and 16 triangles
    int left = 8;
    for (std::uint16_t& label : labels)
        if (label == 2 && left-- > 0) label = 3;
    const Surface forked = tube.with_patches(std::move(labels), {{"wall", PatchKind::Wall},
                                                                 {"in", PatchKind::Inlet},
                                                                 {"wide", PatchKind::Outlet},
                                                                 {"narrow", PatchKind::Outlet}});
    THEN("one pressure at all of them gives none of them a flow") {
        CHECK(flow_summary(forked, {}).outflows.empty());
    }
    THEN("the largest takes what the others leave") {
        const FlowSummary by_area =
            flow_summary(forked, {.flow = 3.0, .outlets = OutletFlow::Area});
        REQUIRE(by_area.outflows.size() == 1);
        CHECK(by_area.outflows[0].name == "narrow");
        CHECK(by_area.outflows[0].flow == Approx(1.0));
        const FlowSummary murray =
            flow_summary(forked, {.flow = 3.0, .outlets = OutletFlow::Cubes});
        CHECK(murray.outflows[0].flow == Approx(3.0 / (1.0 + std::pow(2.0, 1.5))));
    }
    THEN("shares along the centerlines are given by name, and known only where they were found") {
        CfdParameters flow{.flow = 3.0, .outlets = OutletFlow::Bifurcations};
        CHECK(flow_summary(forked, flow).outflows.empty());
        flow.outlet_shares = {{"wide", 0.2}, {"narrow", 0.8}};
        const FlowSummary given = flow_summary(forked, flow);
        REQUIRE(given.outflows.size() == 1);
        CHECK(given.outflows[0].name == "wide");
        CHECK(given.outflows[0].flow == Approx(0.6));
        flow.outlet_shares.erase("narrow");
        CHECK_THROWS_AS(flow_summary(forked, flow), InvalidInput);
    }
}

SCENARIO("Reynolds number and warnings", "[meshing][inflow]") {
    const Surface tube = test::fine_tube(2.0, 8.0, 60);
    GIVEN("the thesis' flow of 1.2 cm^3/s") {
        const FlowSummary summary = flow_summary(tube, {});
        THEN("Re = 4 Q rho / (pi D mu)") {
            REQUIRE(summary.inlets.size() == 1);
            CHECK(summary.inlets[0].reynolds == Approx(95.5).epsilon(0.01));
            CHECK(summary.outlets == 1);
            CHECK(summary.warnings.empty());
        }
    }
    GIVEN("Carreau's blood") {
        const CfdParameters blood{.viscosity_model = ViscosityModel::Carreau};
        THEN("it is that of high shear rates") {
            CHECK(flow_summary(tube, blood).inlets[0].reynolds ==
                  Approx(flow_summary(tube, {}).inlets[0].reynolds * 4e-3 / 0.00345));
        }
    }
    GIVEN("thirty times that flow, in a bend") {
        const FlowSummary summary = flow_summary(tube, {.flow = 36.0}, {{"inlet", 40.0}});
        THEN("both are warned of") {
            REQUIRE(summary.warnings.size() == 2);
            CHECK(summary.warnings[0].code == "flow-not-laminar");
            CHECK(summary.warnings[1].figures.at("turn_deg") == 40.0);
        }
    }
    GIVEN("a closed sphere without openings") {
        THEN("that is an error") {
            CHECK_THROWS_AS(flow_summary(test::icosphere(1.0, 1), {}), AlgorithmFailure);
        }
    }
    GIVEN("a viscosity of zero") {
        THEN("that is an error") {
            CHECK_THROWS_AS(flow_summary(tube, {.viscosity = 0.0}), InvalidInput);
        }
    }
}
