#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/formats/image_file.h"
#include "geometry/image/extract_surface.h"
#include "geometry/kernel/errors.h"
#include "geometry/phantoms/imaging.h"
#include "smoothing/context/staircase_thresholds.h"
#include "tests/support/shapes.h"
#include "tests/support/stack_phantoms.h"
#include "tests/workbench/test_operations.h"
#include "workbench/phantoms/phantom_json.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

Scene extracted(const Image& image, ExtractionMethod method,
                std::optional<double> threshold = std::nullopt) {
    Extraction found = extract_surface(image, {}, {.method = method, .threshold = threshold});
    Scene scene;
    scene.surface = std::move(found.surface);
    scene.sampling = found.sampling;
    return scene;
}

/// An oblique tube of 12 voxels across and 40 long, or a ball, in voxels of a size.
PhantomDescription tube_in(const Vec3& spacing) {
    const double unit = spacing.x();
    PhantomDescription d;
    d.parts = {
        {"tube",
         VesselShape{{Vec3(-9, -3, -16) * unit, Vec3(9, 4, 16) * unit}, {6 * unit, 6 * unit}},
         0.0}};
    d.imaging.spacing = spacing;
    return d;
}

Scene mask_of(const PhantomDescription& d) {
    return extracted(phantom_mask(d, PhantomField(d.parts)), ExtractionMethod::Labels);
}

/// At a fraction of the contrast [-]: the lower it is, the more do thick slices show as steps.
Scene intensities_of(const PhantomDescription& d, double fraction) {
    const double threshold = d.imaging.outside + fraction * (d.imaging.inside - d.imaging.outside);
    return extracted(phantom_image(d, PhantomField(d.parts)), ExtractionMethod::Threshold,
                     threshold);
}

Outcome smooth(const Scene& scene, const Arguments& more) {
    Arguments arguments = more;
    arguments.set("staircase", true);
    return run("smooth", scene, arguments);
}

double staircase_share(const Scene& scene, const Outcome& outcome) {
    return outcome.report->at("staircase_vertices").get<double>() /
           static_cast<double>(scene.surface->vertex_count());
}

std::string decisions(const Outcome& outcome) {
    std::string text;
    for (const char* key : {"stack_axis_decided", "tau_theta_decided", "tau_max_decided"})
        text += outcome.report->value(key, "") + "\n";
    return text;
}

}  // namespace

SCENARIO("smooth finds the staircases of masks whatever their voxels", "[workbench][sampling]") {
    const Vec3 spacing =
        GENERATE(Vec3(0.3, 0.3, 0.6), Vec3(3, 3, 6), Vec3(0.5, 0.5, 0.8), Vec3(0.7, 0.7, 3.5));
    const Scene scene = mask_of(tube_in(spacing));
    const Outcome outcome = smooth(scene, {});
    CAPTURE(spacing.transpose(), outcome.report->dump());
    CHECK(staircase_share(scene, outcome) > 0.1);
    CHECK(outcome.report->at("stack_axis_from") == "image");
    CHECK(outcome.resolved.real("tau_max") == Approx(spacing.z()));
    CHECK(moved_vertices(*scene.surface, *outcome.scene.surface) >
          scene.surface->vertex_count() / 4);
    CHECK_THAT(decisions(outcome), Catch::Contains("a step of one voxel") &&
                                       Catch::Contains("the distance of the slices"));
    THEN("the values recorded repeat the result") {
        const Outcome again = run("smooth", scene, outcome.resolved);
        CHECK(again.scene.surface->points() == outcome.scene.surface->points());
        CHECK(again.resolved == outcome.resolved);
    }
    THEN("the user's own values override") {
        const Outcome sharp = smooth(scene, {{"tau_theta", 0.85}, {"tau_max", 0.2}});
        CHECK(sharp.resolved.real("tau_theta") == 0.85);
        CHECK(sharp.resolved.real("tau_max") == 0.2);
        CHECK(staircase_share(scene, sharp) < staircase_share(scene, outcome));
    }
}

SCENARIO("A mask of slices twice as thick as voxels has no staircase for the thesis's tau_theta",
         "[workbench][sampling]") {
    const Scene scene = mask_of(tube_in(Vec3(0.3, 0.3, 0.6)));
    const Outcome thesis = smooth(scene, {{"tau_theta", 0.7}, {"tau_max", 3.0}});
    CHECK(staircase_share(scene, thesis) < 0.001);
    THEN("smooth says so, also where beta_min moves everything alike") {
        const double beta_min = GENERATE(0.0, 0.2);
        const Outcome outcome =
            smooth(scene, {{"tau_theta", 0.7}, {"tau_max", 3.0}, {"beta_min", beta_min}});
        REQUIRE(outcome.warnings.size() == 1);
        CHECK(outcome.warnings.front().figures.at("tau_theta") == 0.7);
        const std::string code = outcome.warnings.front().code;
        CHECK((code == "hardly-any-staircases" || code == "nothing-moved"));
        CHECK(smooth(scene, {{"beta_min", beta_min}}).warnings.empty());
    }
}

