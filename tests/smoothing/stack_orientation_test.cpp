#include "smoothing/context/stack_orientation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <catch2/catch.hpp>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include "geometry/formats/image_file.h"
#include "geometry/image/extract_surface.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "smoothing/context/cut_ends.h"
#include "tests/support/iso_surface.h"
#include "tests/support/shapes.h"
#include "tests/support/stack_phantoms.h"
#include "tests/support/surface_facts.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

Surface of_labels(const Image& image) {
    ExtractionParameters p;
    p.method = ExtractionMethod::Labels;
    return extract_surface(image, {}, p).surface;
}

}  // namespace

SCENARIO("The stack axis of three organs is found for any rotation (thesis Table 5.6)",
         "[smoothing][stack orientation]") {
    const std::array<PhantomDescription, 3> organs = {vessel_in_slices(), muscle_in_slices(),
                                                      organ_in_slices()};
    const double hand = GENERATE(0.0, 0.4);  // [mm] by which an expert's contours differ
    for (PhantomDescription organ : organs) {
        organ.imaging.mask_jitter = hand;
        const Surface surface = of_mask(organ);
        for (const Vec3& about : {Vec3(1, 0, 0), Vec3(0, 1, 0)})
            for (const double angle : {0.0, 30.0, 60.0, 90.0}) {
                CAPTURE(organ.parts.front().name, hand, about.transpose(), angle);
                const Eigen::Matrix3d turn =
                    Eigen::AngleAxisd(angle * std::numbers::pi / 180.0, about).toRotationMatrix();
                const auto found = estimate_stack_orientation(turned(surface, turn));
                CHECK(degrees_between(found.direction, turn.col(2)) < 1.0);
                CHECK(found.certain);
                CHECK(found.direction.norm() == Approx(1.0));
                CHECK(found.direction.cwiseAbs().maxCoeff() == found.direction.maxCoeff());
            }
    }
}

SCENARIO("Intensities inside a mask reveal the axis, with and without a plateau",
         "[smoothing][stack orientation]") {
    // Partial volumes leave a vessel no face across the stack axis at all; its edges lie in the
    // sides of the voxels' cells.
    const Surface vessel = of_masked_intensities(vessel_in_slices());
    REQUIRE(share_of_flat_faces(vessel) == 0.0);
    for (const Surface& surface : {vessel, of_masked_intensities(organ_in_slices())}) {
        const auto found = estimate_stack_orientation(turned(surface, skew_rotation()));
        CHECK(found.certain);
        CHECK(degrees_between(found.direction, skew_rotation().col(2)) < 1.0);
    }
}

SCENARIO("Noisy spheres reveal the axis (thesis Table 5.7 with noise)",
         "[smoothing][stack orientation]") {
    constexpr std::size_t kSpheres = 100;
    const double noise = GENERATE(0.02, 0.05);  // of the contrast
    std::array<double, kSpheres> errors{};      // of the certain ones [deg]
    tbb::parallel_for(std::size_t{0}, kSpheres, [&](std::size_t i) {
        CutSphere cut = cut_sphere(i);
        auto& imaging = cut.description.imaging;
        imaging.noise = noise * (imaging.inside - imaging.outside);
        const auto found =
            estimate_stack_orientation(turned(imaged(cut.description), cut.rotation));
        errors[i] = found.certain ? degrees_between(found.direction, cut.rotation.col(2)) : -1.0;
    });
    CAPTURE(noise);
    CHECK(std::ranges::count_if(errors, [](double e) { return e >= 0.0; }) >= 80);
    CHECK(std::ranges::count_if(errors, [](double e) { return e > 5.0; }) == 0);
}

