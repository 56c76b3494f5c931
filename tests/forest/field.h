#pragma once

#include <cstdint>
#include <vector>

#include "tests/forest/tree.h"

namespace vesselbench::forest {

/// The implicit function of a tree: negative inside, about the signed distance near the wall [mm].
/// Vessels blend at their common furcations only (PhantomField blends all neighbours, which would
/// join kissing vessels), and what is far from a box is left out for all points in it.
class TreeField {
public:
    explicit TreeField(const Tree& tree);

    /// The round cones and sacs that decide the function within a ball.
    struct Near {
        std::vector<std::uint32_t> cones;  ///< ascending
        std::vector<std::uint32_t> sacs;
        std::vector<std::uint32_t> nodes;  ///< whose fillets may reach the ball
        double at_centre = 0.0;            ///< smallest distance of any at the ball's centre [mm]
    };

    [[nodiscard]] Near near(const Vec3& centre, double radius) const;
    /// The same for a ball inside that of `wider`.
    [[nodiscard]] Near near(const Near& wider, const Vec3& centre, double radius) const;
    /// Whether the function has one sign within the ball.
    [[nodiscard]] bool is_far(const Near& near, double radius) const;
    [[nodiscard]] double value(const Near& near, const Vec3& p) const;
    [[nodiscard]] Vec3 gradient(const Near& near, const Vec3& p) const;

    /// Contains the surface [mm].
    [[nodiscard]] Eigen::AlignedBox3d bounds() const { return box_; }

private:
    struct Cone {
        Vec3 start, axis;
        double squared, radius, widening;
        std::uint32_t branch;
    };

    [[nodiscard]] static double distance(const Cone& cone, const Vec3& p);

    std::vector<Cone> cones_;
    std::vector<Node> nodes_;
    std::vector<std::vector<std::uint32_t>> branches_at_;  ///< per node
    std::vector<Sac> sacs_;
    double widest_blend_ = 0.0;
    std::size_t branch_count_ = 0;
    Eigen::AlignedBox3d box_;
};

/// The function at the points origin + steps * (i, j, k), i fastest; far from the wall only its
/// sign counts.
[[nodiscard]] std::vector<float> sampled(const TreeField& field, const Vec3& origin,
                                         const Eigen::Matrix3d& steps, const Eigen::Array3i& size);

}  // namespace vesselbench::forest
