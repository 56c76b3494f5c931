#include "meshing/products/print_check.h"

#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "tests/support/shapes.h"

using namespace vesselbench;

SCENARIO("the print check measures size, thinnest place and gap", "[meshing][print]") {
    GIVEN("a tube of radius 1.5 mm with a waist of 1 mm") {
        const Surface tube = test::mapped(test::fine_tube(1.5, 20.0, 36), [](const Vec3& p) {
            const double waist = 1.0 - std::exp(-0.25 * (p.z() - 8.0) * (p.z() - 8.0)) / 3.0;
            return Vec3(p.x() * waist, p.y() * waist, p.z());
        });
        const PrintCheck check = print_check(tube);
        THEN("it is printable, and the waist is the thinnest place") {
            CHECK(check.printable());
            CHECK(check.size.z() == Approx(20.0));
            REQUIRE(check.lumen.has_value());
            CHECK(check.lumen->distance == Approx(2.0).epsilon(0.02));
            CHECK(check.lumen->from.z() == Approx(8.0).margin(0.5));
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
            CHECK(check.printable());
            REQUIRE(check.gap.has_value());
            CHECK(check.gap->distance == Approx(2.0).epsilon(0.02));
            CHECK(check.gap->from.z() < 0.0);
        }
    }
    GIVEN("an open tube") {
        THEN("it is not printable") {
            CHECK_FALSE(print_check(test::open_tube(1.0, 5.0, 12, 6)).printable());
        }
    }
}
