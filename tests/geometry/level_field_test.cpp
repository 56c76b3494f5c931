#include "geometry/image/level_field.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <catch2/catch.hpp>

#include "geometry/image/extract_surface.h"
#include "geometry/image/grid_blur.h"
#include "geometry/image/occupancy.h"
#include "geometry/image/sampled_levels.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "geometry/phantoms/phantom.h"
#include "tests/support/image_shapes.h"
#include "tests/support/stop_at.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;

namespace {

constexpr double kInside = 600.0, kOutside = 100.0;

/// A helix of six radii, as a scanner shows it.
Phantom helix(double radius, const Vec3& spacing, const Vec3& blur, double noise) {
    VesselShape vessel;
    for (int i = 0; i <= 40; ++i) {
        const double angle = 2.0 * std::numbers::pi * 1.2 * i / 40.0;
        vessel.points.emplace_back(6.0 * radius * std::cos(angle), 6.0 * radius * std::sin(angle),
                                   1.3 * radius * angle);
        vessel.radii.push_back(radius);
    }
    return make_phantom({.name = "helix",
                         .parts = {{.name = "helix", .shape = vessel}},
                         .imaging = {.spacing = spacing,
                                     .margin = 4.0 * blur.maxCoeff() + 2.0,
                                     .inside = kInside,
                                     .outside = kOutside,
                                     .blur = blur,
                                     .noise = noise * (kInside - kOutside)},
                         .surface_edge = 0.15 * radius});
}

/// Relative error of the volume.
double error_of(const Surface& surface, const Surface& exact) {
    return volume(surface) / volume(exact) - 1.0;
}

Surface with_levels(const Image& image) {
    return extract_surface(image, {}, {.local_levels = true}).surface;
}

Image mapped_image(const Image& image, double factor, double offset) {
    std::vector<float> voxels = *image.voxels;
    for (float& v : voxels) v = static_cast<float>(factor * v + offset);
    Image result = image;
    result.voxels = std::make_shared<const std::vector<float>>(std::move(voxels));
    return result;
}

/// Root mean square distance from the middle of a line of voxels, squared.
double variance_of(const std::vector<float>& line) {
    const double middle = 0.5 * static_cast<double>(line.size() - 1);
    double sum = 0.0, squares = 0.0;
    for (std::size_t i = 0; i < line.size(); ++i) {
        sum += line[i];
        squares += line[i] * std::pow(static_cast<double>(i) - middle, 2);
    }
    return squares / sum;
}

}  // namespace

SCENARIO("A grid is blurred by exactly the variance asked for", "[geometry][image]") {
    for (const double sigma : {0.3, 0.5, 1.0, 2.4, 2.5, 3.3}) {
        std::vector<float> line(61, 0.0f);
        line[30] = 1.0f;
        blur_grid(line, {61, 1, 1}, Vec3(sigma, 0, 0));
        CAPTURE(sigma);
        CHECK(std::accumulate(line.begin(), line.end(), 0.0) == Approx(1.0).epsilon(1e-3));
        CHECK(variance_of(line) == Approx(sigma * sigma).epsilon(0.01));
    }
    std::vector<float> even(8, 3.0f);
    blur_grid(even, {2, 2, 2}, Vec3(1, 2, 3));
    for (const float value : even) CHECK(value == Approx(3.0f).epsilon(1e-3));
}

SCENARIO("Occupancy and crossings add up to a ball's volume and area", "[geometry][image]") {
    for (const Vec3& spacing : {Vec3(0.5, 0.5, 0.5), Vec3(0.4, 0.5, 0.9)}) {
        const Image ball = ball_image(5.0, 41, spacing);
        std::vector<float> inside = *ball.voxels;
        for (float& value : inside) value -= 50.0f;
        const std::vector<WallCrossing> crossings = wall_crossings(ball, inside);
        const std::vector<float> shares = occupancy(ball, inside, crossings);
        const double filled = spacing.prod() * std::accumulate(shares.begin(), shares.end(), 0.0);
        double area = 0.0;
        for (const WallCrossing& c : crossings) area += c.area;
        CAPTURE(spacing.transpose());
        CHECK(filled == Approx(4.0 / 3.0 * std::numbers::pi * 125.0).epsilon(0.01));
        CHECK(area == Approx(4.0 * std::numbers::pi * 25.0).epsilon(0.02));
    }
}

SCENARIO("Local levels give a thin vessel its volume", "[geometry][image]") {
    struct Case {
        double radius;
        Vec3 spacing, blur;
        double noise, most;
    };

    const Vec3 cubic = Vec3::Constant(0.4), slices(0.4, 0.4, 0.8);
    for (const Case& c :
         {Case{1.2, slices, Vec3(0.35, 0.35, 0.6), 0.03, 0.08}, Case{0.8, cubic, cubic, 0.05, 0.08},
          Case{0.8, cubic, 0.5 * cubic, 0.0, 0.08}, Case{1.6, slices, 0.5 * slices, 0.05, 0.03},
          Case{1.2, cubic, cubic, 0.0, 0.03}, Case{2.4, slices, slices, 0.05, 0.03}}) {
        const Phantom phantom = helix(c.radius, c.spacing, c.blur, c.noise);
        const double one = error_of(extract_surface(phantom.image, {}, {}).surface, phantom.exact);
        const double local = error_of(with_levels(phantom.image), phantom.exact);
        CAPTURE(c.radius, c.blur.transpose(), c.noise, one, local);
        CHECK(std::abs(local) < c.most);
    }
}