SCENARIO("Interpolated intensities have staircases where slices are thick",
         "[workbench][sampling]") {
    const Scene thick = intensities_of(tube_in(Vec3(0.5, 0.5, 2.5)), 0.25);
    const Outcome outcome = smooth(thick, {{"preset", "cfd"}});
    CAPTURE(outcome.report->dump());
    CHECK(outcome.resolved.real("tau_theta") < step_change(2.5, 0.5));
    CHECK(outcome.resolved.real("tau_max") == Approx(2.5));
    CHECK(staircase_share(thick, outcome) > 0.01);
    CHECK(outcome.warnings.empty());
    THEN("where a step bends no more than a thin vessel does, smooth says that it finds none") {
        const Scene thin = intensities_of(tube_in(Vec3(0.5, 0.5, 0.85)), 0.5);  // 1.7 as vmtk_aorta
        const Outcome plain = smooth(thin, {{"preset", "cfd"}});
        CAPTURE(plain.report->dump());
        CHECK(plain.resolved.real("tau_theta") > step_change(0.85, 0.5));
        CHECK_THAT(decisions(plain), Catch::Contains("thin vessel"));
        REQUIRE(plain.warnings.size() == 1);
        CHECK(plain.warnings.front().code == "hardly-any-staircases");
        CHECK(moved_vertices(*thin.surface, *plain.scene.surface) > 0);
    }
}

SCENARIO("What blur leaves of a step is found on a surface that is smooth otherwise",
         "[workbench][sampling]") {
    // The sphere of thesis Table 5.5, without its noise: a chord is missing in two slices.
    PhantomDescription sphere = builtin_phantom("sphere-missing-slices");
    const bool notched = GENERATE(true, false);
    CAPTURE(notched);
    if (!notched) sphere.imaging.deletions.clear();
    const Scene scene = intensities_of(sphere, 0.5);
    const Outcome outcome = smooth(scene, {{"filter", std::string("laplace")}});
    CAPTURE(outcome.report->dump());
    const std::size_t found = outcome.report->at("staircase_vertices").get<std::size_t>();
    if (!notched) {
        CHECK(found == 0);
        return;
    }
    CHECK(found > 20);
    CHECK_THAT(decisions(outcome), Catch::Contains("blur leaves of a step"));
    THEN("all of them lie in the two slices and beside them") {
        const Outcome kept = smooth(scene, {{"keep_weights", true}});
        const auto& flags = *kept.scene.surface->attributes.at("staircase");
        for (std::size_t v = 0; v < flags.size(); ++v)
            if (flags[v] > 0.0) CHECK(std::abs(kept.scene.surface->points()[v].z()) < 9.0);
    }
}

SCENARIO("smooth reads the voxels from the triangles where the image is gone",
         "[workbench][sampling]") {
    const Vec3 spacing = GENERATE(Vec3(0.3, 0.3, 0.6), Vec3(3, 3, 6), Vec3(0.8, 0.8, 0.8));
    const Scene known = mask_of(tube_in(spacing));
    Scene lost;
    lost.surface = turned(*known.surface, skew_rotation());
    const Outcome from_image = smooth(known, {}), from_triangles = smooth(lost, {});
    CAPTURE(from_triangles.report->dump());
    CHECK(from_triangles.report->at("stack_axis_from") == "estimate");
    for (const char* name : {"tau_theta", "tau_max"})
        CHECK(from_triangles.resolved.real(name) ==
              Approx(from_image.resolved.real(name)).epsilon(0.01));
    CHECK(staircase_share(lost, from_triangles) ==
          Approx(staircase_share(known, from_image)).epsilon(0.1));
    const Outcome again = run("smooth", lost, from_triangles.resolved);
    CHECK(again.scene.surface->points() == from_triangles.scene.surface->points());
}