SCENARIO("Certain results for spheres with a cut slice are right (thesis Table 5.7)",
         "[smoothing][stack orientation]") {
    constexpr std::size_t kSpheres = 400;

    struct Outcome {
        double flat = 0.0, error = 0.0;
        bool certain = false;
    };

    std::vector<Outcome> outcomes(kSpheres);
    tbb::parallel_for(std::size_t{0}, kSpheres, [&](std::size_t i) {
        const CutSphere cut = cut_sphere(i);
        const Surface surface = imaged(cut.description);
        const auto found = estimate_stack_orientation(turned(surface, cut.rotation));
        outcomes[i] = {share_of_flat_faces(surface),
                       degrees_between(found.direction, cut.rotation.col(2)), found.certain};
    });
    const auto count = [&](const auto& condition) {
        return std::count_if(outcomes.begin(), outcomes.end(), condition);
    };
    const auto certain = count([](const Outcome& o) { return o.certain; });
    const auto wrong = count([](const Outcome& o) { return o.certain && o.error > 2.0; });
    const auto flat = count([](const Outcome& o) { return o.flat >= 0.01; });
    const auto missed = count([](const Outcome& o) { return o.flat >= 0.01 && !o.certain; });
    CAPTURE(certain, wrong, flat, missed);
    REQUIRE(flat > 100);  // else the table says nothing
    REQUIRE(flat < 350);
    CHECK(100 * wrong <= certain);
    CHECK(100 * missed <= 5 * flat);
}

SCENARIO("Smooth shapes have no stack axis, whatever the lattice of their surface",
         "[smoothing][stack orientation]") {
    const Eigen::AlignedBox3d box(Vec3::Constant(-13), Vec3::Constant(13));
    const auto iso = [&](const ImplicitShape& shape) { return iso_surface(shape, box, 0.6); };
    const auto ball = [](const Vec3& p) { return (p - Vec3(.13, .21, .07)).norm() - 10.0; };
    const auto upright = [](const Vec3& p) {
        return capsule(p, Vec3(0, 0, -8), Vec3(0, 0, 8), 3.0);
    };
    const auto skew = [](const Vec3& p) {
        return capsule(p, Vec3(-5, -3, -8), Vec3(5, 2, 7), 3.0);
    };
    const auto ring = [](const Vec3& p) {
        return std::hypot(std::hypot(p.x(), p.y()) - 8.0, p.z()) - 3.0;
    };
    for (const Surface& surface :
         {icosphere(10.0, 4), open_tube(3.0, 20.0, 40, 60), closed_tube(3.0, 20.0, 40, 60),
          cube(2.0), iso([](const Vec3& p) { return p.norm() - 10.0; }), iso(ball), iso(upright),
          iso(skew), iso(ring)})
        CHECK_FALSE(estimate_stack_orientation(surface).certain);
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        CAPTURE(seed);
        const Surface sphere = imaged(random_sphere(seed, Vec3(1, 1, 1)));
        CHECK_FALSE(estimate_stack_orientation(sphere).certain);
    }
}

SCENARIO("Masks reveal the axis of their longest voxel edge, and none for cubic voxels",
         "[smoothing][stack orientation]") {
    PhantomDescription organ = organ_in_slices();
    organ.imaging.spacing = Vec3(2, 2, 2);
    CHECK_FALSE(estimate_stack_orientation(of_mask(organ)).certain);
    for (const double slices : {3.0, 8.0, 22.0}) {
        CAPTURE(slices);
        organ.imaging.spacing = Vec3(2, 1.8, slices);
        const auto found = estimate_stack_orientation(turned(of_mask(organ), skew_rotation()));
        CHECK(found.certain);
        CHECK(degrees_between(found.direction, skew_rotation().col(2)) < 1e-3);
    }
}

SCENARIO("A vessel along the stack axis reveals it by its two ends",
         "[smoothing][stack orientation]") {
    PhantomDescription tube;
    tube.parts = {{"tube", VesselShape{{Vec3(0, 0, -18), Vec3(0, 0, 18)}, {2.2, 2.2}}, 0.0}};
    tube.imaging.spacing = Vec3(0.7, 0.7, 1.4);
    const Surface surface = of_mask(tube);
    REQUIRE(share_of_flat_faces(surface) < 0.05);
    const auto found = estimate_stack_orientation(turned(surface, skew_rotation()));
    CHECK(found.certain);
    CHECK(degrees_between(found.direction, skew_rotation().col(2)) < 1e-3);
    THEN("a prism, whose few normals could be those of voxels, does not") {
        for (const double length : {2.0, 20.0}) {
            const Surface prism = closed_tube(3.0, length, 8, 30);
            CHECK_FALSE(estimate_stack_orientation(*prism.topology, prism.points()).certain);
        }
    }
}

SCENARIO("Flat closures are not a trace of slices", "[smoothing][stack orientation]") {
    const Surface tube = fine_tube(3.0, 12.0, 96);
    // Without the patches they cannot be told from a removed slice.
    CHECK(estimate_stack_orientation(*tube.topology, tube.points()).certain);
    CHECK_FALSE(estimate_stack_orientation(tube).certain);
}

