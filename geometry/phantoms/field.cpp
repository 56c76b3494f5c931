#include "geometry/phantoms/field.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "geometry/kernel/errors.h"

namespace vesselbench {

namespace {

/// Straight segments per span of a vessel's curve: fine enough to keep chord errors below 1e-3
/// radii.
constexpr int kPiecesPerSpan = 24;
/// Step of the central differences [mm].
constexpr double kGradientStep = 1e-5;

struct Solid {
    std::string name;
    double blend = 0.0;
    std::function<double(const Vec3&)> distance;
    Eigen::AlignedBox3d box;
};

/// Centripetal Catmull-Rom interpolation (Barry and Goldman 1988) of points and radii together.
Eigen::Vector4d catmull_rom(const Eigen::Vector4d* p, double u) {
    double t[4] = {0.0, 0.0, 0.0, 0.0};
    for (int i = 1; i < 4; ++i) {
        const double chord = (p[i] - p[i - 1]).head<3>().norm();
        t[i] = t[i - 1] + std::max(std::sqrt(chord), 1e-9);
    }
    const double s = t[1] + u * (t[2] - t[1]);
    const auto mix = [&](const Eigen::Vector4d& a, const Eigen::Vector4d& b, int i,
                         int j) -> Eigen::Vector4d {
        return a * ((t[j] - s) / (t[j] - t[i])) + b * ((s - t[i]) / (t[j] - t[i]));
    };
    const Eigen::Vector4d a1 = mix(p[0], p[1], 0, 1), a2 = mix(p[1], p[2], 1, 2),
                          a3 = mix(p[2], p[3], 2, 3);
    const Eigen::Vector4d b1 = mix(a1, a2, 0, 2), b2 = mix(a2, a3, 1, 3);
    return mix(b1, b2, 1, 2);
}

std::vector<Eigen::Vector4d> dense_curve(const VesselShape& vessel) {
    std::vector<Eigen::Vector4d> knots;
    for (std::size_t i = 0; i < vessel.points.size(); ++i)
        knots.emplace_back(vessel.points[i].x(), vessel.points[i].y(), vessel.points[i].z(),
                           vessel.radii[i]);
    if (knots.size() == 2) return knots;
    // Mirrored end knots make the curve start and end in the direction of its first and last chord.
    knots.insert(knots.begin(), 2.0 * knots[0] - knots[1]);
    knots.push_back(2.0 * knots.back() - knots[knots.size() - 2]);
    knots.front()[3] = knots[1][3];
    knots.back()[3] = knots[knots.size() - 2][3];
    std::vector<Eigen::Vector4d> curve;
    for (std::size_t k = 0; k + 3 < knots.size(); ++k)
        for (int i = 0; i < kPiecesPerSpan; ++i)
            curve.push_back(catmull_rom(&knots[k], static_cast<double>(i) / kPiecesPerSpan));
    curve.push_back(knots[knots.size() - 2]);
    return curve;
}

/// A vessel's curve as round cones, in groups with a bounding sphere each, so that a distant group
/// costs one distance.
class RoundCones {
public:
    explicit RoundCones(std::vector<Eigen::Vector4d> curve) : curve_(std::move(curve)) {
        for (std::size_t i = 0; i + 1 < curve_.size(); ++i) {
            const Vec3 axis = (curve_[i + 1] - curve_[i]).head<3>();
            pieces_.push_back({curve_[i].head<3>(), axis, axis.squaredNorm(), curve_[i][3],
                               curve_[i + 1][3] - curve_[i][3]});
        }
        for (std::size_t first = 0; first + 1 < curve_.size(); first += kGroup) {
            const std::size_t last = std::min(first + kGroup, curve_.size() - 1);
            Eigen::AlignedBox3d box;
            double thickest = 0.0;
            for (std::size_t i = first; i <= last; ++i) {
                box.extend(Vec3(curve_[i].head<3>()));
                thickest = std::max(thickest, curve_[i][3]);
            }
            const double reach = 0.5 * box.diagonal().norm() + thickest;
            groups_.push_back({first, last, box.center(), reach * kSlack});
        }
    }

