#include "geometry/kernel/self_intersections.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "geometry/kernel/box_tree.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/surface_key.h"

namespace vesselbench {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

Kernel::Point_3 to_cgal(const Vec3& p) {
    return {p.x(), p.y(), p.z()};
}

struct Shared {
    int count = 0;
    std::array<int, 3> mine{}, theirs{};  ///< corner numbers of the shared vertices
};

Shared shared_vertices(const Triangle& a, const Triangle& b) {
    Shared shared;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            if (a[i] == b[j] && shared.count < 3) {
                shared.mine[shared.count] = i;
                shared.theirs[shared.count++] = j;
            }
    return shared;
}

class Tester {
public:
    Tester(const Positions& positions, std::span<const Triangle> triangles)
        : positions_(positions), triangles_(triangles) {}

    [[nodiscard]] bool degenerate(TriangleId t) const {
        const auto p = corners(t);
        return CGAL::collinear(p[0], p[1], p[2]);
    }

    [[nodiscard]] bool intersect(TriangleId s, TriangleId t) const {
        const Triangle &a = triangles_[s], &b = triangles_[t];
        const Shared shared = shared_vertices(a, b);
        switch (shared.count) {
            case 0:
                return CGAL::do_intersect(triangle(s), triangle(t));
            case 1:
                return meet_beyond_vertex(s, t, shared.mine[0], shared.theirs[0]);
            case 2:
                return folded_over(a[3 - shared.mine[0] - shared.mine[1]],
                                   b[3 - shared.theirs[0] - shared.theirs[1]], a[shared.mine[0]],
                                   a[shared.mine[1]]);
            default:
                return true;  // the same three vertices
        }
    }

private:
    [[nodiscard]] std::array<Kernel::Point_3, 3> corners(TriangleId t) const {
        const Triangle& v = triangles_[t];
        return {to_cgal(positions_[v[0]]), to_cgal(positions_[v[1]]), to_cgal(positions_[v[2]])};
    }

    [[nodiscard]] Kernel::Triangle_3 triangle(TriangleId t) const {
        const auto p = corners(t);
        return {p[0], p[1], p[2]};
    }

    /// Two triangles with one shared vertex meet elsewhere exactly if the side opposite to that
    /// vertex in one of them meets the other one.
    [[nodiscard]] bool meet_beyond_vertex(TriangleId s, TriangleId t, int in_s, int in_t) const {
        const auto p = corners(s), q = corners(t);
        const Kernel::Segment_3 side_p(p[(in_s + 1) % 3], p[(in_s + 2) % 3]);
        const Kernel::Segment_3 side_q(q[(in_t + 1) % 3], q[(in_t + 2) % 3]);
        const auto one_side = [](const auto& plane, const Kernel::Segment_3& side) {
            const auto a = CGAL::orientation(plane[0], plane[1], plane[2], side.source());
            return a != CGAL::COPLANAR &&
                   a == CGAL::orientation(plane[0], plane[1], plane[2], side.target());
        };
        // Both corners strictly on one side of the other's plane: only the shared vertex remains.
        if (one_side(p, side_q) || one_side(q, side_p)) return false;
        return CGAL::do_intersect(Kernel::Triangle_3(p[0], p[1], p[2]), side_q) ||
               CGAL::do_intersect(Kernel::Triangle_3(q[0], q[1], q[2]), side_p);
    }

    /// Two triangles at one edge overlap only if they are coplanar and lie on the same side of it.
    [[nodiscard]] bool folded_over(VertexId top_a, VertexId top_b, VertexId u, VertexId v) const {
        const auto a = to_cgal(positions_[top_a]), b = to_cgal(positions_[top_b]);
        const auto p = to_cgal(positions_[u]), q = to_cgal(positions_[v]);
        return CGAL::coplanar(p, q, a, b) &&
               CGAL::coplanar_orientation(p, q, a, b) == CGAL::POSITIVE;
    }

    const Positions& positions_;
    std::span<const Triangle> triangles_;
};

/// 1 at the nodes that contain a wanted position of the items' order.
std::vector<std::uint8_t> nodes_with(std::span<const SmallBoxTree::Node> nodes,
                                     std::span<const std::uint8_t> wanted) {
    std::vector<std::uint8_t> found(nodes.size(), 0);
    for (std::size_t at = nodes.size(); at-- > 0;) {  // children come after their parents
        const SmallBoxTree::Node& node = nodes[at];
        if (node.right != 0)
            found[at] = found[at + 1] | found[node.right];
        else
            found[at] = std::any_of(wanted.begin() + node.begin, wanted.begin() + node.end,
                                    [](std::uint8_t w) { return w != 0; })
                            ? 1
                            : 0;
    }
    return found;
}

/// Calls test(i, j), i < j, for the positions of items in leaves whose boxes meet the leaf's box,
/// if one of them is wanted according to the flags of all nodes.
template <class Test>
void for_pairs_of(std::span<const SmallBoxTree::Node> nodes, std::span<const std::uint8_t> wanted,
                  std::size_t leaf_at, Test&& test) {
    const SmallBoxTree::Node& leaf = nodes[leaf_at];
    std::uint32_t stack[64];  // the tree is balanced: twice its depth is far below
    int depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
        const std::uint32_t at = stack[--depth];
        const SmallBoxTree::Node& node = nodes[at];
        if (wanted[leaf_at] == 0 && wanted[at] == 0) continue;
        if (node.end <= leaf.begin || !node.box.intersects(leaf.box)) continue;
        if (node.right != 0) {
            stack[depth++] = node.right;
            stack[depth++] = at + 1;
            continue;
        }
        for (std::uint32_t i = leaf.begin; i < leaf.end; ++i)
            for (std::uint32_t j = std::max(node.begin, i + 1); j < node.end; ++j) test(i, j);
    }
}

