#include "geometry/vessel/ends/flat_faces.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "geometry/vessel/repair/repair.h"
#include "tests/support/iso_surface.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

constexpr double kRadius = 4.0;  // [mm]
constexpr double kCell = 0.5;    // [mm]

/// A vessel that comes from below and that a plane at z = 0 has cut.
double flat_end(const Vec3& p) {
    return std::max(capsule(p, {0.0, 0.0, -30.0}, {0.0, 0.0, 10.0}, kRadius), p.z());
}

/// A surface of revolution around z from its top on the axis down to an open rim.
/// \param profile x, z
Surface turned(const std::vector<Vec3>& profile, VertexId around) {
    Positions points = {Vec3(0.0, 0.0, profile.front().z())};
    std::vector<Triangle> triangles;
    for (VertexId ring = 0; ring < profile.size(); ++ring)
        for (VertexId k = 0; k < around; ++k) {
            const double angle = 2.0 * std::numbers::pi * k / around;
            points.emplace_back(profile[ring].x() * std::cos(angle),
                                profile[ring].x() * std::sin(angle), profile[ring].z());
            const VertexId next = (k + 1) % around, low = 1 + ring * around, high = low - around;
            if (ring == 0) {
                triangles.push_back({0, low + k, low + next});
            } else {
                triangles.push_back({high + k, low + k, low + next});
                triangles.push_back({high + k, low + next, high + next});
            }
        }
    return make_surface(std::move(points), std::move(triangles));
}

std::vector<FlatFace> faces_of(const ImplicitShape& shape) {
    const Eigen::AlignedBox3d box(Vec3(-25.1, -10.1, -36.2), Vec3(25.1, 10.1, 24.2));
    return find_flat_faces(repair(iso_surface(shape, box, kCell), {}).surface);
}

}  // namespace

SCENARIO("A planar face that closes a vessel is found", "[geometry][flat_faces]") {
    const auto check_end = [](const std::vector<FlatFace>& faces) {
        REQUIRE(faces.size() == 1);
        CHECK((faces[0].centre - Vec3::Zero()).norm() < 0.5);
        CHECK(faces[0].normal.z() > 0.99);
        CHECK(faces[0].radius == Approx(kRadius).epsilon(0.1));
        CHECK(faces[0].length > 2.0 * kRadius);
    };
    THEN("where its rim is sharp") {
        check_end(faces_of(flat_end));
    }
    THEN("where its rim is rounded by a quarter of the radius") {
        constexpr double kRound = 0.25 * kRadius;
        check_end(faces_of([&](const Vec3& p) {
            const double wall = capsule(p, {0.0, 0.0, -30.0}, {0.0, 0.0, 10.0}, kRadius - kRound);
            const double over = p.z() + kRound;
            return std::hypot(std::max(wall, 0.0), std::max(over, 0.0)) +
                   std::min(std::max(wall, over), 0.0) - kRound;
        }));
    }
    THEN("where its rim is rounded, and its triangles are small") {
        // Each triangle of the rim would grow the whole face.
        constexpr double kRound = 0.2 * kRadius;
        std::vector<Vec3> profile;  // radius, height
        for (int i = 1; i <= 40; ++i) profile.emplace_back((kRadius - kRound) * i / 40.0, 0.0, 0.0);
        for (int i = 1; i <= 16; ++i) {
            const double angle = std::numbers::pi / 2.0 * i / 16.0;
            profile.emplace_back(kRadius - kRound + kRound * std::sin(angle), 0.0,
                                 kRound * (std::cos(angle) - 1.0));
        }
        for (int i = 1; i <= 60; ++i) profile.emplace_back(kRadius, 0.0, -kRound - 0.5 * i);
        check_end(find_flat_faces(turned(profile, 120)));
    }
    THEN("where few triangles lie around it") {
        std::vector<Vec3> profile = {{1.4, 0.0, 0.0}, {2.7, 0.0, 0.0}};
        for (int i = 0; i <= 20; ++i) profile.emplace_back(kRadius, 0.0, -1.5 * i);
        check_end(find_flat_faces(turned(profile, 16)));
    }
    THEN("where a branch leaves sideways close to it") {
        check_end(faces_of([](const Vec3& p) {
            return std::min(flat_end(p),
                            capsule(p, {0.0, 0.0, -7.0}, {12.0, 0.0, -14.0}, 0.4 * kRadius));
        }));
    }
    THEN("where the vessel turns behind it and rises beside it, as an arch does") {
        check_end(faces_of([](const Vec3& p) {
            const double trunk =
                std::max(capsule(p, {0.0, 0.0, -9.0}, {0.0, 0.0, 10.0}, kRadius), p.z());
            return std::min({trunk, capsule(p, {0.0, 0.0, -13.0}, {14.0, 0.0, -13.0}, kRadius),
                             capsule(p, {14.0, 0.0, -13.0}, {14.0, 0.0, 18.0}, kRadius)});
        }));
    }
    THEN("where a thin branch close to it rises over it") {
        check_end(faces_of([](const Vec3& p) {
            return std::min(flat_end(p), capsule(p, {3.0, 0.0, -3.0}, {20.0, 0.0, 14.0}, 0.8));
        }));
    }
}

SCENARIO("A planar face where no vessel ends is none", "[geometry][flat_faces]") {
    THEN("a round end is none") {
        CHECK(faces_of([](const Vec3& p) {
                  return capsule(p, {0.0, 0.0, -30.0}, {0.0, 0.0, 0.0}, kRadius);
              }).empty());
    }
    THEN("a flat place in the side of a vessel that passes is none") {
        CHECK(faces_of([](const Vec3& p) {
                  return std::max(capsule(p, {-20.0, 0.0, -6.0}, {20.0, 0.0, -6.0}, kRadius),
                                  -std::hypot(p.x(), p.y()) > -3.0 ? p.z() + 3.0 : -1e3);
              }).empty());
    }
    THEN("the wall between the daughters of a furcation is none") {
        CHECK(faces_of([](const Vec3& p) {
                  double furcation = flat_end(p);
                  for (const double side : {-1.0, 1.0})
                      furcation = std::min(furcation, capsule(p, {side * 2.0, 0.0, -3.5},
                                                              {side * 20.0, 0.0, 14.0}, 2.0));
                  return furcation;
              }).empty());
    }
}
