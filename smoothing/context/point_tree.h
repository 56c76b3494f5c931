#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "geometry/kernel/box_tree.h"
#include "geometry/kernel/topology.h"
#include "geometry/kernel/vec3.h"

namespace vesselbench {

/// Some vertices of a surface in a spatial tree. If two are equally near, either is found.
class PointTree {
public:
    struct Found {
        VertexId vertex = std::numeric_limits<VertexId>::max();  ///< the largest: none
        double squared = std::numeric_limits<double>::infinity();
    };

    /// \param chosen vertices at finite positions, at least one
    PointTree(const Positions& positions, std::span<const VertexId> chosen);

    /// The vertex nearest to p if it is closer than the square root of known.squared; else known.
    [[nodiscard]] Found nearest(const Vec3& p, Found known) const;

    /// Calls visit(Found) for every vertex closer to p than the square root of `squared`.
    template <class Visit>
    void visit_nearer(const Vec3& p, double squared, const Visit& visit) const {
        tree_.traverse_places(
            [&](const auto& box) { return box.squaredExteriorDistance(p) < squared; },
            [&](std::uint32_t i) {
                const double d = (p - points_[i]).squaredNorm();
                if (d < squared) visit(Found{vertices_[i], d});
            });
    }

private:
    BoxTree tree_;
    std::vector<Vec3> points_;        ///< in the order of the tree's leaves
    std::vector<VertexId> vertices_;  ///< the same
};

}  // namespace vesselbench