/// Not smaller than the triangle's box: a pair that does not meet only costs time.
SmallBoxTree::Box small_box(const Positions& positions, const Triangle& triangle) {
    constexpr float kEnd = std::numeric_limits<float>::infinity();
    SmallBoxTree::Box box;
    for (int axis = 0; axis < 3; ++axis) {
        const auto [low, high] =
            std::minmax({positions[triangle[0]][axis], positions[triangle[1]][axis],
                         positions[triangle[2]][axis]});
        box.min()[axis] = std::nextafter(static_cast<float>(low), -kEnd);
        box.max()[axis] = std::nextafter(static_cast<float>(high), kEnd);
    }
    return box;
}

/// Moves values[order[i]] to position i, without a second array.
template <class Value>
void put_in_order(std::vector<Value>& values, std::span<const std::uint32_t> order) {
    std::vector<bool> done(values.size(), false);
    for (std::uint32_t start = 0; start < values.size(); ++start) {
        if (done[start]) continue;
        const Value first = values[start];
        std::uint32_t at = start;
        for (; order[at] != start; at = order[at]) {
            values[at] = values[order[at]];
            done[at] = true;
        }
        values[at] = first;
        done[at] = true;
    }
}

}  // namespace

std::vector<TrianglePair> self_intersections_with(const Positions& positions,
                                                  std::span<const Triangle> triangles,
                                                  std::span<const std::uint8_t> chosen,
                                                  const Progress& progress) {
    if (chosen.size() != triangles.size())
        throw InvalidInput("got " + std::to_string(chosen.size()) + " flags for " +
                           std::to_string(triangles.size()) + " triangles");
    const Tester tester(positions, triangles);
    std::vector<SmallBoxTree::Box> boxes(triangles.size());
    tbb::parallel_for(std::size_t{0}, boxes.size(),
                      [&](std::size_t t) { boxes[t] = small_box(positions, triangles[t]); });
    const SmallBoxTree tree(boxes);
    const auto items = tree.items();
    // In leaf order, neighbours are close together in memory, and each pair is found from its first
    // triangle only.
    put_in_order(boxes, items);
    std::vector<std::uint8_t> flat(boxes.size()), wanted(boxes.size());
    tbb::parallel_for(std::size_t{0}, boxes.size(), [&](std::size_t i) {
        flat[i] = tester.degenerate(items[i]) ? 1 : 0;
        wanted[i] = chosen[items[i]];
    });
    const std::vector<std::uint8_t> wanted_nodes = nodes_with(tree.nodes(), wanted);
    std::vector<std::uint32_t> leaves;
    for (std::uint32_t at = 0; at < tree.nodes().size(); ++at)
        if (tree.nodes()[at].right == 0) leaves.push_back(at);
    // Fixed blocks keep the order of the result for any number of threads.
    constexpr std::size_t kBlock = 1024;
    std::vector<std::vector<TrianglePair>> found((leaves.size() + kBlock - 1) / kBlock);
    tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t block) {
        progress.check_cancelled();
        const auto test = [&](std::uint32_t i, std::uint32_t j) {
            if ((wanted[i] | wanted[j]) != 0 && !flat[i] && !flat[j] &&
                boxes[i].intersects(boxes[j]) && tester.intersect(items[i], items[j]))
                found[block].push_back(std::minmax({items[i], items[j]}));
        };
        const std::size_t end = std::min(leaves.size(), (block + 1) * kBlock);
        for (std::size_t l = block * kBlock; l < end; ++l)
            for_pairs_of(tree.nodes(), wanted_nodes, leaves[l], test);
    });
    std::vector<TrianglePair> all;
    for (const auto& block : found) all.insert(all.end(), block.begin(), block.end());
    std::sort(all.begin(), all.end());
    return all;
}

std::vector<TrianglePair> self_intersections(const Positions& positions,
                                             std::span<const Triangle> triangles,
                                             const Progress& progress) {
    return self_intersections_with(positions, triangles,
                                   std::vector<std::uint8_t>(triangles.size(), 1), progress);
}

namespace {

template <class Make>
std::vector<TrianglePair> known_pairs(const ContentKey& key, const Make& make, DerivedCache& cache,
                                      const Progress& progress) {
    using Pairs = std::vector<TrianglePair>;
    return *cache.find_or_make<Pairs>(
        "self-intersections", key, make,
        [](const Pairs& pairs) { return sizeof(Pairs) + std::as_bytes(std::span(pairs)).size(); },
        progress);
}

}  // namespace

std::vector<TrianglePair> self_intersections(const Surface& surface, const Progress& progress,
                                             DerivedCache& cache) {
    if (surface.empty()) return {};
    const auto search = [&] {
        return self_intersections(surface.points(), surface.triangles(), progress);
    };
    return known_pairs(shape_key(surface, cache), search, cache, progress);
}

void remember_no_self_intersections(const Topology& topology, const Positions& positions,
                                    DerivedCache& cache) {
    static_cast<void>(known_pairs(shape_key(topology, positions),
                                  [] { return std::vector<TrianglePair>(); }, cache, {}));
}

}  // namespace vesselbench
