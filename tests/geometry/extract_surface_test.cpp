#include "geometry/image/extract_surface.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <catch2/catch.hpp>

#include "geometry/formats/image_file.h"
#include "geometry/image/iso_surface.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/self_intersections.h"
#include "tests/support/image_shapes.h"
#include "tests/support/shapes.h"
#include "tests/support/stop_at.h"
#include "tests/support/surface_facts.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;

namespace {

constexpr double kPi = std::numbers::pi;

double ball_volume(double radius) {
    return 4.0 / 3.0 * kPi * radius * radius * radius;
}

/// A tube of value 100 along the k axis through the whole grid, 3 mm thick; 0 elsewhere.
Image tube_image(bool mirrored) {
    const auto matrix = oblique_matrix(Vec3(0.5, 0.5, 1.0), Vec3(5, -60, 20), mirrored);
    Image grid;
    grid.size = {41, 41, 21};
    grid.index_to_patient = matrix;
    const Vec3 centre = middle_of(grid), axis = matrix.col(2).head<3>().normalized();
    return image_of(grid.size, matrix, [&](const Vec3& p) {
        const Vec3 off = (p - centre) - (p - centre).dot(axis) * axis;
        return 100.0 * std::clamp(0.5 + 0.5 * (3.0 - off.norm()), 0.0, 1.0);
    });
}

Surface extracted(const Image& image, const ExtractionParameters& parameters,
                  const std::optional<Image>& mask = {}) {
    return extract_surface(image, mask, parameters).surface;
}

}  // namespace

SCENARIO("A ball in an image becomes a sphere of its volume", "[images][extraction]") {
    const bool mirrored = GENERATE(false, true);
    GIVEN(std::string("an oblique, anisotropic grid") + (mirrored ? ", mirrored" : "")) {
        const Image image = ball_image(10.0, 40, Vec3(0.6, 0.6, 0.8), mirrored);
        StopAt never(2.0);
        const Surface ball =
            extract_surface(image, {}, {.threshold = 50.0}, never.progress()).surface;
        THEN("progress is reported while the surface is extracted") {
            const auto inside = [](double fraction) { return fraction > 0.6 && fraction < 0.8; };
            CHECK(std::ranges::count_if(never.fractions(), inside) > 2);
        }
        THEN("the volume is right within 0.5 %, outward, closed, in its place") {
            CHECK(volume(ball) == Approx(ball_volume(10.0)).epsilon(0.005));
            CHECK(is_closed_manifold(ball));
            CHECK((bounds(ball).centre() - middle_of(image)).norm() < 0.02);
            CHECK(ball.patches.size() == 1);
        }
        THEN("the automatic threshold finds it too") {
            const Extraction automatic = extract_surface(image, {}, {});
            CHECK(automatic.method == ExtractionMethod::Threshold);
            CHECK(volume(automatic.surface) == Approx(ball_volume(10.0)).epsilon(0.1));
        }
    }
}

SCENARIO("The automatic threshold lies midway at the vessel's wall", "[images][extraction]") {
    Image grid;
    grid.size = {64, 64, 64};
    grid.index_to_patient = oblique_matrix(Vec3::Constant(0.5), Vec3::Zero());
    const Vec3 centre = grid.to_patient(Vec3(40, 32, 32));
    const double radius = 9.0, air = GENERATE(4.0, 12.0);
    const Image image = image_of(grid.size, grid.index_to_patient, [&](const Vec3& p) {
        const double tissue = grid.to_index(p).x() < air ? 0.0 : 40.0;
        const double share = std::clamp(0.5 + (radius - (p - centre).norm()) / 1.5, 0.0, 1.0);
        return tissue + (100.0 - tissue) * share;
    });
    THEN("voxels far from it, as of air, do not count") {
        const Extraction ball = extract_surface(image, {}, {});
        CHECK(ball.threshold == Approx(70.0).epsilon(0.04));
        CHECK(volume(ball.surface) == Approx(ball_volume(radius)).epsilon(0.03));
    }
}

SCENARIO("The dark side of a threshold can be the vessel", "[images][extraction]") {
    Image image = ball_image(10.0, 40, Vec3(0.6, 0.6, 0.8));
    std::vector<float> inverse;
    for (const float v : *image.voxels) inverse.push_back(-v);
    image.voxels = std::make_shared<const std::vector<float>>(inverse);
    const Surface ball = extracted(image, {.threshold = -50.0, .inside_below = true});
    CHECK(volume(ball) == Approx(ball_volume(10.0)).epsilon(0.005));
}

