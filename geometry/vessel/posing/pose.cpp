#include "geometry/vessel/posing/pose.h"

#include <cmath>

#include "geometry/vessel/centerlines/line_smoothing.h"

namespace vesselbench {

namespace {

/// A bend that the rest has as well, up to this factor, is not new.
constexpr double kSame = 1.02;

Eigen::Quaterniond rotation(const Vec3& vector) {
    const double angle = vector.norm();
    if (angle == 0.0) return Eigen::Quaterniond::Identity();
    return Eigen::Quaterniond(Eigen::AngleAxisd(angle, vector / angle));
}

/// Carries the rod's first point.
struct Start {
    Vec3 point;
    Eigen::Quaterniond turn;
    bool still = false;
};

Start start_of(const Armature& armature, const std::vector<RodPose>& done, const Rod& rod) {
    const bool still =
        !rod.parent || done[*rod.parent].still + 1 == done[*rod.parent].points.size();
    if (still) return {rod.points().front(), Eigen::Quaterniond::Identity(), true};
    const Rod& parent = armature.rods[*rod.parent];
    const RodPose& carrier = done[*rod.parent];
    return {carrier.points.back() +
                carrier.turns.back() * (rod.points().front() - parent.points().back()),
            carrier.turns.back()};
}

/// Segments before the first bend.
std::size_t still_segments(const Rod& rod, std::span<const Vec3> bends) {
    for (std::size_t e = 0; e < rod.elements.size(); ++e)
        if (bends[e] != Vec3::Zero()) return rod.elements[e].first;
    return rod.points().size() - 1;
}

RodPose pose_of(const Rod& rod, const Start& start, std::span<const Vec3> bends) {
    RodPose pose{.points = {start.point}, .turns = {start.turn}};
    if (start.still) pose.still = still_segments(rod, bends);
    std::size_t element = 0;
    for (std::size_t k = 0; k + 1 < rod.points().size(); ++k) {
        while (element < rod.elements.size() && rod.elements[element].last <= k) ++element;
        const Eigen::Quaterniond turn = pose.turns.back();
        if (k < pose.still) {
            pose.points.push_back(rod.points()[k + 1]);
            pose.turns.push_back(turn);
            continue;
        }
        const Vec3 step = rod.points()[k + 1] - rod.points()[k];
        if (element == rod.elements.size() || rod.elements[element].first > k) {
            pose.points.push_back(pose.points.back() + turn * step);
            pose.turns.push_back(turn);
            continue;
        }
        const double share = (rod.along()[k + 1] - rod.along()[k]) / rod.elements[element].length;
        const Vec3 part = share * bends[element];
        pose.points.push_back(pose.points.back() + turn * rotation(0.5 * part) * step);
        pose.turns.push_back((turn * rotation(part)).normalized());
    }
    return pose;
}

/// The section that a point belongs to.
struct Carrier {
    Vec3 centre, moved;
    Eigen::Quaterniond turn;
};

Carrier carrier_of(const RodPose& bent, const Rod& rod, const Binding& binding) {
    const std::size_t i = binding.segment;
    const double t = binding.t;
    return {rod.centre({i, t}), (1.0 - t) * bent.points[i] + t * bent.points[i + 1],
            bent.turns[i].slerp(t, bent.turns[i + 1])};
}

std::vector<double> curvatures(const Rod& rod, const Positions& points) {
    Line line{.points = points, .radii = rod.radii(), .weights = {}};
    line.weights.assign(points.size(), 1.0);
    std::vector<double> found;
    for (const LineFit& fit : fit_line(line, 1.0, 0.0)) found.push_back(fit.curvature.norm());
    return found;
}

}  // namespace

std::size_t element_count(const Armature& armature) {
    std::size_t count = 0;
    for (const Rod& rod : armature.rods) count += rod.elements.size();
    return count;
}

std::vector<RodPose> pose(const Armature& armature, std::span<const Vec3> bends) {
    std::vector<RodPose> poses;
    for (const Rod& rod : armature.rods) {
        poses.push_back(
            pose_of(rod, start_of(armature, poses, rod), bends.first(rod.elements.size())));
        bends = bends.subspan(rod.elements.size());
    }
    return poses;
}

Vec3 carried(std::span<const RodPose> poses, const Armature& armature, const Binding& binding,
             const Vec3& rest) {
    if (binding.rod == Binding::kFixed || binding.segment < poses[binding.rod].still) return rest;
    const Carrier carrier = carrier_of(poses[binding.rod], armature.rods[binding.rod], binding);
    return carrier.moved + carrier.turn * (rest - carrier.centre);
}

Vec3 carried_back(std::span<const RodPose> poses, const Armature& armature, const Binding& binding,
                  const Vec3& here) {
    if (binding.rod == Binding::kFixed) return here;
    const Carrier carrier = carrier_of(poses[binding.rod], armature.rods[binding.rod], binding);
    return carrier.centre + carrier.turn.conjugate() * (here - carrier.moved);
}

Positions posed(const Surface& surface, const Armature& armature, std::span<const RodPose> poses) {
    Positions points = surface.points();
    for (std::size_t v = 0; v < points.size(); ++v)
        points[v] = carried(poses, armature, armature.bindings[v], points[v]);
    return points;
}

std::vector<BentAxis> bent_axes(const Armature& armature, std::span<const RodPose> poses) {
    std::vector<BentAxis> axes;
    for (std::size_t r = 0; r < armature.rods.size(); ++r) {
        const Rod& rod = armature.rods[r];
        BentAxis axis;
        for (std::size_t i = rod.begin; i <= rod.end; ++i) {
            axis.rest.push_back(rod.points()[i]);
            axis.bent.push_back(poses[r].points[i]);
        }
        axes.push_back(std::move(axis));
    }
    return axes;
}

std::optional<SharpBend> too_sharp(const Armature& armature, std::span<const RodPose> poses,
                                   double least) {
    std::optional<SharpBend> sharpest;
    double most = 1.0 / least;
    for (std::size_t r = 0; r < armature.rods.size(); ++r) {
        const Rod& rod = armature.rods[r];
        const std::vector<double> rest = curvatures(rod, rod.points()),
                                  bent = curvatures(rod, poses[r].points);
        for (std::size_t i = rod.begin; i <= rod.end; ++i) {
            if (bent[i] * rod.radii()[i] <= most || bent[i] <= kSame * rest[i]) continue;
            most = bent[i] * rod.radii()[i];
            sharpest = {poses[r].points[i], 1.0 / bent[i], rod.radii()[i]};
        }
    }
    return sharpest;
}

}  // namespace vesselbench
