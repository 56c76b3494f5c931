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
    // On each level the subtrees have `size` items, or one more.
    std::uint32_t nodes = 0, subtrees = 1, larger = 0;
    for (std::uint32_t size = count; subtrees > 0; size /= 2) {
        nodes += subtrees;
        const std::uint32_t smaller = subtrees - larger;
        if (size + 1 <= kLeafSize) break;  // all of them are leaves
        const std::uint32_t split_smaller = size <= kLeafSize ? 0 : smaller;
        // An even size gives two halves; an odd one gives a half and one with one item more.
        subtrees = 2 * (split_smaller + larger);
        larger = size % 2 == 0 ? larger : split_smaller + 2 * larger;
    }
    return nodes;
}

template <class Scalar>
struct Builder {
    using Tree = BasicBoxTree<Scalar>;

    /// An item and twice its box's centre along the axis of a split: side by side, so that
    /// comparisons need not fetch each box from memory.
    struct Placed {
        Scalar place;
        std::uint32_t item;

        bool operator<(const Placed& other) const {  // equal places go by index
            return place < other.place || (place == other.place && item < other.item);
        }
    };

    const std::vector<typename Tree::Box>& boxes;
    std::vector<typename Tree::Node>& nodes;
    std::vector<std::uint32_t>& items;
    std::vector<Placed> placed;  ///< as many as items, for the splits

    Builder(const std::vector<typename Tree::Box>& b, std::vector<typename Tree::Node>& n,
            std::vector<std::uint32_t>& i)
        : boxes(b), nodes(n), items(i), placed(i.size()) {}

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

    /// Splits the items at the median along the longest axis of their centres; equal centres by
    /// index.
    void split(std::uint32_t begin, std::uint32_t middle, std::uint32_t end) {
        typename Tree::Box centres;
        for (std::uint32_t i = begin; i < end; ++i) centres.extend(boxes[items[i]].center());
        int axis = 0;
        centres.sizes().maxCoeff(&axis);
        for (std::uint32_t i = begin; i < end; ++i) {
            const auto& box = boxes[items[i]];
            placed[i] = {box.min()[axis] + box.max()[axis], items[i]};
        }
        const auto first = placed.begin();
        std::nth_element(first + begin, first + middle, first + end);
        for (std::uint32_t i = begin; i < end; ++i) items[i] = placed[i].item;
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
    Builder<Scalar>(boxes, nodes_, items_).build(0, 0, count);
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