SCENARIO("A vessel that leaves the image is closed flat at the border", "[images][extraction]") {
    const bool mirrored = GENERATE(false, true);
    const Image image = tube_image(mirrored);
    const Surface tube = extracted(image, {.threshold = 50.0});
    THEN("both ends are planar patches in the outermost voxel planes") {
        REQUIRE(tube.patches.size() == 3);
        for (const auto& patch : measure_patches(tube)) {
            if (patch.kind != PatchKind::Cut) continue;
            CHECK(patch.area == Approx(kPi * 9.0).epsilon(0.01));
            CHECK(patch.flatness < 1e-12);
        }
        for (TriangleId t = 0; t < tube.triangle_count(); ++t)
            if (tube.patch_of(t).kind == PatchKind::Cut)
                for (const VertexId v : tube.triangles()[t]) {
                    const double k = image.to_index(tube.points()[v]).z();
                    CHECK(std::min(std::abs(k), std::abs(k - 20.0)) < 1e-9);
                }
    }
    THEN("it is closed, outward, and as long as the image") {
        CHECK(is_closed_manifold(tube));
        CHECK(volume(tube) == Approx(kPi * 9.0 * 20.0).epsilon(0.01));
        CHECK(self_intersections(tube).empty());
    }
}

SCENARIO("A body in a corner of the image is closed on three sides", "[images][extraction]") {
    Image grid;
    grid.size = {12, 12, 12};
    grid.index_to_patient = oblique_matrix(Vec3(1, 1, 1), Vec3::Zero());
    const Vec3 corner = grid.to_patient(Vec3::Zero());
    const Image image = image_of(grid.size, grid.index_to_patient,
                                 [&](const Vec3& p) { return 8.3 - (p - corner).norm(); });
    const Surface part = extracted(image, {.threshold = 0.0, .inside_below = false});
    CHECK(is_closed_manifold(part));
    CHECK(part.patches.size() == 4);
    CHECK(volume(part) == Approx(ball_volume(8.3) / 8.0).epsilon(0.01));
}

SCENARIO("A touch of the border is not a vessel's end", "[images][extraction]") {
    const Image mask = image_of({9, 9, 9}, Eigen::Matrix4d::Identity(), [](const Vec3& p) {
        const bool body = p.x() > 1 && p.x() < 7 && p.y() > 1 && p.y() < 7 && p.z() > 0;
        const bool hair = p.x() == 4 && p.y() == 4;
        return body || hair ? 1.0 : 0.0;
    });
    const Extraction extraction = extract_surface(mask, {}, {});
    // The body ends at the last slice; the hair of one voxel meets the first one.
    REQUIRE(extraction.surface.patches.size() == 2);
    CHECK(measure_patches(extraction.surface)[1].centroid.z() == Approx(8.0));
    CHECK(is_closed_manifold(extraction.surface));
}

SCENARIO("The surface of any image is a closed manifold", "[images][extraction][property]") {
    const unsigned seed = GENERATE(1u, 2u, 3u, 4u, 5u);
    const bool binary = GENERATE(false, true);
    std::mt19937 generator(seed);
    std::vector<float> voxels;
    for (int v = 0; v < 9 * 8 * 7; ++v) {
        // Multiples of a quarter: many voxels lie exactly on the iso-value.
        const auto number = static_cast<float>(generator() % 5) * 0.25f;
        voxels.push_back(binary ? std::round(number) : number);
    }
    Image image;
    image.size = {9, 8, 7};
    image.index_to_patient = oblique_matrix(Vec3(1, 2, 3), Vec3(1000, -500, 200), seed % 2 == 0);
    image.voxels = std::make_shared<const std::vector<float>>(voxels);
    const Surface noise = iso_surface(image, 0.5);
    const Connectivity facts = connectivity(*noise.topology);
    CHECK(facts.closed);
    CHECK(facts.manifold);
    CHECK(facts.oriented);
    CHECK(volume(noise) > 0.0);
    double smallest = std::numeric_limits<double>::infinity();
    for (const Triangle& t : noise.triangles())
        smallest = std::min(smallest, triangle_area(noise.points(), t));
    CHECK(smallest > 0.0);
}

