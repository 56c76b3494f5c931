#include "tests/forest/field.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <tbb/parallel_for.h>

#include "tests/forest/ends.h"
#include "tests/forest/grow.h"

namespace vesselbench::forest {

namespace {

/// Step of the central differences [mm].
constexpr double kGradientStep = 1e-5;
/// Slope of the function at most: round cones and fillets [-].
constexpr double kSteepest = 1.1;
/// Grid points per axis of the largest and the smallest blocks that share what is near them.
constexpr int kLargeBlock = 32, kSmallBlock = 4;

double smooth_minimum(double a, double b, double width) {
    if (width <= 0.0) return std::min(a, b);
    const double h = std::max(width - std::abs(a - b), 0.0) / width;
    return std::min(a, b) - h * h * width * 0.25;
}

/// A furcation's fillets end at its reach.
double blend_at(const Node& node, const Vec3& p) {
    const double d = (p - node.at).norm() / node.reach;
    const double u = std::clamp(2.0 - 2.0 * d, 0.0, 1.0);
    return node.blend * u * u * (3.0 - 2.0 * u);
}

/// Fills a grid block by block, each in eight, down to where the wall is near.
class Sampler {
public:
    Sampler(const TreeField& field, const Vec3& origin, const Eigen::Matrix3d& steps,
            const Eigen::Array3i& size)
        : field_(field),
          origin_(origin),
          steps_(steps),
          size_(size),
          values_(offset(0, 0, size[2])) {}

    /// \param wider what is near the block that holds this one; null: everything
    void fill(const Eigen::Array3i& from, int side, const TreeField::Near* wider) {
        if ((from >= size_).any()) return;
        const Vec3 centre = origin_ + steps_ * (from.cast<double>() + 0.5 * (side - 1)).matrix();
        const double radius = 0.5 * (steps_ * Vec3::Constant(side)).norm();
        const auto near = wider ? field_.near(*wider, centre, radius) : field_.near(centre, radius);
        const bool far = field_.is_far(near, radius);
        if (!far && side > kSmallBlock) {
            for (int part = 0; part < 8; ++part)
                fill(from + side / 2 * Eigen::Array3i(part % 2, part / 2 % 2, part / 4), side / 2,
                     &near);
            return;
        }
        const Eigen::Array3i to = (from + side).min(size_);
        for (int k = from[2]; k < to[2]; ++k)
            for (int j = from[1]; j < to[1]; ++j)
                for (int i = from[0]; i < to[0]; ++i)
                    values_[offset(i, j, k)] = static_cast<float>(
                        far ? near.at_centre
                            : field_.value(near, origin_ + steps_ * Vec3(i, j, k)));
    }

    [[nodiscard]] std::vector<float> take() { return std::move(values_); }

private:
    [[nodiscard]] std::size_t offset(int i, int j, int k) const {
        return (static_cast<std::size_t>(k) * static_cast<std::size_t>(size_[1]) +
                static_cast<std::size_t>(j)) *
                   static_cast<std::size_t>(size_[0]) +
               static_cast<std::size_t>(i);
    }

