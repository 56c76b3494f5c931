#include "tests/support/posing_phantoms.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "geometry/kernel/measure.h"
#include "geometry/kernel/self_intersections.h"
#include "geometry/phantoms/exact_surface.h"
#include "tests/forest/dice.h"

namespace vesselbench::test {

namespace {

using forest::Dice;

constexpr double kCapNormal = 0.9;  ///< cosine of the angle to the end's direction
constexpr double kCapDepth = 0.2;   ///< [edges]

struct End {
    Vec3 point, outward;
    double radius;
};

End end_of(const VesselShape& vessel, bool first) {
    const std::size_t n = vessel.points.size();
    const Vec3 &tip = vessel.points[first ? 0 : n - 1], &inner = vessel.points[first ? 1 : n - 2];
    return {tip, (tip - inner).normalized(), vessel.radii[first ? 0 : n - 1]};
}

/// An end that is not inside another vessel.
bool is_free(const End& end, const std::vector<VesselShape>& vessels, std::size_t own) {
    for (std::size_t v = 0; v < vessels.size(); ++v)
        for (std::size_t i = 0; v != own && i + 1 < vessels[v].points.size(); ++i) {
            const Vec3 a = vessels[v].points[i], side = vessels[v].points[i + 1] - a;
            const double t = std::clamp(side.dot(end.point - a) / side.squaredNorm(), 0.0, 1.0);
            if ((a + t * side - end.point).norm() < 1.5 * vessels[v].radii[i]) return false;
        }
    return true;
}

Surface with_caps(const Surface& surface, const std::vector<End>& ends, double edge) {
    PatchLabels labels(surface.triangle_count(), 0);
    std::vector<Patch> patches = surface.patches;
    for (std::size_t e = 0; e < ends.size(); ++e) {
        patches.push_back(e == 0 ? Patch{"inlet", PatchKind::Inlet}
                                 : Patch{"outlet_" + std::to_string(e), PatchKind::Outlet});
        for (TriangleId t = 0; t < labels.size(); ++t) {
            // Samples of the field put corners of a slanted end a little off its plane.
            const Triangle& corners = surface.triangles()[t];
            bool on = area_normal(surface.points(), corners).normalized().dot(ends[e].outward) >
                      kCapNormal;
            for (const VertexId v : corners) {
                const Vec3 away = surface.points()[v] - ends[e].point;
                on = on && std::abs(away.dot(ends[e].outward)) < kCapDepth * edge &&
                     away.norm() < 1.2 * ends[e].radius;
            }
            if (on) labels[t] = static_cast<std::uint16_t>(e + 1);
        }
    }
    return surface.with_patches(std::move(labels), std::move(patches));
}

/// A smooth random course from the origin along z.
Positions course(Dice& dice, double length, double sway) {
    const Vec3 side = dice.across(Vec3::UnitZ()), other = Vec3::UnitZ().cross(side);
    const double a = dice.between(0.3, 1.0) * sway, b = dice.between(-0.6, 0.6) * sway;
    const double turns = dice.between(0.5, 1.3);
    Positions points;
    for (int i = 0; i <= 24; ++i) {
        const double s = i / 24.0, w = std::sin(std::numbers::pi * turns * s);
        points.push_back(length * s * Vec3::UnitZ() + a * w * w * side +
                         b * std::sin(2.0 * std::numbers::pi * s) * s * other);
    }
    return points;
}

Positions straight(const Vec3& from, const Vec3& to) {
    Positions points;
    for (int i = 0; i <= 12; ++i) points.push_back(from + (to - from) * (i / 12.0));
    return points;
}

/// A trunk along z up to the origin, twice as long as it is wide.
VesselShape trunk(double radius) {
    return vessel_through(straight({0, 0, -9.0 * radius}, Vec3::Zero()), radius);
}

/// A bow that leaves the origin at an angle to z in the plane of `side` and turns by `turn`.
Positions bow(const Vec3& side, double angle, double turn, double length) {
    Positions points = {Vec3::Zero()};
    for (int i = 1; i <= 24; ++i) {
        const double at = angle - turn * (i - 0.5) / 24.0;
        points.push_back(points.back() +
                         length / 24.0 * (std::cos(at) * Vec3::UnitZ() + std::sin(at) * side));
    }
    return points;
}

PosingPhantom moved(Dice& dice, PosingPhantom phantom, const Positions& line) {
    const auto i = static_cast<std::size_t>(dice.whole(14, 22));
    phantom.at = line[i];
    const Vec3 along = (line[i + 1] - line[i - 1]).normalized();
    phantom.move = dice.between(0.5, 3.0) * phantom.radius *
                   (dice.across(along) + dice.between(-0.3, 0.0) * along);
    return phantom;
}

PosingPhantom tree_phantom(Dice& dice, double r) {
    const Vec3 side = dice.across(Vec3::UnitZ());
    const Positions left = bow(side, dice.between(0.5, 0.9), dice.between(-0.3, 0.6), 22.0 * r),
                    right = bow(-side, dice.between(0.5, 0.9), dice.between(-0.3, 0.6), 18.0 * r);
    PosingPhantom phantom{.kind = "tree", .radius = r};
    phantom.surface =
        vessel_surface({trunk(1.3 * r), vessel_through(left, r), vessel_through(right, 0.9 * r)},
                       0.25 * r, 0.4 * r);
    return moved(dice, phantom, left);
}

/// Two branches that leave a trunk and join again.
PosingPhantom loop_phantom(Dice& dice, double r, double height) {
    const Vec3 side = dice.across(Vec3::UnitZ());
    const Vec3 top(0, 0, 20.0 * r);
    Positions left, right;
    for (int i = 0; i <= 24; ++i) {
        const double s = i / 24.0;
        const Vec3 out = height * std::sin(std::numbers::pi * s) * side;
        left.push_back(s * top + out);
        right.push_back(s * top - out);
    }
    PosingPhantom phantom{.kind = "loop", .radius = r, .at = left[12], .move = r * side};
    phantom.refused = true;
    phantom.surface =
        vessel_surface({trunk(1.2 * r), vessel_through(left, r), vessel_through(right, r),
                        vessel_through(straight(top, top + 9.0 * r * Vec3::UnitZ()), 1.2 * r)},
                       0.25 * r);
    return phantom;
}

}  // namespace

VesselShape vessel_through(Positions points, double radius) {
    std::vector<double> radii(points.size(), radius);
    return {.points = std::move(points), .radii = std::move(radii), .flat_ends = true};
}

Surface vessel_surface(const std::vector<VesselShape>& vessels, double edge, double fillet) {
    std::vector<PhantomPart> parts;
    std::vector<End> ends;
    for (std::size_t v = 0; v < vessels.size(); ++v) {
        parts.push_back({"vessel_" + std::to_string(v), vessels[v], v == 0 ? 0.0 : fillet});
        for (const bool first : {true, false})
            if (const End end = end_of(vessels[v], first); is_free(end, vessels, v))
                ends.push_back(end);
    }
    const PhantomField field(parts);
    // Sharp edges of caps come out with folded triangles on some grids.
    Surface surface;
    for (int i = 0; i == 0 || (i < 6 && !self_intersections(surface).empty()); ++i) {
        const double cell = edge * (1.0 - 0.03 * i);
        Eigen::AlignedBox3d box = field.bounds();
        box.min().array() -= 2.0 * cell;
        box.max().array() += 2.0 * cell;
        surface = exact_surface(field, box, cell);
    }
    return with_caps(surface, ends, edge);
}

PosingPhantom deform_phantom(std::uint64_t seed) {
    Dice dice(seed);
    const double r = dice.between(1.0, 2.5);
    switch (seed % 4) {
        case 0: {
            const Positions line = course(dice, 30.0 * r, 6.0 * r);
            PosingPhantom phantom{.kind = "tube", .radius = r};
            phantom.surface = vessel_surface({vessel_through(line, r)}, 0.25 * r);
            return moved(dice, phantom, line);
        }
        case 1:
            return tree_phantom(dice, r);
        case 2: {
            const Positions line =
                bow(dice.across(Vec3::UnitZ()), 0.0, dice.between(0.8, 2.2), 28.0 * r);
            PosingPhantom phantom{.kind = "bow", .radius = r, .at = line[12]};
            phantom.straighten = dice.between(0.3, 1.0);
            phantom.surface = vessel_surface({vessel_through(line, r)}, 0.25 * r);
            return phantom;
        }
        default:
            return loop_phantom(dice, r, 7.0 * r);
    }
}

PosingPhantom gap_phantom(std::uint64_t seed) {
    Dice dice(seed);
    const double r = dice.between(1.0, 2.0);
    const Vec3 side = dice.across(Vec3::UnitZ()), other = Vec3::UnitZ().cross(side);
    const double gap = dice.between(0.15, 0.8);
    PosingPhantom phantom{.kind = "approach", .radius = r, .gap = 1.0};
    std::vector<VesselShape> vessels = {trunk(1.3 * r)};
    // Leaves the trunk widely, comes near halfway, and leaves again.
    const auto out = [&](double s, double far, double near) {
        const double x = 2.0 * s - 1.0;
        return std::min(1.0, s / 0.1) * (near + far * x * x);
    };
    const double length = dice.between(24.0, 34.0) * r;
    switch (seed % 4) {
        case 0:
            for (const double sign : {1.0, -1.0}) {
                Positions line;
                for (int i = 0; i <= 24; ++i) {
                    const double s = i / 24.0;
                    line.push_back(length * s * Vec3::UnitZ() +
                                   sign * out(s, 4.0 * r, r + 0.5 * gap) * side);
                }
                vessels.push_back(vessel_through(line, r));
            }
            break;
        case 1: {
            phantom.kind = "helix";
            const double thin = 0.7 * r, ring = r + thin + gap;
            const double turn = dice.between(2.0, 4.5);
            Positions around;
            for (int i = 0; i <= 40; ++i) {
                const double s = i / 40.0, a = turn * std::max(0.0, s - 0.3);
                const double far = ring + 3.0 * r * std::pow(std::max(0.0, 1.0 - s / 0.45), 2);
                const double rise = std::min(1.0, s / 0.12);
                around.push_back(length * s * Vec3::UnitZ() +
                                 rise * far * (std::cos(a) * side + std::sin(a) * other));
            }
            vessels.push_back(vessel_through(straight(Vec3::Zero(), length * Vec3::UnitZ()), r));
            vessels.push_back(vessel_through(around, thin));
            break;
        }
        case 2: {
            phantom.kind = "parallel";
            Positions line;
            for (int i = 0; i <= 32; ++i) {
                const double s = i / 32.0, rise = std::min(1.0, s / 0.15);
                const double far =
                    2.0 * r + gap + 3.0 * r * std::pow(std::max(0.0, 1.0 - s / 0.5), 2);
                line.push_back(length * s * Vec3::UnitZ() + rise * far * side);
            }
            vessels.push_back(vessel_through(straight(Vec3::Zero(), length * Vec3::UnitZ()), r));
            vessels.push_back(vessel_through(line, r));
            break;
        }
        default: {
            PosingPhantom loop = loop_phantom(dice, r, r + 0.5 * gap);
            loop.gap = 1.0;
            return loop;
        }
    }
    phantom.surface = vessel_surface(vessels, 0.25 * r, 0.3 * r);
    return phantom;
}

}  // namespace vesselbench::test