SCENARIO("Chosen labels become a surface with real staircases", "[images][extraction]") {
    // Two boxes of labels 1 and 2 that touch, and a third one apart.
    Image grid;
    grid.size = {20, 10, 10};
    grid.index_to_patient = oblique_matrix(Vec3(1, 1, 2), Vec3::Zero());
    std::vector<float> voxels(grid.voxel_count(), 0.0f);
    for (int k = 3; k < 7; ++k)
        for (int j = 3; j < 7; ++j) {
            for (int i = 2; i < 6; ++i) voxels[grid.offset(i, j, k)] = 1.0f;
            for (int i = 6; i < 9; ++i) voxels[grid.offset(i, j, k)] = 2.0f;
            for (int i = 12; i < 17; ++i) voxels[grid.offset(i, j, k)] = 7.0f;
        }
    grid.voxels = std::make_shared<const std::vector<float>>(voxels);
    // A box of n voxels reaches half a voxel beyond their centres; its edges are cut off.
    const auto roughly = [](int i, int j, int k) { return 2.0 * i * j * k; };
    GIVEN("no choice") {
        const Extraction all = extract_surface(grid, {}, {});
        THEN("every label above 0 counts, and the largest body is kept") {
            CHECK(all.method == ExtractionMethod::Labels);
            CHECK(all.labels == std::vector<int>{1, 2, 7});
            CHECK(all.bodies == 2);
            CHECK(volume(all.surface) == Approx(roughly(7, 4, 4)).epsilon(0.1));
        }
    }
    GIVEN("one label") {
        const Surface one = extracted(grid, {.method = ExtractionMethod::Labels, .labels = {2}});
        THEN("only that is taken; vertices lie midway between voxels") {
            CHECK(volume(one) == Approx(roughly(3, 4, 4)).epsilon(0.15));
            for (const Vec3& p : one.points()) {
                const Vec3 twice = 2.0 * grid.to_index(p);
                CHECK((twice - Vec3(twice.array().round())).norm() < 1e-4);
            }
        }
    }
    GIVEN("a seed") {
        const Surface seeded = extracted(grid, {.seed = grid.to_patient(Vec3(14, 5, 5))});
        THEN("the body there is taken") {
            CHECK(volume(seeded) == Approx(roughly(5, 4, 4)).epsilon(0.12));
        }
        THEN("a seed in no body is refused with the distance") {
            CHECK_THROWS_WITH(extracted(grid, {.seed = grid.to_patient(Vec3(0, 0, 30))}),
                              Contains("nearest one is"));
        }
    }
    GIVEN("all bodies") {
        THEN("both are kept") {
            const Surface both = extracted(grid, {.bodies = Bodies::All});
            CHECK(connectivity(*both.topology).components == 2);
        }
    }
    GIVEN("a label that is not there") {
        THEN("those that are there are named") {
            CHECK_THROWS_WITH(extracted(grid, {.method = ExtractionMethod::Labels, .labels = {5}}),
                              Contains("1, 2, 7"));
        }
    }
}

SCENARIO("A dilated mask cuts neighbours off, and nothing else", "[images][extraction]") {
    // Two balls of 100 that touch; the mask holds the first one, one voxel too small.
    Image grid;
    grid.size = {50, 30, 30};
    grid.index_to_patient = oblique_matrix(Vec3(0.7, 0.7, 0.7), Vec3(3, 4, 5));
    const Vec3 first = grid.to_patient(Vec3(15, 15, 15)),
               second = grid.to_patient(Vec3(34, 15, 15));
    const Image image = image_of(grid.size, grid.index_to_patient, [&](const Vec3& p) {
        const double d = std::min((p - first).norm() - 6.5, (p - second).norm() - 6.5);
        return 20.0 + 100.0 * std::clamp(0.5 - 0.5 * d, 0.0, 1.0);
    });
    const Image mask = image_of(grid.size, grid.index_to_patient, [&](const Vec3& p) {
        return (p - first).norm() < 6.2 ? 1.0 : 0.0;
    });
    const Extraction masked = extract_surface(image, mask, {});
    THEN("the method is the mask's, and the threshold lies between inside and around") {
        CHECK(masked.method == ExtractionMethod::Masked);
        CHECK(masked.threshold > 40.0);
        CHECK(masked.threshold < 100.0);
    }
    THEN("the same mask at another place or of another size is refused") {
        Image shifted = mask;
        shifted.index_to_patient.topRightCorner<3, 1>() += Vec3(5, 0, 0);
        CHECK_THROWS_WITH(extract_surface(image, shifted, {}),
                          Contains("at a different place") && Contains("5 mm apart"));
        shifted.index_to_patient = mask.index_to_patient;
        shifted.size[2] = 29;
        CHECK_THROWS_WITH(extract_surface(image, shifted, {}), Contains("50 x 30 x 29"));
    }
    THEN("the body is the first ball") {
        const Surface ball = extracted(image, {.threshold = 70.0}, mask);
        CHECK(volume(ball) == Approx(ball_volume(6.5)).epsilon(0.015));
    }
    THEN("away from the neighbour the surface is that of the unmasked image") {
        const Surface with = extracted(image, {.threshold = 70.0}, mask);
        double farthest = 0.0;
        for (const Vec3& p : with.points())
            if ((p - second).norm() > 8.5)
                farthest = std::max(farthest, std::abs((p - first).norm() - 6.5));
        CHECK(farthest < 0.06);
    }
    THEN("a mask of another size is refused with both sizes") {
        Image other = mask;
        other.size = {50, 30, 29};
        CHECK_THROWS_WITH(extract_surface(image, other, {}),
                          Contains("50 x 30 x 29") && Contains("50 x 30 x 30"));
    }
}