    const TreeField& field_;
    Vec3 origin_;
    Eigen::Matrix3d steps_;
    Eigen::Array3i size_;
    std::vector<float> values_;
};

}  // namespace

TreeField::TreeField(const Tree& tree)
    : nodes_(tree.nodes),
      branches_at_(tree.nodes.size()),
      sacs_(tree.sacs),
      branch_count_(tree.branches.size()) {
    for (std::size_t b = 0; b < tree.branches.size(); ++b) {
        const Branch& branch = tree.branches[b];
        const Line line = shaping_line(branch);
        for (std::size_t i = 0; i + 1 < line.size(); ++i) {
            const Vec3 axis = line[i + 1].at - line[i].at;
            cones_.push_back({line[i].at, axis, std::max(axis.squaredNorm(), 1e-18), line[i].radius,
                              line[i + 1].radius - line[i].radius, static_cast<std::uint32_t>(b)});
        }
        for (const LinePoint& p : line) {
            box_.extend(Vec3(p.at - Vec3::Constant(p.radius)));
            box_.extend(Vec3(p.at + Vec3::Constant(p.radius)));
        }
        for (std::size_t n = 0; n < nodes_.size(); ++n)
            if (meets(branch, n) || branch.ghost_node == n)
                branches_at_[n].push_back(static_cast<std::uint32_t>(b));
    }
    for (const Sac& sac : sacs_) {
        box_.extend(Vec3(sac.centre - Vec3::Constant(sac.radius)));
        box_.extend(Vec3(sac.centre + Vec3::Constant(sac.radius)));
        widest_blend_ = std::max(widest_blend_, sac.blend);
    }
    for (const Node& node : nodes_) widest_blend_ = std::max(widest_blend_, node.blend);
}

double TreeField::distance(const Cone& cone, const Vec3& p) {
    const double u = std::clamp((p - cone.start).dot(cone.axis) / cone.squared, 0.0, 1.0);
    return (p - cone.start - u * cone.axis).norm() - (cone.radius + u * cone.widening);
}

TreeField::Near TreeField::near(const Vec3& centre, double radius) const {
    Near all;
    for (std::size_t c = 0; c < cones_.size(); ++c)
        all.cones.push_back(static_cast<std::uint32_t>(c));
    for (std::size_t s = 0; s < sacs_.size(); ++s)
        all.sacs.push_back(static_cast<std::uint32_t>(s));
    for (std::size_t n = 0; n < nodes_.size(); ++n)
        all.nodes.push_back(static_cast<std::uint32_t>(n));
    return near(all, centre, radius);
}

TreeField::Near TreeField::near(const Near& wider, const Vec3& centre, double radius) const {
    Near found;
    thread_local std::vector<double> distances;
    distances.clear();
    double least = std::numeric_limits<double>::infinity();
    for (const std::uint32_t c : wider.cones) {
        distances.push_back(distance(cones_[c], centre));
        least = std::min(least, distances.back());
    }
    const auto sac_distance = [&](std::uint32_t s) {
        return (sacs_[s].centre - centre).norm() - sacs_[s].radius;
    };
    for (const std::uint32_t s : wider.sacs) least = std::min(least, sac_distance(s));
    found.at_centre = least;
    // what is farther at the centre cannot become the nearest, nor blend with it, in the ball
    const double reach = least + 2.0 * kSteepest * radius + widest_blend_;
    for (std::size_t i = 0; i < distances.size(); ++i)
        if (distances[i] <= reach) found.cones.push_back(wider.cones[i]);
    for (const std::uint32_t s : wider.sacs)
        if (sac_distance(s) <= reach) found.sacs.push_back(s);
    for (const std::uint32_t n : wider.nodes)
        if ((nodes_[n].at - centre).norm() < nodes_[n].reach + radius) found.nodes.push_back(n);
    return found;
}

bool TreeField::is_far(const Near& near, double radius) const {
    return near.at_centre > kSteepest * radius + widest_blend_ ||
           near.at_centre < -kSteepest * radius;
}

double TreeField::value(const Near& near, const Vec3& p) const {
    constexpr double kNone = std::numeric_limits<double>::infinity();
    thread_local std::vector<double> of_branch;
    thread_local std::vector<std::uint32_t> present;
    of_branch.resize(std::max(of_branch.size(), branch_count_), kNone);
    present.clear();
    double least = kNone;
    for (const std::uint32_t c : near.cones) {
        const Cone& cone = cones_[c];
        const double d = distance(cone, p);
        if (present.empty() || present.back() != cone.branch) {
            present.push_back(cone.branch);
            of_branch[cone.branch] = d;
        }
        of_branch[cone.branch] = std::min(of_branch[cone.branch], d);
        least = std::min(least, d);
    }
    double joined = least;
    for (const std::uint32_t n : near.nodes) {
        if (present.size() < 2) break;
        const double width = blend_at(nodes_[n], p);
        if (width <= 0.0) continue;
        double at_node = kNone;
        for (const std::uint32_t b : branches_at_[n])
            if (of_branch[b] < kNone)
                at_node =
                    at_node < kNone ? smooth_minimum(at_node, of_branch[b], width) : of_branch[b];
        joined = std::min(joined, at_node);
    }
    for (const std::uint32_t b : present) of_branch[b] = kNone;
    for (const std::uint32_t s : near.sacs)
        joined =
            smooth_minimum(joined, (sacs_[s].centre - p).norm() - sacs_[s].radius, sacs_[s].blend);
    return joined;
}

Vec3 TreeField::gradient(const Near& near, const Vec3& p) const {
    Vec3 gradient;
    for (int axis = 0; axis < 3; ++axis) {
        const Vec3 step = kGradientStep * Vec3::Unit(axis);
        gradient[axis] = (value(near, p + step) - value(near, p - step)) / (2.0 * kGradientStep);
    }
    return gradient;
}

std::vector<float> sampled(const TreeField& field, const Vec3& origin, const Eigen::Matrix3d& steps,
                           const Eigen::Array3i& size) {
    Sampler sampler(field, origin, steps, size);
    const Eigen::Array3i blocks = (size + kLargeBlock - 1) / kLargeBlock;
    tbb::parallel_for(0, blocks.prod(), [&](int block) {
        const Eigen::Array3i at(block % blocks[0], block / blocks[0] % blocks[1],
                                block / (blocks[0] * blocks[1]));
        sampler.fill(at * kLargeBlock, kLargeBlock, nullptr);
    });
    return sampler.take();
}

}  // namespace vesselbench::forest
