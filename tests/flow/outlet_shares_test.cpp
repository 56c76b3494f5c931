#include "workbench/flow/outlet_shares.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <catch2/catch.hpp>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/measure.h"
#include "geometry/vessel/centerlines/centerlines.h"
#include "geometry/vessel/openings/clip_openings.h"
#include "geometry/vessel/openings/openings.h"
#include "tests/support/forked_vessel.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

constexpr double kLeft = 1.5, kRight = 1.2;  // radii of the daughters [mm]

/// With the trunk's end as inlet, and two outlets.
Surface fork_with_openings() {
    const Surface open = forked_vessel(kLeft, kRight);
    return clip_openings(open, plan_openings(open, *centerlines_of(open))).surface;
}

/// The outlet on one side of the fork.
PatchMeasures outlet_at(const Surface& surface, double side) {
    const auto patches = measure_patches(surface);
    const auto found = std::ranges::find_if(patches, [&](const PatchMeasures& patch) {
        return patch.kind == PatchKind::Outlet && side * patch.centroid.x() > 0.0;
    });
    REQUIRE(found != patches.end());
    return *found;
}

/// With a further outlet where the surface is within a distance [mm] of a place.
Surface with_outlet_at(Surface surface, const Vec3& place, double reach) {
    PatchLabels labels = *surface.patch_labels;
    const auto row = static_cast<PatchLabels::value_type>(surface.patches.size());
    for (TriangleId t = 0; t < surface.triangle_count(); ++t) {
        const auto& [a, b, c] = surface.triangles()[t];
        const Vec3 middle = (surface.points()[a] + surface.points()[b] + surface.points()[c]) / 3.0;
        if ((middle - place).norm() < reach) labels[t] = row;
    }
    surface.patches.push_back({"sham", PatchKind::Outlet});
    surface.patch_labels = std::make_shared<const PatchLabels>(std::move(labels));
    return surface;
}

}  // namespace

SCENARIO("Outlets of a fork share its flow by the power of its daughters' diameters", "[flow]") {
    const Surface surface = fork_with_openings();
    const std::string left = outlet_at(surface, -1.0).name, right = outlet_at(surface, 1.0).name;
    CfdParameters flow{.outlets = OutletFlow::Bifurcations};
    for (const double exponent : {0.0, 2.0, 3.0}) {
        GIVEN("the exponent " + std::to_string(exponent)) {
            flow.outlet_exponent = exponent;
            const double ratio = std::pow(kLeft / kRight, exponent);
            const auto shares = with_outlet_shares(flow, surface).outlet_shares;
            REQUIRE(shares.size() == 2);
            CHECK(shares.at(left) / shares.at(right) == Approx(ratio).epsilon(0.05));
            CHECK(shares.at(left) + shares.at(right) == Approx(1.0));
        }
    }
    GIVEN("another rule") {
        THEN("no lines are looked for") {
            flow.outlets = OutletFlow::Area;
            CHECK(with_outlet_shares(flow, surface).outlet_shares.empty());
        }
    }
}

SCENARIO("An outlet in which no line ends is refused with its place", "[flow]") {
    const Surface surface = fork_with_openings();
    const auto lines = centerlines_of(surface);
    const auto refusal = [&](const Surface& with_sham) -> Diagnostic {
        try {
            static_cast<void>(
                shared_along(*lines, {.outlets = OutletFlow::Bifurcations}, with_sham));
        } catch (const DiagnosedFailure& error) {
            CHECK_THAT(error.what(), Catch::Matchers::Contains("sham"));
            return error.diagnostics().front();
        }
        return {.code = "none"};
    };
    GIVEN("an outlet in the wall of the trunk") {
        const Vec3 side(kForkTrunk, 0, -10);
        const Diagnostic found = refusal(with_outlet_at(surface, side, 0.8));
        CHECK(found.code == "outlet-without-line");
        CHECK(found.words.at("opening") == "sham");
        REQUIRE(found.place);
        CHECK((*found.place - side).norm() < 0.3);
    }
    GIVEN("a second outlet in the end of a vessel") {
        const Vec3 centre = outlet_at(surface, -1.0).centroid;
        const Diagnostic found =
            refusal(with_outlet_at(surface, centre + Vec3(0, 0.8 * kLeft, 0), kLeft));
        THEN("the line in that end is the first one's") {
            CHECK(found.code == "outlet-without-line");
        }
    }
    GIVEN("no further outlet") {
        THEN("nothing is refused") {
            CHECK(shared_along(*lines, {.outlets = OutletFlow::Bifurcations}, surface)
                      .outlet_shares.size() == 2);
        }
    }
}