SCENARIO("The estimate turns with the surface, and does not depend on the threads",
         "[smoothing][stack orientation]") {
    const Surface surface = imaged(cut_sphere(5).description);
    const auto upright = estimate_stack_orientation(surface);
    REQUIRE(upright.certain);
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        const Eigen::Matrix3d turn = random_rotation(seed);
        const auto found = estimate_stack_orientation(turned(surface, turn));
        CHECK(degrees_between(found.direction, turn * upright.direction) < 0.01);
        CHECK(found.certain);
        CHECK(found.flat_share == Approx(upright.flat_share).epsilon(0.01));
    }
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const auto alone = estimate_stack_orientation(surface);
    CHECK(alone.direction == upright.direction);
    CHECK(alone.confidence == upright.confidence);
    CHECK(alone.flat_share == upright.flat_share);
}

SCENARIO("Without evidence, the stack orientation is uncertain", "[smoothing][stack orientation]") {
    CHECK_FALSE(estimate_stack_orientation(Surface{}).certain);
    CHECK(estimate_stack_orientation(make_surface({}, {})).confidence == 0.0);
    const Surface line = mapped(cube(1.0), [](const Vec3& p) { return Vec3(p.x(), 0, 0); });
    const auto flat = estimate_stack_orientation(line);
    CHECK_FALSE(flat.certain);
    CHECK(flat.direction == Vec3::UnitZ());
    CHECK(flat.flat_share == 0.0);
    // A few broken faces change nothing.
    const Surface sphere = imaged(cut_sphere(5).description);
    Positions broken = sphere.points();
    broken[0].x() = std::numeric_limits<double>::quiet_NaN();
    broken[1].y() = std::numeric_limits<double>::infinity();
    const auto found = estimate_stack_orientation(*sphere.topology, broken);
    CHECK(found.certain);
    CHECK(degrees_between(found.direction, Vec3::UnitZ()) < 0.5);
    CHECK_THROWS_AS(estimate_stack_orientation(sphere, {.radius = 0.0}), InvalidInput);
    CHECK_THROWS_AS(estimate_stack_orientation(sphere, {.radius = 0.6}), InvalidInput);
    CHECK_THROWS_AS(estimate_stack_orientation(sphere, {.theta_limit = 0.0}), InvalidInput);
    CHECK_THROWS_AS(estimate_stack_orientation(sphere, {.theta_limit = 1.1}), InvalidInput);
}

SCENARIO("Label maps of patients reveal their slices, unless their voxels are cubes",
         "[smoothing][stack orientation]") {
    const std::string sliced = shared_data("images/topcow_mr_roi_003_labels.nii.gz"),
                      cubic = shared_data("images/totalseg_aorta_true_false_lumen.nii.gz");
    if (!sliced.empty()) {
        const Image image = read_image(sliced);
        const auto found = estimate_stack_orientation(of_labels(image));
        CHECK(found.certain);
        CHECK(degrees_between(found.direction, sampling_of(image).axes.col(2)) < 0.1);
    }
    if (!cubic.empty())
        CHECK_FALSE(estimate_stack_orientation(of_labels(read_image(cubic))).certain);
}

SCENARIO("Intensities of patients reveal their slices and voxels",
         "[smoothing][stack orientation]") {
    for (const auto& [name, threshold] :
         {std::pair{"niivue_tof_mra.nii.gz", 60.0}, std::pair{"vmtk_aorta.mha", 700.0}}) {
        const std::string path = shared_data(std::string("images/") + name);
        if (path.empty()) continue;
        CAPTURE(name);
        const Image image = read_image(path);
        ExtractionParameters p;
        p.method = ExtractionMethod::Threshold;
        p.threshold = threshold;
        const auto found = estimate_stack_orientation(extract_surface(image, {}, p).surface);
        CHECK(found.certain);
        CHECK(degrees_between(found.direction, sampling_of(image).axes.col(2)) < 0.1);
        REQUIRE(found.grid);
        const double slice = found.grid->spacing[found.grid->longest()];
        CHECK(slice == Approx(image.spacing().z()).epsilon(1e-3));
    }
}

