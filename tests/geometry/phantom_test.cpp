#include "geometry/phantoms/phantom.h"

#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/phantoms/exact_surface.h"
#include "geometry/phantoms/field.h"
#include "geometry/phantoms/imaging.h"
#include "tests/support/shapes.h"
#include "tests/support/stop_at.h"
#include "tests/support/surface_facts.h"

using namespace vesselbench;
using namespace vesselbench::test;
using Catch::Matchers::Contains;

namespace {

PhantomDescription sphere_of(double radius) {
    PhantomDescription description;
    description.parts = {{"sphere", SphereShape{Vec3(1, 2, 3), radius}, 0.0}};
    description.surface_edge = 0.4;
    description.imaging.spacing = Vec3(0.5, 0.5, 1.0);
    return description;
}

double mean_intensity_volume(const Image& image, double inside) {
    double sum = 0.0;
    for (const float v : *image.voxels) sum += v / inside;
    return sum * image.spacing().prod();
}

}  // namespace

SCENARIO("A phantom's exact surface lies on its implicit function", "[geometry][phantom]") {
    const Phantom phantom = make_phantom(sphere_of(5.0));
    const double ball = 4.0 / 3.0 * std::numbers::pi * 125.0;
    THEN("every vertex has the sphere's radius") {
        for (const Vec3& p : phantom.exact.points())
            REQUIRE((p - Vec3(1, 2, 3)).norm() == Approx(5.0).margin(1e-9));
    }
    THEN("it is closed, outward, and its volume is a little below the ball's") {
        CHECK(phantom.exact.topology->boundary_loops().empty());
        CHECK(enclosed_volume(phantom.exact) == Approx(ball).epsilon(0.01));
    }
    THEN("partial volumes and mask both measure the ball") {
        CHECK(mean_intensity_volume(phantom.image, 1000.0) == Approx(ball).epsilon(0.01));
        CHECK(mean_intensity_volume(phantom.mask, 1.0) == Approx(ball).epsilon(0.03));
    }
}

SCENARIO("A phantom is the same each time, and another seed changes the noise",
         "[geometry][phantom]") {
    PhantomDescription description = sphere_of(3.0);
    description.imaging.noise = 10.0;
    const auto first = make_phantom(description), second = make_phantom(description);
    CHECK(*first.image.voxels == *second.image.voxels);
    description.seed = 2;
    CHECK(*first.image.voxels != *make_phantom(description).image.voxels);
}

SCENARIO("A contrast dip darkens its vessel within its reach, most at the wall",
         "[geometry][phantom]") {
    constexpr double kReach = 12.0;  // long beside the radius: the wall lies well within it
    PhantomDescription description;
    description.parts = {{"tube", VesselShape{{Vec3(0, 0, -15), Vec3(0, 0, 15)}, {3.0, 3.0}}, 0.0}};
    const PhantomField field(description.parts);
    const Image whole = phantom_image(description, field);
    description.imaging.dips = {
        {.part = "tube", .centre = Vec3::Zero(), .reach = kReach, .core = 0.3, .wall = 0.8}};
    const Image dark = phantom_image(description, field);
    double core = 1.0, wall = 1.0;
    for (int k = 0; k < dark.size[2]; ++k)
        for (int j = 0; j < dark.size[1]; ++j)
            for (int i = 0; i < dark.size[0]; ++i) {
                const Vec3 p = dark.to_patient(Vec3(i, j, k));
                if (p.norm() > kReach) CHECK(dark.at(i, j, k) == whole.at(i, j, k));
                if (p.norm() > kReach || whole.at(i, j, k) < 1000.0F) continue;
                const double left = dark.at(i, j, k) / 1000.0;
                if (p.norm() < 0.5) core = std::min(core, left);
                wall = std::min(wall, left);
            }
    CHECK(core == Approx(0.7).margin(0.03));
    CHECK(wall < 0.4);
    CHECK(wall > 0.2);
    description.imaging.dips[0].centre = Vec3(9, 0, 0);
    CHECK_THROWS_AS(phantom_image(description, field), InvalidInput);
    description.imaging.dips[0] = {.part = "tube", .reach = 0.0};
    CHECK_THROWS_AS(phantom_image(description, field), InvalidInput);
}

