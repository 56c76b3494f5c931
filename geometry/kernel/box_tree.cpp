#include "geometry/kernel/box_tree.h"

#include <algorithm>

#include <tbb/parallel_invoke.h>

namespace vesselbench {

namespace {

constexpr std::uint32_t kLeafSize = 4;
constexpr std::uint32_t kParallelSize = 20000;  ///< below it a task costs more than it saves

/// Nodes of a subtree over `count` items: known beforehand, so that subtrees can be filled in
/// parallel.
std::uint32_t node_count(std::uint32_t count) {
    if (count <= kLeafSize) return 1;
    const std::uint32_t left = count / 2;
    return 1 + node_count(left) + node_count(count - left);
}

template <class Scalar>
struct Builder {
    using Tree = BasicBoxTree<Scalar>;

    const std::vector<typename Tree::Box>& boxes;
    std::vector<typename Tree::Node>& nodes;
    std::vector<std::uint32_t>& items;

    void build(std::uint32_t at, std::uint32_t begin, std::uint32_t end) {
        typename Tree::Node& node = nodes[at];
        node.begin = begin;
        node.end = end;
        if (end - begin <= kLeafSize) {
            for (std::uint32_t i = begin; i < end; ++i) node.box.extend(boxes[items[i]]);
            return;
        }
        const std::uint32_t middle = begin + (end - begin) / 2;
        split(begin, middle, end);
        node.right = at + 1 + node_count(middle - begin);
        const auto left = [&] { build(at + 1, begin, middle); };
        const auto right = [&] { build(node.right, middle, end); };
        if (end - begin > kParallelSize) {
            tbb::parallel_invoke(left, right);
        } else {
            left();
            right();
        }
        node.box = nodes[at + 1].box.merged(nodes[node.right].box);
    }

    /// Halves the items along the longest axis of their centres; equal centres go by index.
    void split(std::uint32_t begin, std::uint32_t middle, std::uint32_t end) {
        typename Tree::Box centres;
        for (std::uint32_t i = begin; i < end; ++i) centres.extend(boxes[items[i]].center());
        int axis = 0;
        centres.sizes().maxCoeff(&axis);
        const auto key = [&](std::uint32_t i) {
            return boxes[i].min()[axis] + boxes[i].max()[axis];
        };
        std::nth_element(items.begin() + begin, items.begin() + middle, items.begin() + end,
                         [&](std::uint32_t a, std::uint32_t b) {
                             const Scalar ka = key(a), kb = key(b);
                             return ka < kb || (ka == kb && a < b);
                         });
    }
};

}  // namespace

template <class Scalar>
BasicBoxTree<Scalar>::BasicBoxTree(const std::vector<Box>& boxes) {
    if (boxes.empty()) return;
    const auto count = static_cast<std::uint32_t>(boxes.size());
    items_.resize(count);
    for (std::uint32_t i = 0; i < count; ++i) items_[i] = i;
    nodes_.resize(node_count(count));
    Builder<Scalar>{boxes, nodes_, items_}.build(0, 0, count);
}

template class BasicBoxTree<double>;
template class BasicBoxTree<float>;

std::vector<BoxTree::Box> triangle_boxes(const Positions& positions,
                                         std::span<const Triangle> triangles) {
    std::vector<BoxTree::Box> boxes(triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t)
        for (const VertexId v : triangles[t]) boxes[t].extend(positions[v]);
    return boxes;
}

}  // namespace vesselbench
