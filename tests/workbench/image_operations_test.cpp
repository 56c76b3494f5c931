#include <filesystem>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/formats/image_file.h"
#include "geometry/image/threshold.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "geometry/phantoms/phantom.h"
#include "geometry/vessel/centerlines/centerlines.h"
#include "tests/support/image_shapes.h"
#include "tests/support/shapes.h"
#include "workbench/case/diagnostic_words.h"
#include "workbench/case/operation.h"
#include "workbench/operations/table.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;

namespace {

Outcome run(const std::string& name, const Scene& scene, const Arguments& arguments) {
    Progress progress;
    const Operation& operation = find_operation(name);
    return run_here(operation, scene, checked_arguments(operation, arguments), progress);
}

std::string written(const Image& image, const std::string& name) {
    const std::string path = temporary_folder() + "/" + name;
    write_image(path, image);
    return path;
}

Image signed_ball() {
    Image grid = ball_image(8.0, 30, Vec3(0.8, 0.8, 1.0));
    const Vec3 middle = middle_of(grid);
    return image_of(grid.size, grid.index_to_patient, [&](const Vec3& p) {
        return std::clamp((p - middle).norm() - 8.0, -2.5, 2.5);
    });
}

}  // namespace

SCENARIO("load-image reports its findings and decisions", "[workbench][images]") {
    const Image ball = ball_image(8.0, 30, Vec3(0.8, 0.8, 1.0), true);
    const std::string path = written(ball, "ball.nii.gz");
    GIVEN("an image alone") {
        const Outcome outcome = run("load-image", {}, {{"file", path}});
        THEN("geometry and values are reported, without folders") {
            const auto& report = *outcome.report;
            CHECK(report.at("format") == "NIfTI");
            CHECK(report.at("left_handed") == true);
            CHECK(report.at("kind") == "intensity");
            CHECK(report.at("size_voxels") == nlohmann::json({30, 30, 30}));
            CHECK(report.dump().find(path) == std::string::npos);
            CHECK(outcome.resolved.text("units") == "mm");
            CHECK(outcome.scene.image->size == ball.size);
        }
    }
    GIVEN("a level set as mask") {
        const std::string mask = written(signed_ball(), "levelset.mha");
        Image grid = signed_ball();
        const std::string image = written(ball_image(8.0, 30, Vec3(0.8, 0.8, 1.0)), "same.mha");
        THEN("its inside is taken, and the decision is stored") {
            const Outcome outcome = run("load-image", {}, {{"file", image}, {"mask", mask}});
            CHECK(outcome.resolved.real("mask_iso") == 0.0);
            CHECK(outcome.resolved.text("mask_inside") == "below");
            CHECK(outcome.report->at("mask_labels") == nlohmann::json({1}));
            const Outcome again = run("load-image", {}, outcome.resolved);
            CHECK(*again.scene.mask->voxels == *outcome.scene.mask->voxels);
        }
        THEN("the user may say the side") {
            const Outcome outcome =
                run("load-image", {},
                    {{"file", image}, {"mask", mask}, {"mask_iso", 1.0}, {"mask_inside", "above"}});
            CHECK(outcome.scene.mask->at(0, 0, 0) == 1.0f);
        }
        THEN("a mask in another place is refused") {
            CHECK_THROWS_WITH(run("load-image", {}, {{"file", path}, {"mask", mask}}),
                              Contains("beside the image") && Contains("3D Slicer"));
        }
    }
    GIVEN("masks on other grids") {
        const Image whole = ball_image(8.0, 30, Vec3(0.8, 0.8, 1.0));
        const std::string image = written(whole, "whole.nrrd");
        const auto loaded = [&](const Image& mask) {
            const std::string file = written(mask_of_iso(mask, 50.0, false), "mask.nrrd");
            return run("load-image", {}, {{"file", image}, {"mask", file}});
        };
        const auto same = loaded(whole).scene.mask->voxels;
        THEN("a smaller one of the same lattice is taken as it is") {
            Image part = whole;
            part.size[2] = 29;
            part.voxels = std::make_shared<const std::vector<float>>(
                whole.voxels->begin(), whole.voxels->begin() + 30 * 30 * 29);
            const Outcome outcome = loaded(part);
            CHECK(outcome.report->at("mask_grid") == "part of the image's lattice");
            CHECK(outcome.warnings.empty());
            CHECK(*outcome.scene.mask->voxels == *same);
        }
        THEN("one of another lattice is resampled, which a warning says") {
            Image moved = whole;
            moved.index_to_patient.topRightCorner<3, 1>() += Vec3(0.3, 0.3, 0.3);
            const Outcome outcome = loaded(moved);
            CHECK(outcome.report->at("mask_grid") == "resampled");
            REQUIRE(outcome.warnings.size() == 1);
            CHECK(outcome.warnings[0].code == "mask-resampled");
            CHECK_THAT(worded(outcome.warnings[0]),
                       Contains("30 x 30 x 30") && Contains("3D Slicer"));
        }
        THEN("what lies beyond the image is left out, which a warning says") {
            Image half = whole;
            half.size[2] = 15;
            half.voxels = std::make_shared<const std::vector<float>>(
                whole.voxels->begin(), whole.voxels->begin() + 30 * 30 * 15);
            const std::string file = written(mask_of_iso(whole, 50.0, false), "mask.nrrd");
            const Outcome outcome =
                run("load-image", {}, {{"file", written(half, "half.nrrd")}, {"mask", file}});
            REQUIRE(outcome.warnings.size() == 1);
            CHECK(outcome.warnings[0].code == "mask-beyond-image");
            CHECK(outcome.warnings[0].figures.at("lost_percent") == Approx(50.0).margin(5.0));
        }
    }
    GIVEN("a choice of labels where there are none") {
        CHECK_THROWS_WITH(run("load-image", {}, {{"file", path}, {"label", std::string("artery")}}),
                          Contains("label map"));
    }
    GIVEN("other units") {
        const Outcome outcome = run("load-image", {}, {{"file", path}, {"units", "cm"}});
        THEN("they override the file's") {
            CHECK(outcome.scene.image->spacing().x() == Approx(8.0).epsilon(1e-6));
        }
    }
    GIVEN("an empty image") {
        const Image zero =
            image_of({3, 3, 3}, Eigen::Matrix4d::Identity(), [](const Vec3&) { return 0.0; });
        THEN("it is refused") {
            CHECK_THROWS_AS(run("load-image", {}, {{"file", written(zero, "zero.mha")}}),
                            InvalidInput);
        }
    }
}