SCENARIO("A level set is recognised, whichever side is negative", "[images][extraction]") {
    const double sign = GENERATE(1.0, -1.0);
    Image grid;
    grid.size = {30, 30, 30};
    grid.index_to_patient = oblique_matrix(Vec3(1, 1, 1), Vec3::Zero());
    const Vec3 middle = middle_of(grid);
    const Image image = image_of(grid.size, grid.index_to_patient, [&](const Vec3& p) {
        return sign * std::clamp((p - middle).norm() - 9.0, -3.0, 3.0);
    });
    const Extraction extraction = extract_surface(image, {}, {});
    CHECK(extraction.threshold == 0.0);
    CHECK(extraction.inside_below == (sign > 0.0));
    CHECK(extraction.reasons.size() == 1);
    CHECK(volume(extraction.surface) == Approx(ball_volume(9.0)).epsilon(0.01));
}

SCENARIO("Hollows are closed and noise is left out", "[images][extraction]") {
    const Image grid = ball_image(10.0, 40, Vec3(0.6, 0.6, 0.6));
    const Vec3 middle = middle_of(grid);
    const Image image = image_of(grid.size, grid.index_to_patient, [&](const Vec3& p) {
        const double r = (p - middle).norm();
        return r < 3.0 ? 0.0 : r < 8.0 ? 1.0 : (p - grid.to_patient(Vec3(2, 2, 2))).norm() < 1.0;
    });
    const Extraction extraction =
        extract_surface(image, {}, {.method = ExtractionMethod::Threshold, .threshold = 0.5});
    CHECK(extraction.hollows == 1);
    CHECK(extraction.bodies == 2);
    CHECK(extraction.largest_dropped > 0.0);
    CHECK_FALSE(extraction.dropped_vessel);
    CHECK(connectivity(*extraction.surface.topology).components == 1);
    CHECK(volume(extraction.surface) == Approx(ball_volume(8.0)).epsilon(0.03));
}

SCENARIO("A vessel that is broken off is noticed, however small", "[images][extraction]") {
    const Image grid = ball_image(10.0, 40, Vec3(0.6, 0.6, 0.6));
    const Vec3 middle = middle_of(grid);
    const Image image = image_of(grid.size, grid.index_to_patient, [&](const Vec3& p) {
        const Vec3 off = p - middle;
        const bool vessel = std::hypot(off.x() - 9.0, off.y()) < 0.7 && std::abs(off.z()) < 5.0;
        return off.norm() < 7.0 || vessel ? 1.0 : 0.0;
    });
    const Extraction extraction =
        extract_surface(image, {}, {.method = ExtractionMethod::Threshold, .threshold = 0.5});
    CHECK(extraction.largest_dropped < 0.02 * volume(extraction.surface));
    REQUIRE(extraction.dropped_vessel);
    CHECK(extraction.dropped_vessel->length == Approx(10.0).margin(1.0));
    CHECK((extraction.dropped_vessel->centre - middle - Vec3(9, 0, 0)).norm() < 0.5);
}

SCENARIO("A broken-off vessel with branches is noticed", "[images][extraction]") {
    const Image grid = ball_image(10.0, 40, Vec3(0.6, 0.6, 0.6));
    const Vec3 middle = middle_of(grid);
    const Image image = image_of(grid.size, grid.index_to_patient, [&](const Vec3& p) {
        const Vec3 off = p - middle - Vec3(8, 0, 0);
        const bool tree = std::abs(off.x()) < 0.9 &&
                          std::min(std::abs(off.y()), std::abs(off.z())) < 0.9 &&
                          std::max(std::abs(off.y()), std::abs(off.z())) < 5.5;
        return (p - middle).norm() < 6.0 || tree ? 1.0 : 0.0;
    });
    const Extraction extraction =
        extract_surface(image, {}, {.method = ExtractionMethod::Threshold, .threshold = 0.5});
    REQUIRE(extraction.dropped_vessel);
    CHECK(extraction.dropped_vessel->diameter == Approx(1.8).margin(0.5));
}

