#include "geometry/vessel/tree/tube.h"

#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "geometry/vessel/tree/tube_fit.h"

using namespace vesselbench;

namespace {

constexpr double kBend = 10.0, kTurn = 2.0;  // of an arc [mm], [rad]

/// An arc in the x-z plane, at first along z, in so many steps.
Tube bend(double radius, double end_radius, int steps = 400) {
    Positions points;
    std::vector<double> radii;
    for (int i = 0; i <= steps; ++i) {
        const double t = static_cast<double>(i) / steps, turn = kTurn * t;
        points.emplace_back(kBend * (1.0 - std::cos(turn)), 0.0, kBend * std::sin(turn));
        radii.push_back((1.0 - t) * radius + t * end_radius);
    }
    return {std::move(points), std::move(radii), Vec3::UnitY()};
}

using Fit = TubeFit<3, 2>;

/// Of a tapering, flattened wall around a bent line off the axis; scattered by about `noise`, and
/// one in so many points farther off by `outlier`.
std::vector<TubeSample> scattered_wall(double noise, std::size_t one_in, double outlier) {
    std::vector<TubeSample> wall;
    for (std::size_t i = 0; i < 600; ++i) {
        const double n = static_cast<double>(i), z = 2.0 * std::fmod(0.7548777 * n, 1.0) - 1.0;
        const double angle = 2.0 * std::numbers::pi * std::fmod(0.5698403 * n, 1.0);
        const Eigen::Vector2d out(std::cos(angle), std::sin(angle));
        const double odd = i % one_in == 0 ? outlier : 0.0;
        const double distance = 1.0 - 0.1 * z + 0.08 * std::cos(2.0 * angle) +
                                out.dot(Eigen::Vector2d(0.05 + 0.2 * z * z, -0.03 * z)) +
                                noise * std::sqrt(2.0) * std::sin(127.1 * n) + odd;
        wall.push_back({.along = z, .angle = angle, .distance = distance, .out = out});
    }
    return wall;
}

Fit fitted(const std::vector<TubeSample>& wall, const TubeWeights& how = {}) {
    return {wall, 0.1, how, Fit::Normal::Zero(), Fit::Unknowns::Zero()};
}

/// Largest difference of the fit from what scattered_wall is made of.
double largest_error(const Fit& fit) {
    Fit::Unknowns truth;
    truth << 0.05, 0.0, 0.2, 0.0, -0.03, 0.0, 1.0, -0.1, 0.0, 0.08, 0.0;
    return (fit.unknowns - truth).cwiseAbs().maxCoeff();
}

}  // namespace

SCENARIO("A bent tube knows length, radius and direction", "[geometry][tube]") {
    const Tube tube = bend(2.0, 1.0);
    CHECK(tube.length() == Approx(kBend * kTurn).epsilon(1e-4));
    CHECK(tube.radius(0.5 * tube.length()) == Approx(1.5));
    CHECK(tube.radius(-1.0) == 2.0);
    CHECK(tube.radius(1e3) == 1.0);
    const AxisPlace middle = tube.at(0.5 * tube.length());
    const double turn = 0.5 * kTurn;
    CHECK((tube.tangent(middle) - Vec3(std::sin(turn), 0, std::cos(turn))).norm() < 1e-3);
    THEN("its frame does not turn around it") {
        for (double s = 0.0; s <= tube.length(); s += 1.0)
            CHECK((tube.first(tube.at(s)) - Vec3::UnitY()).norm() < 1e-9);
    }
    THEN("beyond its end it goes straight on") {
        const Vec3 end = tube.points().back(), way(std::sin(kTurn), 0, std::cos(kTurn));
        CHECK((tube.centre(tube.at(tube.length() + 3.0)) - (end + 3.0 * way)).norm() < 0.02);
    }
}

SCENARIO("A place and its coordinates in a tube name each other", "[geometry][tube]") {
    const Tube tube = bend(2.0, 1.0);
    for (const double along : {1.0, 7.3, 19.0})
        for (const double angle : {-2.5, 0.0, 1.0})
            for (const double height : {-0.4, 0.0, 0.7}) {
                const TubeCoordinates at = tube.coordinates(tube.position(along, angle, height));
                CHECK(at.along == Approx(along).margin(0.02));
                CHECK(at.angle == Approx(angle).margin(1e-3));
                CHECK(at.height == Approx(height).margin(2e-3));
                CHECK(at.radius == Approx(tube.radius(along)).margin(2e-3));
            }
    THEN("turned to a point, its angle there is 0") {
        const Vec3 x = tube.position(12.0, 2.0, 0.5);
        CHECK(tube.turned_to(x).coordinates(x).angle == Approx(0.0).margin(5e-3));
    }
}