SCENARIO("Masks of nearly cubic voxels have steps across all axes", "[workbench][sampling]") {
    const auto axis_of = [](const Outcome& outcome) {
        return to_text(outcome.resolved.values().at("stack_axis"));
    };
    const Scene cubic = mask_of(tube_in(Vec3(0.5, 0.5, 0.59)));
    const Outcome outcome = smooth(cubic, {});
    CHECK(axis_of(outcome) == "all");
    CHECK_THAT(decisions(outcome), Catch::Contains("nearly cubes"));
    const Outcome across_z = smooth(
        cubic, {{"stack_axis", Vec3(0, 0, 1)}, {"tau_theta", outcome.resolved.real("tau_theta")}});
    CHECK(staircase_share(cubic, outcome) > 1.2 * staircase_share(cubic, across_z));
    CHECK(axis_of(smooth(mask_of(tube_in(Vec3(0.5, 0.5, 0.61))), {})) == "0,0,1");
    THEN("interpolated intensities, which have none, are smoothed across the slices") {
        const Scene smooth_scene = intensities_of(tube_in(Vec3(0.5, 0.5, 0.5)), 0.5);
        CHECK(axis_of(smooth(smooth_scene, {})) == "0,0,1");
    }
    THEN("the user may ask for all axes of any image, or for one") {
        const Scene sliced = mask_of(tube_in(Vec3(0.3, 0.3, 0.6)));
        const Outcome all = smooth(sliced, {{"stack_axis", std::string("all")}});
        CHECK(all.report->at("stack_axis") == "all");
        CHECK(staircase_share(sliced, all) > staircase_share(sliced, smooth(sliced, {})));
        CHECK(axis_of(across_z) == "0,0,1");
    }
    THEN("all axes of a surface that shows no voxels are refused") {
        CHECK_THROWS_WITH(run("smooth", icosphere(5.0, 4),
                              {{"staircase", true}, {"stack_axis", std::string("all")}}),
                          Catch::Contains("axes of the voxels"));
    }
}

SCENARIO("Real label maps get thresholds from their sampling", "[workbench][sampling]") {
    const auto [name, labels] = GENERATE(
        table<std::string, std::vector<int>>({{"images/topcow_mr_roi_003_labels.nii.gz", {}},
                                              {"images/totalseg_example_labels_117.nii.gz", {5}}}));
    const std::string file = shared_data(name);
    if (file.empty()) return;
    const Image image = read_image(file);
    ExtractionParameters how{.method = ExtractionMethod::Labels};
    how.labels = labels;
    Extraction found = extract_surface(image, {}, how);
    Scene scene;
    scene.surface = std::move(found.surface);
    scene.sampling = found.sampling;
    const Outcome outcome = smooth(scene, {{"iterations", std::int64_t{1}}});
    CAPTURE(name, outcome.report->dump());
    CHECK(staircase_share(scene, outcome) > 0.1);
    CHECK(outcome.warnings.empty());
}

SCENARIO("Weights of staircases and neighbours are multiplied or averaged",
         "[workbench][sampling]") {
    Scene scene = mask_of(tube_in(Vec3(0.3, 0.3, 0.6)));
    scene.neighbours["bone"] = icosphere(1.0, 3, Vec3(3.2, 0, 0));
    const Outcome multiplied = smooth(scene, {{"distance", "linear"}, {"caps", "smooth"}}),
                  averaged = smooth(
                      scene, {{"distance", "linear"}, {"caps", "smooth"}, {"combine", "average"}});
    const auto figure = [](const Outcome& outcome, const char* name) {
        return outcome.report->at(name).get<double>();
    };
    CHECK(figure(averaged, "mean_weight") ==
          Approx(0.5 * (figure(averaged, "mean_weight_staircase") +
                        figure(averaged, "mean_weight_distance"))));
    CHECK(figure(multiplied, "mean_weight") < figure(averaged, "mean_weight"));
    const Outcome again = run("smooth", scene, averaged.resolved);
    CHECK(again.scene.surface->points() == averaged.scene.surface->points());
}

SCENARIO("The preset for planning keeps distances where neighbours are loaded",
         "[workbench][sampling]") {
    Scene scene;
    scene.surface = icosphere(5.0, 3);
    const auto distance_of = [&](const Arguments& arguments) {
        return run("smooth", scene, arguments).resolved.text("distance");
    };
    CHECK(distance_of({{"preset", "planning"}}) == "none");
    scene.neighbours["bone"] = icosphere(1.0, 2, Vec3(8, 0, 0));
    CHECK(distance_of({{"preset", "planning"}}) == "linear");
    CHECK(distance_of({{"preset", "planning"}, {"distance", "none"}}) == "none");
    CHECK(distance_of({{"preset", "planning"}, {"distance", "margin"}}) == "margin");
    CHECK(distance_of({{"preset", "cfd"}}) == "none");
    CHECK(distance_of({}) == "none");
}
