#include "meshing/products/print_check.h"

#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "geometry/kernel/errors.h"
#include "geometry/vessel/centerlines/bends.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_facts.h"

using namespace vesselbench;

SCENARIO("the print check measures size, thinnest place and gap", "[meshing][print]") {
    GIVEN("a tube of radius 1.5 mm with a waist of 1 mm") {
        const Surface tube = test::mapped(test::fine_tube(1.5, 20.0, 36), [](const Vec3& p) {
            const double waist = 1.0 - std::exp(-0.25 * (p.z() - 8.0) * (p.z() - 8.0)) / 3.0;
            return Vec3(p.x() * waist, p.y() * waist, p.z());
        });
        const PrintCheck check = print_check(tube);
        THEN("it is printable, and the waist is the thinnest place") {
            CHECK(check.is_printable(0.8, 0.5));
            CHECK(check.size.z() == Approx(20.0));
            REQUIRE(check.lumen.has_value());
            CHECK(check.lumen->distance == Approx(2.0).epsilon(0.02));
            CHECK(check.lumen->from.z() == Approx(8.0).margin(0.5));
        }
        THEN("it is not for a printer that makes no walls of 2 mm") {
            CHECK(check.is_watertight());
            CHECK_FALSE(check.is_printable(2.2, 0.5));
        }
        THEN("a convex tube has no gap") {
            CHECK_FALSE(check.gap.has_value());
        }
    }
    GIVEN("a hairpin: two legs 2 mm apart, joined by a bend") {
        const double leg = 8.0, bend = 2.0, length = 2.0 * leg + bend * std::numbers::pi;
        const Surface hairpin = test::mapped(test::fine_tube(1.0, length, 24), [&](const Vec3& p) {
            const double beyond = p.z() - leg, angle = beyond / bend;
            if (beyond < 0.0) return Vec3(bend + p.x(), p.y(), beyond);
            if (angle > std::numbers::pi)
                return Vec3(-bend - p.x(), p.y(), leg + bend * std::numbers::pi - p.z());
            return Vec3((bend + p.x()) * std::cos(angle), p.y(), (bend + p.x()) * std::sin(angle));
        });
        const PrintCheck check = print_check(hairpin);
        THEN("the gap between the legs is found, not the fold in the bend") {
            CHECK(check.is_printable(0.8, 0.5));
            CHECK_FALSE(check.is_printable(0.8, 2.2));
            REQUIRE(check.gap.has_value());
            CHECK(check.gap->distance == Approx(2.0).epsilon(0.02));
            CHECK(check.gap->from.z() < 0.0);
        }
    }
    GIVEN("an open tube") {
        THEN("it is not watertight") {
            CHECK_FALSE(print_check(test::open_tube(1.0, 5.0, 12, 6)).is_watertight());
        }
    }
}

SCENARIO("each narrow gap between two vessels is one place", "[meshing][print]") {
    const auto beside = [](double gap) {
        return test::merged(test::fine_tube(1.0, 12.0, 24),
                            test::mapped(test::fine_tube(1.0, 12.0, 24), [&](const Vec3& p) {
                                return Vec3(p + Vec3(2.0 + gap, 0, 0));
                            }));
    };
    const auto gaps = narrow_gaps(beside(0.3), 0.5);
    REQUIRE(gaps.size() == 1);
    CHECK(gaps[0].distance == Approx(0.3).margin(0.02));
    CHECK(narrow_gaps(beside(0.3), 0.2).empty());
    CHECK(narrow_gaps(test::fine_tube(1.0, 12.0, 24), 0.5).empty());
    CHECK_THROWS_AS(narrow_gaps(beside(0.3), 0.0), InvalidInput);
}

SCENARIO("the strongest bend of a vessel is found", "[meshing][print]") {
    GIVEN("a line that bends by a circle of twice the vessel's radius") {
        const double radius = 1.0, bend = 2.0;
        CenterlineBranch branch;
        const auto add = [&](const Vec3& p) {
            branch.points.push_back(p);
            branch.radii.push_back(radius);
        };
        for (int i = -100; i < 0; ++i) add(Vec3(bend, 0.1 * i, 0.0));
        for (int i = 0; i <= 90; ++i)
            add(bend * Vec3(std::cos(i * std::numbers::pi / 90.0),
                            std::sin(i * std::numbers::pi / 90.0), 0.0));
        for (int i = 1; i <= 100; ++i) add(Vec3(-bend, -0.1 * i, 0.0));
        const auto found = strongest_bend({.nodes = {}, .branches = {branch}});
        THEN("it turns by a diameter over the bend's radius, inside the arc") {
            REQUIRE(found.has_value());
            CHECK(found->turn_deg == Approx(180.0 / std::numbers::pi).epsilon(0.01));
            CHECK(found->place.y() > 0.0);
        }
    }
    GIVEN("a line shorter than two diameters") {
        const CenterlineBranch stub{.points = {Vec3(0, 0, 0), Vec3(0, 0, 1), Vec3(0, 0, 2)},
                                    .radii = {1.0, 1.0, 1.0}};
        CHECK_FALSE(strongest_bend({.nodes = {}, .branches = {stub}}).has_value());
    }
}