SCENARIO("Thresholds that leave nothing or everything are refused", "[images][extraction]") {
    const Image image = ball_image(5.0, 20, Vec3(1, 1, 1));
    CHECK_THROWS_WITH(extracted(image, {.threshold = 700.0}),
                      Contains("no voxel") && Contains("from 0 to 100"));
    CHECK_THROWS_WITH(extracted(image, {.threshold = -1.0}), Contains("every voxel"));
    CHECK_THROWS_AS(extracted(image, {.method = ExtractionMethod::Masked}), InvalidInput);
    CHECK_THROWS_AS(extracted(Image{}, {}), InvalidInput);
    const Image constant =
        image_of({4, 4, 4}, Eigen::Matrix4d::Identity(), [](const Vec3&) { return 3.0; });
    CHECK_THROWS_WITH(extracted(constant, {}), Contains("all its voxels are 3"));
    const Image flat =
        image_of({4, 4, 1}, Eigen::Matrix4d::Identity(), [](const Vec3& p) { return p.x(); });
    CHECK_THROWS_WITH(extracted(flat, {.threshold = 1.5}), Contains("volume"));
}

SCENARIO("Real images give closed vessels of plausible size", "[images][extraction][real-data]") {
    const std::string folder = shared_data("images/vmtk_aorta.mha");
    if (folder.empty()) return;
    const auto read = [](const char* name) {
        return read_image(shared_data(std::string("images/") + name));
    };
    GIVEN("VMTK's level set") {
        const Surface aorta = extracted(read("vmtk_aorta_final_levelset.mha"), {});
        THEN("it is VMTK's surface: as many triangles, same volume") {
            CHECK(aorta.triangle_count() == 12932);
            CHECK(volume(aorta) == Approx(13184.0).epsilon(0.001));
            CHECK(is_closed_manifold(aorta));
            CHECK(self_intersections(aorta).empty());
        }
    }
    GIVEN("the image masked by it") {
        const Image levelset = read("vmtk_aorta_final_levelset.mha");
        const Surface aorta = extracted(read("vmtk_aorta.mha"), {.threshold = 700.0},
                                        mask_of_iso(levelset, 0.0, true));
        THEN("the aorta alone is taken") {
            CHECK(is_closed_manifold(aorta));
            CHECK(aorta.patches.size() == 1);
            CHECK(connectivity(*aorta.topology).genus == 0);
            CHECK(volume(aorta) > 13000.0);
            CHECK(volume(aorta) < 19000.0);
        }
    }
    GIVEN("a whole-numbered MRA") {
        const Extraction mra =
            extract_surface(read("niivue_tof_mra.nii.gz"), {}, {.threshold = 60.0});
        THEN("it is no label map; both carotids leave the image") {
            CHECK(mra.method == ExtractionMethod::Threshold);
            CHECK(is_closed_manifold(mra.surface));
            CHECK(mra.surface.patches.size() == 3);
        }
    }
    GIVEN("label maps") {
        THEN("each gives a closed surface") {
            for (const char* name :
                 {"topcow_mr_roi_003_labels.nii.gz", "topcow_ct_roi_023_labels.nii.gz",
                  "totalseg_aorta_true_false_lumen.nii.gz"}) {
                const Extraction extraction = extract_surface(read(name), {}, {});
                CHECK(extraction.method == ExtractionMethod::Labels);
                CHECK(is_closed_manifold(extraction.surface));
            }
            const Surface aorta = extracted(read("totalseg_example_labels_117.nii.gz"),
                                            {.method = ExtractionMethod::Labels, .labels = {52}});
            CHECK(volume(aorta) == Approx(25850.0).epsilon(0.01));
        }
    }
}

SCENARIO("Labels have the volume of their voxels", "[images][extraction]") {
    const Eigen::Matrix4d matrix = oblique_matrix({0.5, 1, 2}, {3, 4, 5});
    Image labels = image_of({4, 3, 2}, matrix, [](const Vec3&) { return 0.0; });
    auto voxels = *labels.voxels;
    voxels[0] = voxels[5] = 7;
    voxels[6] = voxels[7] = voxels[23] = 2;
    labels.voxels = std::make_shared<const std::vector<float>>(std::move(voxels));
    const std::map<int, double> volumes = label_volumes(labels);
    REQUIRE(volumes.size() == 2);
    CHECK(volumes.at(2) == Approx(3.0));
    CHECK(volumes.at(7) == Approx(2.0));
    CHECK(labels_of(labels) == std::vector<int>{2, 7});
}
