#include "gpu/device_neighbours.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include <epoxy/gl.h>

#include "geometry/kernel/distance_tree.h"
#include "geometry/kernel/surface_distance.h"
#include "smoothing/context/distance_weights.h"

namespace vesselbench {

namespace {

using Eigen::Vector3f;
using Eigen::Vector4f;

constexpr std::uint32_t kLeaf = 0x80000000;  // gpu/shaders/neighbour_distance.comp
constexpr float kUnknown = 3.1e38F;

/// Half of a node: a corner of its box, and its first triangle or right child.
struct HalfNode {
    std::array<float, 3> corner;
    std::uint32_t number;
};

std::array<float, 3> numbers(const Vec3& p) {
    const Vector3f single = p.cast<float>();
    return {single.x(), single.y(), single.z()};
}

/// A neighbour's tree, relative to the centre of the surface.
struct DeviceTree {
    DeviceTable nodes, corners, dipoles;

    DeviceTree(const DeviceSurface& surface, const Surface& neighbour) {
        const SurfaceDistance distance = distance_to(neighbour);
        const DistanceTree& tree = distance.tree();
        const Device& device = surface.device();
        const Vec3& centre = surface.centre();
        std::vector<HalfNode> boxes;
        for (const BoxTree::Node& node : tree.tree.nodes()) {
            boxes.push_back({numbers(node.box.min() - centre), node.begin});
            boxes.push_back({numbers(node.box.max() - centre),
                             node.right != 0 ? node.right : kLeaf + (node.end - node.begin)});
        }
        std::vector<Vector4f> points;
        const auto add = [&](const Vec3& p) {
            points.emplace_back() << (p - centre).cast<float>(), 1.0F;
        };
        for (const auto& [a, b, c] : tree.corners) {
            add(a);
            add(b);
            add(c);
        }
        std::vector<Vector4f> parts;
        for (const Dipole& dipole : tree.dipoles) {
            parts.emplace_back() << dipole.area_normal.cast<float>(),
                static_cast<float>(dipole.radius);
            parts.emplace_back() << (dipole.centre - centre).cast<float>(), 1.0F;
        }
        const bool wide = std::max({boxes.size(), points.size(), parts.size()}) * sizeof(Vector4f) >
                          device.limits.largest_storage_block;
        nodes = make_table(device, std::span<const HalfNode>(boxes), wide, "a neighbour's boxes");
        corners =
            make_table(device, std::span<const Vector4f>(points), wide, "a neighbour's corners");
        dipoles =
            make_table(device, std::span<const Vector4f>(parts), wide, "a neighbour's dipoles");
    }
};

void search(const DeviceSurface& surface, const Surface& neighbour, const Buffer& distances) {
    const DeviceTree tree(surface, neighbour);
    const Program& program = surface.program("neighbour_distance", tree.nodes.wide());
    bind_storage({&surface.shifts(), &distances, nullptr, &tree.nodes, &tree.corners, &tree.dipoles,
                  &surface.anchors()});
    glUseProgram(program.id());
    glUniform1i(1, is_closed(neighbour) ? 1 : 0);
    glUniform1f(2, static_cast<float>(kFarFactor));
    dispatch(surface.device(), program, surface.vertex_count());
}

}  // namespace

NeighbourDistances find_neighbour_distances(const DeviceSurface& surface,
                                            std::span<const Surface> neighbours) {
    require_neighbours(neighbours);
    const Device& device = surface.device();
    const std::size_t count = surface.vertex_count();
    NeighbourDistances found;
    found.count = count;
    found.distances = make_storage(device, count * sizeof(float), "distances to neighbours");
    fill_storage(device, found.distances, std::bit_cast<std::uint32_t>(kUnknown));
    for (const Surface& neighbour : neighbours) search(surface, neighbour, found.distances);
    const std::array<std::uint32_t, 2> none = {0xFFFFFFFF, 0};
    const Buffer range =
        make_storage(device, std::span<const std::uint32_t>(none), "range of distances");
    bind_storage({&found.distances, &range});
    dispatch(device, surface.program("distance_range"), count);
    const auto bits = read_storage<std::uint32_t>(device, range, 2);
    found.least = std::bit_cast<float>(bits[0]);
    found.most = std::bit_cast<float>(bits[1]);
    return found;
}

}  // namespace vesselbench