    [[nodiscard]] double distance(const Vec3& p) const {
        // The nearest sphere first: what it holds is nearer than most of the others.
        const Group* first = &groups_.front();
        double least = std::numeric_limits<double>::infinity();
        for (const Group& group : groups_) {
            const double power = (p - group.centre).squaredNorm() - group.reach * group.reach;
            if (power >= least) continue;
            least = power;
            first = &group;
        }
        double nearest = distance_to_group(*first, p);
        for (const Group& group : groups_) {
            // not negative: no piece is deeper than its own radius
            const double within = nearest + group.reach;
            if (&group != first && (p - group.centre).squaredNorm() < within * within)
                nearest = std::min(nearest, distance_to_group(group, p));
        }
        return nearest;
    }

    /// Distance of p beyond the planes through both ends of the curve; negative between them.
    [[nodiscard]] double beyond_ends(const Vec3& p) const {
        const auto beyond = [&](const Eigen::Vector4d& end, const Eigen::Vector4d& before) {
            return (p - Vec3(end.head<3>())).dot((end - before).head<3>().normalized());
        };
        return std::max(beyond(curve_.front(), curve_[1]),
                        beyond(curve_.back(), curve_[curve_.size() - 2]));
    }

private:
    static constexpr std::size_t kGroup = 8;
    static constexpr double kSlack = 1.0 + 1e-12;  ///< rounding must not leave out a piece

    struct Group {
        std::size_t first, last;
        Vec3 centre;
        double reach;
    };

    struct Piece {
        Vec3 start, axis;  ///< [mm], from start to the end
        double squared;    ///< of the axis' length [mm^2]
        double radius;     ///< at the start [mm]
        double widening;   ///< from start to end [mm]
    };

    [[nodiscard]] static double distance_to_piece(const Piece& piece, const Vec3& p) {
        const double u = std::clamp((p - piece.start).dot(piece.axis) / piece.squared, 0.0, 1.0);
        return (p - piece.start - u * piece.axis).norm() - (piece.radius + u * piece.widening);
    }

    [[nodiscard]] double distance_to_group(const Group& group, const Vec3& p) const {
        double nearest = std::numeric_limits<double>::infinity();
        for (std::size_t i = group.first; i < group.last; ++i)
            nearest = std::min(nearest, distance_to_piece(pieces_[i], p));
        return nearest;
    }

    std::vector<Eigen::Vector4d> curve_;
    std::vector<Piece> pieces_;
    std::vector<Group> groups_;
};

struct MakeSolid {
    Solid operator()(const VesselShape& vessel) const {
        if (vessel.points.size() < 2 || vessel.radii.size() != vessel.points.size())
            throw InvalidInput(
                "a phantom's vessel needs at least two points, each with its radius");
        for (const double r : vessel.radii) require_positive(r);
        Solid solid;
        auto curve = dense_curve(vessel);
        for (const auto& knot : curve) {
            solid.box.extend(Vec3(knot.head<3>()) - Vec3::Constant(knot[3]));
            solid.box.extend(Vec3(knot.head<3>()) + Vec3::Constant(knot[3]));
        }
        solid.distance = [cones = RoundCones(std::move(curve)),
                          flat = vessel.flat_ends](const Vec3& p) {
            const double distance = cones.distance(p);
            return flat ? std::max(distance, cones.beyond_ends(p)) : distance;
        };
        return solid;
    }

    Solid operator()(const SphereShape& sphere) const {
        require_positive(sphere.radius);
        Solid solid;
        solid.box = {sphere.centre - Vec3::Constant(sphere.radius),
                     sphere.centre + Vec3::Constant(sphere.radius)};
        solid.distance = [sphere](const Vec3& p) {
            return (p - sphere.centre).norm() - sphere.radius;
        };
        return solid;
    }