SCENARIO("The nearest wall may be that of a wider place", "[geometry][tube]") {
    const Tube cone({Vec3(0, 0, 0), Vec3(0, 0, 10)}, {6.0, 1.0});
    const Vec3 x(8, 0, 5);
    const auto [place, height] = cone.nearest_wall(x);
    const TubeCoordinates at = cone.coordinates(x);
    CHECK(at.along == Approx(5.0));
    CHECK(at.height == Approx(4.5));
    CHECK(cone.height(x) == height);
    CHECK(cone.height(x) <= at.height);
    CHECK(cone.along(place) == Approx(5.0));
    const Tube stepped({Vec3(0, 0, 0), Vec3(0, 0, 4), Vec3(0, 0, 5), Vec3(0, 0, 10)}, {5, 5, 1, 1});
    CHECK(stepped.nearest_wall(Vec3(6, 0, 5.5)).first.segment == 0);
    CHECK(stepped.nearest(Vec3(6, 0, 5.5)).segment == 2);
}

SCENARIO("Only the segments that are asked for are searched", "[geometry][tube]") {
    const Tube hairpin({Vec3(0, 0, 0), Vec3(0, 0, 9), Vec3(1, 0, 9), Vec3(1, 0, 0)}, {});
    const Vec3 x(0.9, 0, 1);
    CHECK(hairpin.nearest(x).segment == 2);
    CHECK(hairpin.nearest(x, 0, 1).segment == 0);
    CHECK(hairpin.along(hairpin.nearest(x, 0, 1)) == Approx(1.0));
}

SCENARIO("A tube is fitted to a scattered wall", "[geometry][tube]") {
    const Fit clean = fitted(scattered_wall(0.0, 1000, 0.0), {.least = 1e-9});
    CHECK(largest_error(clean) < 1e-8);
    const Fit noisy = fitted(scattered_wall(0.01, 1000, 0.0), {.least = 1e-4});
    CHECK(largest_error(noisy) < 0.004);
    CHECK(noisy.scatter == Approx(0.01).epsilon(0.15));
    THEN("its doubt is that of so many points") {
        const double doubt = std::sqrt(noisy.spread(Fit::kRadiusAt, Fit::kRadiusAt));
        CHECK(doubt > 0.01 / std::sqrt(600.0));
        CHECK(doubt < 0.03 / std::sqrt(600.0));
    }
}

SCENARIO("A bump does not draw the tube towards it", "[geometry][tube]") {
    const auto wall = scattered_wall(0.01, 8, 0.4);
    const Fit robust = fitted(wall, {.least = 1e-4});
    CHECK(largest_error(robust) < 0.005);
    CHECK(robust.rest[8] == Approx(0.4).margin(0.03));
    CHECK(robust.deviation < 0.025);
    CHECK(largest_error(fitted(wall, {.rounds = 1})) > 0.04);
}

SCENARIO("A tube is fitted to two rings of a coarse wall", "[geometry][tube]") {
    std::vector<TubeSample> wall;
    for (int i = 0; i < 60; ++i) {
        const double angle = i * std::numbers::pi / 15.0;
        wall.push_back({.along = i < 30 ? -1.0 : 1.0,
                        .angle = angle,
                        .distance = i < 30 ? 1.1 : 0.9,
                        .out = {std::cos(angle), std::sin(angle)}});
    }
    const Fit fit = fitted(wall, {.least = 0.004, .ridge = 1e-10});
    REQUIRE(fit.determined);
    CHECK(fit.rest.cwiseAbs().maxCoeff() < 1e-6);
    THEN("the smallest tube through them is taken") {
        CHECK(fit.unknowns[Fit::kRadiusAt + 1] == Approx(-0.1));
        CHECK(fit.unknowns[Fit::kRadiusAt] == Approx(fit.unknowns[Fit::kRadiusAt + 2]));
    }
}