SCENARIO("The field of a blended vessel keeps the vessel's radius away from the blend",
         "[geometry][phantom]") {
    const std::vector<PhantomPart> parts = {
        {"a", VesselShape{{Vec3(0, 0, -20), Vec3(0, 0, 20)}, {2.0, 2.0}}, 0.0},
        {"b", VesselShape{{Vec3(0, 0, 0), Vec3(15, 0, 0)}, {1.0, 1.0}}, 0.5}};
    const PhantomField field(parts);
    CHECK(field(Vec3(0, 2, -12)) == Approx(0.0).margin(1e-12));
    CHECK(field(Vec3(10, 0, 1)) == Approx(0.0).margin(1e-12));
    CHECK(field(Vec3(10, 0, 0)) == Approx(-1.0));
    CHECK_THROWS_AS(field.part("c", Vec3(0, 0, 0)), InvalidInput);
}

SCENARIO("The expert's mask keeps two vessels apart and leaves the rest whole",
         "[geometry][phantom]") {
    PhantomDescription fork = sphere_of(1.0);
    fork.parts = {
        {"stem", VesselShape{{Vec3(0, 0, -12), Vec3(0, 0, 0)}, {2.0, 2.0}}, 0.0},
        {"left", VesselShape{{Vec3(0, 0, 0), Vec3(-1.8, 0, 5), Vec3(-1.7, 0, 14)}, {1.5, 1.5, 1.5}},
         0.0},
        {"right", VesselShape{{Vec3(0, 0, 0), Vec3(1.8, 0, 5), Vec3(1.7, 0, 14)}, {1.5, 1.5, 1.5}},
         0.0}};
    fork.imaging.spacing = Vec3(0.4, 0.4, 0.4);
    const double whole = mean_intensity_volume(make_phantom(fork).mask, 1.0);
    fork.imaging.kept_apart = {{"left", "right", 0.8}};
    const Phantom apart = make_phantom(fork);
    THEN("only a thin strip is missing") {
        const double rest = mean_intensity_volume(apart.mask, 1.0);
        CHECK(rest < whole);
        CHECK(rest > 0.95 * whole);
    }
    THEN("between the branches lies background, in the stem none") {
        const auto label = [&](const Vec3& p) {
            const Vec3 index = apart.mask.to_index(p);
            return apart.mask.at(static_cast<int>(std::lround(index.x())),
                                 static_cast<int>(std::lround(index.y())),
                                 static_cast<int>(std::lround(index.z())));
        };
        CHECK(label(Vec3(0, 0, 12)) == 0.0F);
        CHECK(label(Vec3(0, 0, -3)) == 1.0F);
        CHECK(label(Vec3(-1.7, 0, 12)) == 1.0F);
    }
}

SCENARIO("A phantom that is described badly is refused", "[geometry][phantom]") {
    CHECK_THROWS_AS(make_phantom(PhantomDescription{}), InvalidInput);
    CHECK_THROWS_AS(make_phantom(sphere_of(-1.0)), InvalidInput);
    PhantomDescription flat = sphere_of(1.0);
    flat.imaging.spacing = Vec3(0.5, 0.5, 0.0);
    CHECK_THROWS_AS(make_phantom(flat), InvalidInput);
}

SCENARIO("A phantom too large is refused with its size", "[geometry][phantom]") {
    PhantomDescription large = sphere_of(5.0);
    large.imaging.spacing = Vec3::Constant(0.01);
    CHECK_THROWS_WITH(make_phantom(large), Contains("1600 x 1600 x 1600 voxels") &&
                                               Contains("268 million") && Contains("spacing"));
    large.imaging.spacing = Vec3::Constant(1e-9);  // more than an int can count
    CHECK_THROWS_AS(make_phantom(large), InvalidInput);
    PhantomDescription fine = sphere_of(5.0);
    fine.surface_edge = 1e-4;
    CHECK_THROWS_WITH(make_phantom(fine),
                      Contains("edges of 0.0001 mm") && Contains("268 million"));
    fine.surface_edge = -0.4;
    CHECK_THROWS_WITH(make_phantom(fine), Contains("longer than 0 mm"));
}

SCENARIO("A phantom is cancelled while any of its parts is made", "[geometry][phantom][cancel]") {
    for (const double fraction : {0.1, 0.5, 0.7, 0.8}) {
        StopAt stop(fraction);
        CAPTURE(fraction);
        CHECK_THROWS_AS(make_phantom(sphere_of(5.0), stop.progress()), Cancelled);
    }
}