SCENARIO("Parallel ends that the image cut off are evidence", "[smoothing][stack orientation]") {
    const auto end = [](const Vec3& normal, const Vec3& centre, double area) {
        return CutEnd{normal.normalized(), centre, area};
    };
    const CutEnd low = end(Vec3(0, 0, -1), Vec3(0, 0, 0), 20.0),
                 high = end(Vec3(0, 0, 1), Vec3(8, 0, 20), 25.0);
    const auto confidence = [](const std::vector<CutEnd>& ends) {
        const auto axis = axis_of_ends(ends);
        if (axis) CHECK(degrees_between(axis->direction, Vec3::UnitZ()) < 0.5);
        return axis ? axis->confidence : 0.0;
    };
    CHECK(confidence({low, high}) == Approx(2.0 / 3.0));
    CHECK(confidence({low, high, end(Vec3(0, 0, 1), Vec3(-8, 0, 20), 9.0)}) == Approx(0.75));
    CHECK(confidence({low}) == 0.0);
    CHECK(confidence({low, end(Vec3(0, 0.02, 1), Vec3(8, 0, 20), 25.0)}) == 0.0);  // 1.1 degrees
    CHECK(confidence({low, high, end(Vec3(1, 0, 0), Vec3(9, 9, 9), 30.0)}) < 0.5);
    // A straight vessel that was clipped across has parallel ends, too.
    CHECK(confidence({low, end(Vec3(0, 0, 1), Vec3(0.5, 0, 20), 25.0)}) == 0.0);
}

SCENARIO("The small end of an organ that the image cut off is evidence, a small cap is not",
         "[smoothing][stack orientation]") {
    // Cubes whose tops of 10 x 10 and 2 x 2 mm lie in one plane.
    const Surface large = cube(10.0), small = mapped(cube(2.0), [](const Vec3&p) {
                                          return Vec3(p.x() + 12.0, p.y(), p.z() + 8.0);
                                      });
    const Surface both = merged(large, small);
    REQUIRE(bounds(large).max.z() == Approx(bounds(small).max.z()));
    const auto is_top = [&](TriangleId t) {
        return area_normal(both.points(), both.triangles()[t]).normalized().z() > 0.5;
    };
    PatchLabels labels(both.triangle_count());
    std::array<Cap, 2> caps;
    for (TriangleId t = 0; t < labels.size(); ++t) {
        if (!is_top(t)) continue;
        const std::size_t part = t < large.triangle_count() ? 0 : 1;
        labels[t] = static_cast<std::uint16_t>(part + 1);
        caps[part].triangles.push_back(t);
    }
    const Surface marked = both.with_patches(
        labels, {{"wall", PatchKind::Wall}, {"cut_1", PatchKind::Cut}, {"cut_2", PatchKind::Cut}});
    CHECK(cut_ends(marked).size() == 2);
    REQUIRE(axis_of_ends(cut_ends(marked)));
    CHECK(axis_of_ends(cut_ends(marked))->confidence == Approx(2.0 / 3.0));
    CHECK(cut_ends(both, caps).size() == 1);
}

SCENARIO("Cubic voxels show no stack axis, but the ends of a real vessel do (thesis Table 5.6)",
         "[smoothing][stack orientation]") {
    const std::string labels = shared_data("images/totalseg_example_labels_117.nii.gz"),
                      scan = shared_data("images/totalseg_example_ct_sm.nii.gz");
    if (labels.empty() || scan.empty()) return;
    const Image mask = read_image(labels), image = read_image(scan);
    const int vena_cava = 63;
    const auto method = GENERATE(ExtractionMethod::Labels, ExtractionMethod::Masked);
    const Surface surface =
        extract_surface(image, mask, {.method = method, .labels = {vena_cava}}).surface;
    REQUIRE(cut_ends(surface).size() >= 2);
    const Surface whole = turned(surface, skew_rotation());
    const Vec3 axis = skew_rotation() * sampling_of(image).axes.col(2);
    const auto found = estimate_stack_orientation(whole);
    CAPTURE(found.confidence);
    CHECK(found.certain);
    CHECK(degrees_between(found.direction, axis) < 0.1);
    THEN("as clipped openings, the same ends say nothing") {
        std::vector<Patch> patches = whole.patches;
        for (Patch& patch : patches)
            if (patch.kind == PatchKind::Cut) patch.kind = PatchKind::Outlet;
        const Surface clipped = whole.with_patches(*whole.patch_labels, std::move(patches));
        CHECK_FALSE(estimate_stack_orientation(clipped).certain);
    }
}
