#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/image/extract_surface.h"
#include "geometry/image/threshold.h"
#include "geometry/kernel/diagnosed_error.h"
#include "geometry/phantoms/imaging.h"
#include "tests/support/shapes.h"
#include "workbench/case/operation.h"
#include "workbench/operations/table.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Contains;

namespace {

const Operation& operation() {
    return find_operation("correct-narrowing");
}

Outcome corrected(const Scene& scene, const Arguments& arguments) {
    Progress progress;
    return operation().run(scene, checked_arguments(operation(), arguments), progress);
}

/// A tube of 2 mm radius along z whose radius is halved at z = 20.
Scene narrow_tube() {
    Scene scene;
    scene.surface = mapped(closed_tube(2.0, 40.0, 32, 160), [](const Vec3& p) {
        const double away = std::min(1.0, std::abs(p.z() - 20.0) / 5.0);
        const double width = 1.0 - 0.25 * (1.0 + std::cos(std::numbers::pi * away));
        return Vec3(width * p.x(), width * p.y(), p.z());
    });
    return scene;
}

/// An image of a tube of 2 mm radius, and its surface at one threshold.
Scene imaged_tube(bool stenosis) {
    VesselShape vessel;
    for (int i = 0; i <= 18; ++i) {
        vessel.points.push_back(Vec3(0.0, 0.0, 2.0 * i));
        const double away = std::abs(i - 9) / 3.0;
        vessel.radii.push_back(stenosis && away < 1.0 ? 2.0 - 0.8 * (1.0 - away * away) : 2.0);
    }
    PhantomDescription description;
    description.parts = {{"tube", vessel, 0.0}};
    description.imaging.spacing = Vec3::Constant(0.4);
    description.imaging.blur = Vec3::Constant(0.5);
    if (!stenosis)
        description.imaging.dips = {
            {.part = "tube", .centre = Vec3(0, 0, 18), .reach = 6.0, .core = 0.4, .wall = 0.75}};
    Scene scene;
    scene.image = phantom_image(description, PhantomField(description.parts));
    ExtractionParameters parameters{.method = ExtractionMethod::Threshold};
    parameters.threshold = bright_threshold(*scene.image);
    Extraction extraction = extract_surface(*scene.image, std::nullopt, parameters);
    scene.surface = std::move(extraction.surface);
    scene.sampling = extraction.sampling;
    return scene;
}

}  // namespace

SCENARIO("correct-narrowing widens the narrowing that the point is at, and stores what it decided",
         "[workbench][narrowing]") {
    const Scene scene = narrow_tube();
    const Outcome outcome = corrected(scene, {{"at", Vec3(0, 1, 19)}});
    CHECK(outcome.resolved.real("radius") == Approx(2.0).epsilon(0.01));
    CHECK(outcome.resolved.point("from").z() == Approx(16.0).margin(1.0));
    CHECK(outcome.resolved.point("to").z() == Approx(24.0).margin(1.0));
    CHECK(outcome.report->at("found_radius_mm").get<double>() == Approx(1.0).epsilon(0.04));
    CHECK(outcome.report->at("radius_mm").get<double>() == Approx(2.0).epsilon(0.03));
    CHECK(outcome.report->at("image").is_null());
    CHECK(outcome.warnings.empty());
    THEN("its decisions give the same bits") {
        CHECK(corrected(scene, outcome.resolved).scene.surface->points() ==
              outcome.scene.surface->points());
    }
    THEN("a form shows them before a run") {
        const Arguments decided = operation().decided(
            scene, checked_arguments(operation(), {{"at", Vec3(0, 1, 19)}}), {});
        CHECK(decided.values() == outcome.resolved.values());
    }
    THEN("there is nothing left to correct") {
        CHECK_THROWS_WITH(corrected(outcome.scene, {{"at", Vec3(0, 1, 19)}}),
                          Contains("not narrower"));
    }
}

SCENARIO("correct-narrowing names the nearest narrowing to a point without one",
         "[workbench][narrowing]") {
    CHECK_THROWS_WITH(corrected(narrow_tube(), {{"at", Vec3(0, 0, 8)}}),
                      Contains("not narrower") && Contains("at="));
    CHECK_THROWS_WITH(corrected(narrow_tube(), {{"at", Vec3(0, 0, 0)}}),
                      Contains("end of a vessel"));
    CHECK_THROWS_WITH(corrected(narrow_tube(), {{"at", Vec3(0, 0, 20)}, {"radius", 0.5}}),
                      Contains("does not widen"));
}

SCENARIO("correct-narrowing warns where the image agrees with the narrowing",
         "[workbench][narrowing]") {
    const Outcome artefact = corrected(imaged_tube(false), {{"at", Vec3(0, 0, 18)}});
    CHECK(artefact.report->at("image").at("verdict") == "contrast-falls");
    CHECK(artefact.warnings.empty());
    const Outcome stenosis = corrected(imaged_tube(true), {{"at", Vec3(0, 0, 18)}});
    CHECK(stenosis.report->at("image").at("verdict") == "image-agrees");
    REQUIRE(stenosis.warnings.size() == 1);
    CHECK(stenosis.warnings[0].code == "image-shows-narrowing");
}
