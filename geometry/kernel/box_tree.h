#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "geometry/kernel/topology.h"
#include "geometry/kernel/vec3.h"

namespace vesselbench {

/// Tree of axis-parallel boxes over a set of boxed items (triangles, edges, points), split at the
/// median of the longest axis: the same input gives the same tree on any number of threads.
/// Building block of SurfaceDistance and self_intersections; use those where they serve.
/// \tparam Scalar double, or float where memory counts and boxes may be a little too large
template <class Scalar>
class BasicBoxTree {
public:
    using Box = Eigen::AlignedBox<Scalar, 3>;

    struct Node {
        Box box;
        std::uint32_t begin = 0;  ///< first item in items()
        std::uint32_t end = 0;    ///< behind the last one
        std::uint32_t right = 0;  ///< right child; 0: a leaf. The left child is the next node.
    };

    BasicBoxTree() = default;
    explicit BasicBoxTree(const std::vector<Box>& boxes);

    [[nodiscard]] std::span<const Node> nodes() const { return nodes_; }

    /// Item indices in the order of the leaves.
    [[nodiscard]] std::span<const std::uint32_t> items() const { return items_; }

    /// Calls visit(item) for every item whose leaf passes `wanted(box)`.
    template <class Wanted, class Visit>
    void traverse(Wanted&& wanted, Visit&& visit) const {
        if (nodes_.empty()) return;
        std::vector<std::uint32_t> stack{0};
        while (!stack.empty()) {
            const std::uint32_t at = stack.back();
            stack.pop_back();
            const Node& node = nodes_[at];
            if (!wanted(node.box)) continue;
            if (node.right == 0) {
                for (std::uint32_t i = node.begin; i < node.end; ++i) visit(items_[i]);
            } else {
                stack.push_back(node.right);
                stack.push_back(at + 1);
            }
        }
    }

private:
    std::vector<Node> nodes_;
    std::vector<std::uint32_t> items_;
};

using BoxTree = BasicBoxTree<double>;
using SmallBoxTree = BasicBoxTree<float>;

/// The box of every triangle [mm], #T.
[[nodiscard]] std::vector<BoxTree::Box> triangle_boxes(const Positions& positions,
                                                       std::span<const Triangle> triangles);

}  // namespace vesselbench