SCENARIO("extract-surface reports its decisions and replays them", "[workbench][images]") {
    const std::string image = written(ball_image(8.0, 30, Vec3(0.8, 0.8, 1.0)), "ball.mha");
    const Scene loaded = run("load-image", {}, {{"file", image}}).scene;
    const Outcome outcome = run("extract-surface", loaded, {});
    THEN("method, threshold and side are resolved") {
        CHECK(outcome.resolved.text("method") == "threshold");
        CHECK(outcome.resolved.text("inside") == "above");
        CHECK(outcome.resolved.text("threshold") == "local");
        CHECK(outcome.report->at("threshold") > 20.0);
        CHECK(outcome.report->at("levels").at("highest") < 60.0);
        CHECK(outcome.report->at("bodies_found") == 1);
        CHECK(outcome.scene.sampling->confidence == 1.0);
        CHECK((outcome.scene.sampling->spacing - Vec3(0.8, 0.8, 1.0)).norm() < 1e-6);
    }
    THEN("the replay gives the same bits") {
        const Outcome again = run("extract-surface", loaded, outcome.resolved);
        CHECK(again.scene.surface->points() == outcome.scene.surface->points());
        CHECK(again.resolved == outcome.resolved);
    }
    THEN("one threshold for the whole vessel can be asked for") {
        const Outcome midway =
            run("extract-surface", loaded, {{"threshold", std::string("midway")}});
        CHECK(midway.resolved.real("threshold") > 20.0);
        CHECK_FALSE(midway.report->contains("levels"));
        CHECK(run("extract-surface", loaded, midway.resolved).scene.surface->points() ==
              midway.scene.surface->points());
    }
    THEN("a threshold that makes the vessel too wide is a warning with the figure") {
        const auto warnings = run("extract-surface", loaded, {{"threshold", 10.0}}).warnings;
        REQUIRE(warnings.size() == 1);
        CHECK(warnings[0].code == "threshold-changes-volume");
        CHECK(warnings[0].words.at("larger") == "larger");
        CHECK(warnings[0].remedies == std::vector<Remedy>{{.arguments = {{"threshold", "local"}}}});
        CHECK(run("extract-surface", loaded, {{"threshold", 48.0}}).warnings.empty());
    }
    THEN("cleaning is reported") {
        const Outcome clean =
            run("extract-surface", loaded,
                {{"diffusion", std::int64_t{3}}, {"opening", std::int64_t{1}}, {"resample", 0.5}});
        CHECK(clean.report->at("topology_after_cleaning").at("components") == 1);
        CHECK(clean.resolved.has("contrast"));
        CHECK((clean.scene.sampling->spacing - Vec3::Constant(0.5)).norm() < 1e-6);
    }
    THEN("without an image it names the operation that makes one") {
        CHECK_THROWS_WITH(run("extract-surface", {}, {}), Contains("load-image"));
    }
    THEN("two names of the threshold at once are refused") {
        CHECK_THROWS_AS(run("extract-surface", loaded, {{"iso", 1.0}, {"threshold", 2.0}}),
                        UsageError);
    }
}