SCENARIO("Contrast and blur are found along each axis", "[geometry][image]") {
    const Vec3 spacing(0.4, 0.4, 0.8), blur(0.35, 0.35, 0.6);
    const Phantom phantom = helix(1.6, spacing, blur, 0.03);
    const WallLevels wall = find_levels(phantom.image, 300.0, {}).wall;
    CHECK(wall.found.contrast == Approx(kInside - kOutside).epsilon(0.04));
    for (int a = 0; a < 3; ++a) CHECK(wall.found.blur[a] == Approx(blur[a]).epsilon(0.15));
    CHECK(wall.core > 0.95);
    CHECK(wall.volume_error < 0.05);
    CHECK(wall.undetermined == 0.0);
    CHECK(wall.highest < kOutside + 0.52 * (kInside - kOutside));
}

SCENARIO("A vessel that its core does not fill is said to be uncertain", "[geometry][image]") {
    const Vec3 voxel = Vec3::Constant(0.4);
    const WallLevels wall = find_levels(helix(0.6, voxel, voxel, 0.0).image, 200.0, {}).wall;
    CHECK(wall.core < 0.9);
    CHECK(wall.volume_error > 0.05);
}

SCENARIO("Samples of a large image say how far one threshold is off", "[geometry][image]") {
    const Vec3 voxel = Vec3::Constant(0.25);
    const Image image = helix(1.2, voxel, 1.2 * voxel, 0.02).image;
    for (const double threshold : {220.0, 350.0, 450.0}) {
        CAPTURE(threshold);
        const double whole = volume_at_threshold(image, threshold, {}, image.voxel_count());
        CHECK(whole == find_levels(image, threshold, {}).wall.volume_at_threshold);
        CHECK(volume_at_threshold(image, threshold, {}, 100'000) == Approx(whole).margin(0.03));
    }
    CHECK(volume_at_threshold(image, 220.0, {}, 100'000) > 1.05);
}

SCENARIO("Levels follow the image's values", "[geometry][image]") {
    const Vec3 voxel = Vec3::Constant(0.4);
    const Image image = helix(1.0, voxel, 0.8 * voxel, 0.02).image;
    const double truth = volume(with_levels(image));
    CHECK(volume(with_levels(mapped_image(image, 0.25, -40.0))) == Approx(truth).epsilon(1e-3));
    const Surface dark =
        extract_surface(mapped_image(image, -1.0, 0.0), {},
                        {.threshold = -300.0, .local_levels = true, .inside_below = true})
            .surface;
    CHECK(volume(dark) == Approx(truth).epsilon(0.01));
}

SCENARIO("Where an image is like no vessel, one threshold stays", "[geometry][image]") {
    // Tissue that the levels would run into.
    const Image layers = image_of(
        {40, 40, 40}, oblique_matrix(Vec3::Ones(), Vec3::Zero()),
        [middle = Vec3(20, 20, 20)](const Vec3& p) {
            const double r = (p - middle).norm();
            return 1000.0 * std::sin(7.0 * p.x()) * std::sin(5.0 * p.y()) + (r < 6.0 ? 600.0 : 0.0);
        });
    CHECK_THROWS_AS(find_levels(layers, 700.0, {}), AlgorithmFailure);
    const Extraction found =
        extract_surface(layers, {}, {.threshold = 700.0, .local_levels = true});
    CHECK_FALSE(found.levels);
    CHECK_FALSE(found.why_no_levels.empty());
    CHECK(volume(found.surface) ==
          Approx(volume(extract_surface(layers, {}, {.threshold = 700.0}).surface)));
}

SCENARIO("A vessel in too large a box keeps one threshold", "[geometry][image]") {
    Image image;
    image.size = {330, 330, 330};
    std::vector<float> voxels(image.voxel_count(), 0.0f);
    for (int i = 0; i < 330; ++i)
        for (int a = -1; a <= 1; ++a)
            voxels[image.offset(i, i, std::clamp(i + a, 0, 329))] = 100.0f;
    image.voxels = std::make_shared<const std::vector<float>>(std::move(voxels));
    CHECK_THROWS_WITH(find_levels(image, 50.0, {.all = true}), Contains("crop the image"));
}

SCENARIO("The search for levels can be cancelled, and needs a vessel",
         "[geometry][image][cancel]") {
    const Vec3 voxel = Vec3::Constant(0.4);
    const Image image = helix(0.8, voxel, voxel, 0.0).image;
    StopAt stop(0.1);
    CHECK_THROWS_AS(find_levels(image, 300.0, {}, stop.progress()), Cancelled);
    CHECK_THROWS_WITH(find_levels(image, 5000.0, {}), Contains("no voxel is inside"));
}
