#include "smoothing/context/point_tree.h"

#include <utility>

namespace vesselbench {

PointTree::PointTree(const Positions& positions, std::span<const VertexId> chosen) {
    std::vector<BoxTree::Box> boxes;
    boxes.reserve(chosen.size());
    for (const VertexId v : chosen) boxes.emplace_back(positions[v]);
    tree_ = BoxTree(boxes);
    points_.reserve(chosen.size());
    vertices_.reserve(chosen.size());
    for (const std::uint32_t item : tree_.items()) {
        vertices_.push_back(chosen[item]);
        points_.push_back(positions[chosen[item]]);
    }
}

PointTree::Found PointTree::nearest(const Vec3& p, Found known) const {
    std::array<std::pair<double, std::uint32_t>, 64> stack;  // as deep as visit_nearer's
    std::size_t size = 0;
    const auto nodes = tree_.nodes();
    stack[size++] = {nodes[0].box.squaredExteriorDistance(p), 0};
    while (size > 0) {
        const auto [squared, at] = stack[--size];
        if (!(squared < known.squared)) continue;
        const BoxTree::Node& node = nodes[at];
        if (node.right == 0) {
            for (std::uint32_t i = node.begin; i < node.end; ++i) {
                const double d = (p - points_[i]).squaredNorm();
                if (d < known.squared) known = {vertices_[i], d};
            }
            continue;
        }
        std::pair near{nodes[at + 1].box.squaredExteriorDistance(p), at + 1};
        std::pair far{nodes[node.right].box.squaredExteriorDistance(p), node.right};
        if (far.first < near.first) std::swap(near, far);
        stack[size++] = far;
        stack[size++] = near;
    }
    return known;
}

}  // namespace vesselbench