SCENARIO("A handle of the lumen is named with its place and size", "[workbench][images]") {
    const auto ring = [](double radius) {
        Scene scene;
        scene.image = image_of(
            {60, 60, 20}, oblique_matrix(Vec3::Constant(0.5), Vec3::Zero()),
            [&, to_local = oblique_matrix(Vec3::Ones(), Vec3::Zero())](const Vec3& p) {
                const Vec3 local = to_local.topLeftCorner<3, 3>().transpose() * p - Vec3(15, 15, 5);
                const double across = std::hypot(local.x(), local.y()) - radius;
                const double r = std::hypot(across, local.z());
                return 100.0 * std::clamp(2.5 - r, 0.0, 1.0);
            });
        return scene;
    };
    const Outcome large = run("extract-surface", ring(10.0), {});
    REQUIRE(large.warnings.size() == 1);
    CHECK(large.warnings[0].code == "handle");
    CHECK(large.warnings[0].place);
    CHECK(large.warnings[0].figures.at("length_mm") > large.warnings[0].figures.at("width_mm"));
    CHECK(run("extract-surface", ring(4.0), {}).warnings.at(0).code == "handle-artefact");
    THEN("repair names it in a surface without an image") {
        Scene alone;
        alone.surface = large.scene.surface;
        CHECK(run("repair", alone, {}).warnings.at(0).code == "handle");
        CHECK(run("repair", large.scene, {}).warnings.empty());
    }
}

SCENARIO("What passes through a mask's lumen is filled by the closing that is offered",
         "[workbench][images][remedies]") {
    Image grid;
    grid.size = {24, 24, 60};
    grid.index_to_patient.diagonal().head<3>() = Vec3::Constant(0.5);
    // A tube of 8 mm, through which a pillar one voxel wide goes.
    Scene scene;
    scene.image = image_of(grid.size, grid.index_to_patient, [&](const Vec3& p) {
        const Vec3 at = grid.to_index(p).array().round();
        const bool pillar = at.z() > 28.5 && at.z() < 30.5 && at.y() == 12;
        return std::hypot(p.x() - 6.0, p.y() - 6.0) < 4.0 && !pillar ? 1.0 : 0.0;
    });
    const Outcome holed =
        run("extract-surface", scene, {{"method", "labels"}, {"mask_surface", "lumen"}});
    REQUIRE(connectivity(*holed.scene.surface->topology).genus == 1);
    const auto warning =
        std::ranges::find(holed.warnings, std::string("pillar-in-lumen"), &Diagnostic::code);
    REQUIRE(warning != holed.warnings.end());
    CHECK(warning->place->z() == Approx(14.75).margin(1.5));
    const Remedy& remedy = warning->remedies.at(0);
    CHECK(remedy.arguments == std::map<std::string, std::string>{{"closing", "1"}});
    const Outcome filled =
        run("extract-surface", scene,
            {{"method", "labels"},
             {"mask_surface", "lumen"},
             {"closing", std::int64_t{std::stoi(remedy.arguments.at("closing"))}}});
    CHECK(connectivity(*filled.scene.surface->topology).genus == 0);
}