    Solid operator()(const BoxShape& box) const {
        require_positive(box.half_size.minCoeff());
        Solid solid;
        solid.box = {box.centre - box.half_size, box.centre + box.half_size};
        solid.distance = [box](const Vec3& p) {
            const Vec3 q = (p - box.centre).cwiseAbs() - box.half_size;
            return q.cwiseMax(0.0).norm() + std::min(q.maxCoeff(), 0.0);
        };
        return solid;
    }

    Solid operator()(const TorusShape& torus) const {
        require_positive(torus.tube_radius);
        require_positive(torus.ring_radius);
        Solid solid;
        const double reach = torus.ring_radius + torus.tube_radius;
        solid.box = {torus.centre - Vec3::Constant(reach), torus.centre + Vec3::Constant(reach)};
        solid.distance = [torus, axis = Vec3(torus.axis.normalized())](const Vec3& p) {
            const Vec3 d = p - torus.centre;
            const double height = d.dot(axis);
            const double across = (d - height * axis).norm() - torus.ring_radius;
            return std::hypot(across, height) - torus.tube_radius;
        };
        return solid;
    }

    static void require_positive(double size) {
        if (!(size > 0.0)) throw InvalidInput("a phantom's radii and sizes must be greater than 0");
    }
};

double smooth_minimum(double a, double b, double width) {
    if (width <= 0.0) return std::min(a, b);
    const double h = std::max(width - std::abs(a - b), 0.0) / width;
    return std::min(a, b) - h * h * width * 0.25;
}

}  // namespace

struct PhantomField::Impl {
    std::vector<Solid> solids;
};

PhantomField::PhantomField(std::span<const PhantomPart> parts) {
    if (parts.empty()) throw InvalidInput("a phantom needs at least one part");
    auto impl = std::make_unique<Impl>();
    for (const PhantomPart& part : parts) {
        Solid solid = std::visit(MakeSolid{}, part.shape);
        solid.name = part.name;
        solid.blend = part.blend;
        impl->solids.push_back(std::move(solid));
    }
    impl_ = std::move(impl);
}

PhantomField::~PhantomField() = default;
PhantomField::PhantomField(PhantomField&&) noexcept = default;
PhantomField& PhantomField::operator=(PhantomField&&) noexcept = default;

double PhantomField::operator()(const Vec3& p) const {
    double joined = impl_->solids.front().distance(p);
    for (std::size_t i = 1; i < impl_->solids.size(); ++i) {
        const Solid& solid = impl_->solids[i];
        // Far from its box, a part cannot be closer than the parts already joined.
        if (solid.box.exteriorDistance(p) > std::max(joined, 0.0) + solid.blend) continue;
        joined = smooth_minimum(joined, solid.distance(p), solid.blend);
    }
    return joined;
}

double PhantomField::part(const std::string& name, const Vec3& p) const {
    for (const Solid& solid : impl_->solids)
        if (solid.name == name) return solid.distance(p);
    throw InvalidInput("the phantom has no part '" + name + "'");
}

Vec3 PhantomField::gradient(const Vec3& p) const {
    Vec3 gradient;
    for (int axis = 0; axis < 3; ++axis) {
        const Vec3 step = kGradientStep * Vec3::Unit(axis);
        gradient[axis] = ((*this)(p + step) - (*this)(p - step)) / (2.0 * kGradientStep);
    }
    return gradient;
}

Eigen::AlignedBox3d PhantomField::bounds() const {
    Eigen::AlignedBox3d box;
    for (const Solid& solid : impl_->solids) {
        box.extend(solid.box.min() - Vec3::Constant(solid.blend));
        box.extend(solid.box.max() + Vec3::Constant(solid.blend));
    }
    return box;
}

}  // namespace vesselbench
