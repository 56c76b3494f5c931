#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "geometry/kernel/topology.h"
#include "geometry/kernel/vec3.h"

namespace vesselbench {

/// Tree of axis-parallel boxes over a set of boxed items (triangles, edges, points), split at the
/// median of the longest axis: the same input gives the same tree for any number of threads.
/// Building block of SurfaceDistance and self_intersections; prefer those where they fit.
/// \tparam Scalar double, or float where memory matters and boxes may be slightly too large
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
    void traverse(const Wanted& wanted, const Visit& visit) const {
        traverse_places(wanted, [&](std::uint32_t i) { visit(items_[i]); });
    }

    /// The same with the item's place in items().
    template <class Wanted, class Visit>
    void traverse_places(const Wanted& wanted, const Visit& visit) const {
        std::array<std::uint32_t, 64> stack;  // deeper than any tree of 2^32 items split in halves
        std::size_t size = 0;
        if (!nodes_.empty()) stack[size++] = 0;
        while (size > 0) {
            const std::uint32_t at = stack[--size];
            const Node& node = nodes_[at];
            if (!wanted(node.box)) continue;
            if (node.right == 0) {
                for (std::uint32_t i = node.begin; i < node.end; ++i) visit(i);
            } else {
                stack[size++] = node.right;
                stack[size++] = at + 1;
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
