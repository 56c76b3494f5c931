#include "tests/support/crowded_contacts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <vector>

#include "geometry/kernel/edges.h"
#include "geometry/kernel/surface_distance.h"
#include "tests/support/touching_vessels.h"

namespace vesselbench::test {

namespace {

constexpr double kBlend = 0.8;  ///< width over which walls that touch are blended [mm]

double smooth_minimum(double a, double b) {
    const double near = std::max(kBlend - std::abs(a - b), 0.0);
    return std::min(a, b) - near * near / (4.0 * kBlend);
}

struct Tube {
    Vec3 from, to;
    double radius;

    [[nodiscard]] double operator()(const Vec3& p) const { return capsule(p, from, to, radius); }

    /// Where the axis, made longer, leaves the surface at its end.
    [[nodiscard]] Vec3 tip(bool first) const {
        const Vec3 out = (first ? Vec3(from - to) : Vec3(to - from)).normalized();
        return (first ? from : to) + radius * out;
    }
};

class Draw {
public:
    explicit Draw(std::uint64_t number) : engine_(number * 2654435761U + 17U) {}

    double in(double low, double high) {
        const double share = static_cast<double>(engine_() >> 11U) * 0x1.0p-53;
        return low + share * (high - low);
    }

private:
    std::mt19937_64 engine_;
};

struct Plan {
    std::vector<Tube> own;    ///< one vessel with its branches
    std::vector<Tube> other;  ///< those that touch it
    Positions poles = {};
    Vec3 place = Vec3::Zero();
};

Tube through(const Vec3& middle, const Vec3& direction, double half, double radius) {
    return {middle - half * direction, middle + half * direction, radius};
}

Vec3 at_angle(double degrees) {
    const double angle = degrees * std::numbers::pi / 180.0;
    return {std::cos(angle), std::sin(angle), 0.0};
}

constexpr double kPoint = 1e-6;    ///< length of what is a sphere [mm]
constexpr double kThinnest = 0.5;  ///< radius of a vessel [mm]
constexpr double kHalf = 14.0;     ///< of a vessel's length [mm]

Plan sac_plan(Draw& draw) {
    const double parent = draw.in(1.5, 2.5), dome = parent * draw.in(0.9, 2.0),
                 passing = draw.in(1.2, 2.5), tilt = draw.in(0.0, 75.0) * std::numbers::pi / 180.0;
    const Vec3 centre(0, 0, 0.6 * parent + 0.75 * dome);
    const Vec3 out(0.0, std::sin(tilt), std::cos(tilt));
    Plan plan{.own = {through(Vec3::Zero(), Vec3::UnitX(), kHalf, parent),
                      {centre, centre + kPoint * out, dome}}};
    const double gap = draw.in(-0.2, 0.3);
    const Vec3 side = Vec3::UnitX(), up = out.cross(side);
    const double turn = draw.in(20.0, 90.0) * std::numbers::pi / 180.0;
    const Vec3 along = std::cos(turn) * side + std::sin(turn) * up;
    plan.other = {through(centre + (dome + gap + passing) * out, along, kHalf, passing)};
    plan.poles = {centre + dome * Vec3(0.0, -std::sin(0.8), std::cos(0.8)),
                  centre + Vec3(dome, 0, 0), centre - Vec3(dome, 0, 0)};
    plan.place = centre + (dome + 0.5 * gap) * out;
    return plan;
}

Plan furcation_plan(Draw& draw) {
    const double parent = draw.in(1.6, 2.5), angle = draw.in(25.0, 50.0);
    const double short_length = draw.in(2.0, 4.0) * parent;
    const bool is_short = draw.in(0.0, 1.0) < 0.4;
    const double first = 0.8 * parent, second = draw.in(0.55, 0.85) * parent;
    Plan plan{
        .own = {{Vec3(-kHalf, 0, 0), Vec3::Zero(), parent},
                {Vec3::Zero(), kHalf * at_angle(angle), first},
                {Vec3::Zero(), (is_short ? short_length : kHalf) * at_angle(-angle), second}}};
    const double passing = draw.in(1.2, 2.2), gap = draw.in(-0.2, 0.3),
                 away = draw.in(0.8, 3.0) * parent;
    const bool at_parent = draw.in(0.0, 1.0) < 0.5;
    const Vec3 on_axis = at_parent ? Vec3(-away, 0, 0) : Vec3(away * at_angle(angle));
    const double below = at_parent ? parent : first;
    const Vec3 along = at_angle(draw.in(30.0, 90.0) + (at_parent ? 0.0 : angle));
    plan.other = {through(on_axis + Vec3(0, 0, below + gap + passing), along, kHalf, passing)};
    plan.place = on_axis + Vec3(0, 0, below + 0.5 * gap);
    return plan;
}

Plan third_plan(Draw& draw) {
    const double first = draw.in(1.5, 2.2), second = draw.in(1.3, 2.2), third = draw.in(1.2, 2.0);
    const double gap = draw.in(-0.2, 0.2);
    Plan plan{.own = {through(Vec3::Zero(), Vec3::UnitX(), kHalf, first)}};
    const Vec3 along = at_angle(draw.in(40.0, 90.0));
    plan.other = {
        through({0, 0, first + gap + second}, along, kHalf, second),
        through({draw.in(1.0, 2.5) * (first + third), 0, first + draw.in(-0.2, 0.4) + third},
                at_angle(draw.in(50.0, 130.0)), kHalf, third)};
    plan.place = {0, 0, first + 0.5 * gap};
    return plan;
}

Plan thread_plan(Draw& draw) {
    const double first = draw.in(1.2, 2.2), second = draw.in(1.0, 2.0), gap = draw.in(1.0, 3.0);
    const double apart = first + gap + second;
    Plan plan{.own = {through(Vec3::Zero(), Vec3::UnitX(), kHalf, first)}};
    plan.other = {through({0, 0, apart}, at_angle(draw.in(0.0, 90.0)), kHalf, second),
                  {{0, 0, 0}, {0, 0, apart}, draw.in(0.2, 0.4)}};
    plan.place = {0, 0, first + 0.5 * gap};
    return plan;
}

Plan plan_of(Crowd crowd, Draw& draw) {
    if (crowd == Crowd::Sac) return sac_plan(draw);
    if (crowd == Crowd::Thread) return thread_plan(draw);
    return crowd == Crowd::Furcation ? furcation_plan(draw) : third_plan(draw);
}

double least(const std::vector<Tube>& tubes, const Vec3& p) {
    double value = std::numeric_limits<double>::infinity();
    for (const Tube& tube : tubes) value = std::min(value, tube(p));
    return value;
}

}  // namespace

CrowdedContact crowded_contact(Crowd crowd, std::uint64_t number, double cell) {
    Draw draw(number);
    const Plan plan = plan_of(crowd, draw);
    CrowdedContact made{.place = plan.place, .kept = plan.poles, .thinnest = 1e9};
    made.vessels.assign(plan.poles.size(), 0);
    Eigen::AlignedBox3d box;
    int vessel = 0;  // the branches of the first are one
    for (const auto* tubes : {&plan.own, &plan.other})
        for (const Tube& tube : *tubes) {
            for (const Vec3& p : {tube.from, tube.to}) {
                box.extend(Vec3(p.array() - tube.radius - 1.0));
                box.extend(Vec3(p.array() + tube.radius + 1.0));
            }
            if (tube.radius < kThinnest) continue;  // a thread, which ends in the vessels
            made.thinnest = std::min(made.thinnest, tube.radius);
            if ((tube.from - tube.to).norm() < tube.radius) continue;  // a sac
            // Vessels join at the origin.
            if (tubes == &plan.other) ++vessel;
            if (tube.from != Vec3::Zero()) made.kept.push_back(tube.tip(true));
            if (tube.to != Vec3::Zero()) made.kept.push_back(tube.tip(false));
            made.vessels.resize(made.kept.size(), vessel);
        }
    made.surface = solid_of(
        [&](const Vec3& p) { return smooth_minimum(least(plan.own, p), least(plan.other, p)); },
        box, cell);
    return made;
}

bool cuts_vessel(const CrowdedContact& contact, const Surface& after) {
    const SurfaceDistance wall(after);
    const Components parts = connected_components(*after.topology);
    std::map<int, std::uint32_t> part_of;
    for (std::size_t i = 0; i < contact.kept.size(); ++i) {
        const auto part = parts.of_triangle[wall.closest_point(contact.kept[i]).triangle];
        if (part_of.try_emplace(contact.vessels[i], part).first->second != part) return true;
    }
    return false;
}

double farthest_kept(const CrowdedContact& contact, const Surface& after) {
    const SurfaceDistance was(contact.surface), wall(after);
    double farthest = 0.0;
    for (const Vec3& p : contact.kept)  // an end may lie within another vessel
        farthest =
            std::max(farthest, wall.closest_point(p).distance - was.closest_point(p).distance);
    return farthest;
}

}  // namespace vesselbench::test