SCENARIO("The surface of a curved tube's mask has one centerline", "[workbench][images]") {
    for (const Vec3& spacing : {Vec3(0.4, 0.4, 0.8), Vec3(0.5, 0.5, 0.5), Vec3(0.3, 0.3, 1.2)}) {
        VesselShape vessel;
        for (int i = 0; i <= 16; ++i) {
            const double angle = 5.5 * i / 16.0;
            vessel.points.emplace_back(9.0 * std::cos(angle), 9.0 * std::sin(angle), 3.5 * angle);
            vessel.radii.push_back(1.2);
        }
        Scene scene;
        scene.image = make_phantom({.name = "helix",
                                    .parts = {{.name = "helix", .shape = vessel}},
                                    .imaging = {.spacing = spacing},
                                    .surface_edge = 1.0})
                          .mask;
        const Outcome outcome = run("extract-surface", scene, {});
        CAPTURE(spacing.transpose());
        CHECK(compute_centerlines(*outcome.scene.surface).branches.size() == 1);
        CHECK(run("clip-opening", outcome.scene, {}).report->at("openings").size() == 2);
    }
}

SCENARIO("extract-surface warns about labels in an intensity image", "[workbench][images]") {
    const Image grid = ball_image(8.0, 30, Vec3(0.8, 0.8, 1.0));
    const Vec3 middle = middle_of(grid);
    const auto warnings = [&](double around) {
        Scene scene;
        scene.image = image_of(grid.size, grid.index_to_patient, [&](const Vec3& p) {
            const double r = (p - middle).norm();
            return r < 8.0 ? 1.0 : r < 9.0 ? around : 0.0;
        });
        return run("extract-surface", scene,
                   {{"method", "labels"}, {"labels", std::vector<double>{1.0}}})
            .warnings;
    };
    CHECK(warnings(2.0).empty());
    REQUIRE(warnings(0.25).size() == 1);
    CHECK(warnings(0.25)[0].code == "not-a-label-map");
    CHECK(warnings(0.25)[0].words.at("value") == "0.25");
}

SCENARIO("extract-surface says that it takes several labels together", "[workbench][images]") {
    const Image grid = ball_image(8.0, 30, Vec3(0.8, 0.8, 1.0));
    const Vec3 middle = middle_of(grid);
    Scene scene;
    scene.image = image_of(grid.size, grid.index_to_patient, [&](const Vec3& p) {
        return (p - middle).norm() > 8.0 ? 0.0 : p.x() < middle.x() ? 3.0 : 7.0;
    });
    const Outcome all = run("extract-surface", scene, {{"method", "labels"}});
    REQUIRE(all.warnings.size() == 1);
    CHECK(all.warnings[0].words.at("labels") == "labels 3, 7");
    CHECK(all.warnings[0].remedies == std::vector<Remedy>{{.arguments = {{"labels", "3,7"}}}});
    CHECK(all.report->at("headline") == "labels 3, 7");
    const Outcome one = run("extract-surface", scene, {{"labels", std::vector<double>{7.0}}});
    CHECK(one.warnings.empty());
    CHECK(one.report->at("headline") == "label 7");
    THEN("also those of a mask") {
        scene.mask = scene.image;
        const Outcome masked = run("extract-surface", scene, {{"threshold", 1.0}});
        CHECK(masked.resolved.text("method") == "masked");
        REQUIRE_FALSE(masked.warnings.empty());
        CHECK(masked.warnings.back().words.at("labels") == "labels 3, 7");
    }
}

SCENARIO("crop cuts image, mask and surface alike", "[workbench][images]") {
    const Image ball = ball_image(8.0, 30, Vec3(0.8, 0.8, 1.0));
    Scene scene;
    scene.image = ball;
    scene.mask = mask_of_iso(ball, 50.0, false);
    scene.surface = *run("extract-surface", scene, {}).scene.surface;
    const Vec3 centre = middle_of(ball) + Vec3(6, 0, 0);
    GIVEN("a ball over the edge") {
        const Outcome outcome = run("crop", scene, {{"centre", centre}, {"radius", 5.0}});
        THEN("mask and image stay on one grid, the surface is open") {
            CHECK(same_grid(*outcome.scene.image, *outcome.scene.mask));
            CHECK(outcome.scene.image->voxel_count() < ball.voxel_count());
            CHECK(outcome.report->at("boundary_loops") == 1);
        }
    }
    THEN("box or ball, not both and not neither") {
        CHECK_THROWS_AS(run("crop", scene, {}), UsageError);
        CHECK_THROWS_AS(run("crop", scene, {{"box", std::vector<double>{1, 2, 3}}}), UsageError);
        CHECK_THROWS_AS(run("crop", {}, {{"centre", centre}, {"radius", 5.0}}), AlgorithmFailure);
    }
}
