// What operations would decide for parameters that are left out is what they decide in a run.

#include <algorithm>

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "tests/support/image_shapes.h"
#include "tests/support/shapes.h"
#include "tests/workbench/test_operations.h"
#include "workbench/operations/table.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

/// A tube of 4 mm radius whose image had voxels of 0.4 x 0.4 x 1 mm.
Scene sampled_tube() {
    Scene scene;
    scene.surface = fine_tube(4.0, 30.0, 48);
    scene.sampling = Sampling{.spacing = Vec3(0.4, 0.4, 1.0), .confidence = 1.0};
    return scene;
}

Scene image_scene(const Image& image) {
    Scene scene;
    scene.image = image;
    return scene;
}

/// Labels 2 and 5, left and right of the middle.
Image two_labels() {
    return image_of({20, 20, 20}, Eigen::Matrix4d::Identity(), [](const Vec3& p) {
        return (p - Vec3(10, 10, 10)).norm() > 7 ? 0 : p.x() > 10 ? 5 : 2;
    });
}

Arguments decided(const std::string& name, const Scene& scene, const Arguments& given) {
    const Operation& operation = find_operation(name);
    REQUIRE(operation.decided != nullptr);
    return operation.decided(scene, checked_arguments(operation, given), {});
}

/// Checks that a run decides the same. \return what is decided
Arguments compared(const std::string& name, const Scene& scene, const Arguments& given) {
    const Arguments found = decided(name, scene, given);
    const Arguments resolved = run(name, scene, given).resolved;
    for (const auto& [parameter, value] : found.values()) {
        INFO(name << "." << parameter);
        REQUIRE(resolved.has(parameter));
        CHECK(to_text(resolved.values().at(parameter)) == to_text(value));
    }
    return found;
}

}  // namespace

SCENARIO("Edge lengths are known before remeshing", "[workbench][forms]") {
    const Arguments graded = compared("remesh", sampled_tube(), {});
    CHECK(graded.real("edge") == Approx(0.28 * 4.0).epsilon(0.03));
    CHECK(graded.real("max_edge") == Approx(2.0 * graded.real("edge")));
    CHECK_FALSE(compared("remesh", sampled_tube(), {{"mode", "uniform"}}).has("max_edge"));
    CHECK_FALSE(compared("remesh", sampled_tube(), {{"print_resolution", 0.1}}).has("edge"));
}

SCENARIO("What smoothing decides is known before", "[workbench][forms]") {
    const Arguments found =
        compared("smooth", sampled_tube(), {{"preset", "cfd"}, {"staircase", true}});
    CHECK(found.text("filter") == "laplace-hc");
    CHECK(found.integer("iterations") == 20);
    CHECK(found.real("tau_max") == Approx(1.0));
    CHECK(compared("smooth", sampled_tube(), {{"filter", "taubin"}}).has("mu"));
    CHECK_FALSE(compared("smooth", sampled_tube(), {}).has("tau_theta"));
    CHECK_THROWS_AS(decided("smooth", {}, {}), AlgorithmFailure);
}

SCENARIO("Other decisions are known before a run", "[workbench][forms]") {
    CHECK(compared("widen", sampled_tube(), {}).real("width") == Approx(0.2));
    CHECK(compared("decimate", sampled_tube(), {}).real("share") == Approx(0.5));
    CHECK_FALSE(decided("decimate", sampled_tube(), {{"max_error", 0.1}}).has("share"));
}

SCENARIO("The method of an extraction is known before", "[workbench][forms]") {
    const Scene ball = image_scene(ball_image(8.0, 30, Vec3(1, 1, 1)));
    CHECK(compared("extract-surface", ball, {{"threshold", "midway"}}).text("method") ==
          "threshold");
    CHECK(decided("extract-surface", ball, {}).text("threshold") == "local");
    const Arguments labels = compared("extract-surface", image_scene(two_labels()), {});
    CHECK(labels.text("method") == "labels");
    CHECK(labels.list("labels") == std::vector<double>{2, 5});
    CHECK_FALSE(labels.has("threshold"));
}
