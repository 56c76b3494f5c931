#include "geometry/kernel/surface.h"

#include <algorithm>
#include <utility>

#include "geometry/kernel/errors.h"

namespace vesselbench {

namespace {

constexpr std::pair<PatchKind, const char*> kKindNames[] = {{PatchKind::Wall, "wall"},
                                                            {PatchKind::Inlet, "inlet"},
                                                            {PatchKind::Outlet, "outlet"},
                                                            {PatchKind::Cut, "cut"}};

}  // namespace

std::string to_string(PatchKind kind) {
    for (const auto& [k, name] : kKindNames)
        if (k == kind) return name;
    return "wall";
}

PatchKind patch_kind_from(const std::string& name) {
    for (const auto& [kind, known] : kKindNames)
        if (name == known) return kind;
    throw InvalidInput("unknown kind of patch '" + name + "' (wall, inlet, outlet or cut)");
}

Surface Surface::with_positions(Positions moved) const {
    if (moved.size() != vertex_count())
        throw InvalidInput("got " + std::to_string(moved.size()) + " positions for " +
                           std::to_string(vertex_count()) + " vertices");
    Surface result = *this;
    result.positions = std::make_shared<const Positions>(std::move(moved));
    return result;
}

Surface Surface::with_patches(PatchLabels labels, std::vector<Patch> table) const {
    if (labels.size() != triangle_count())
        throw InvalidInput("got " + std::to_string(labels.size()) + " patch labels for " +
                           std::to_string(triangle_count()) + " triangles");
    if (std::any_of(labels.begin(), labels.end(),
                    [&](auto label) { return label >= table.size(); }))
        throw InvalidInput("a patch label is larger than the patch table");
    Surface result = *this;
    result.patch_labels = std::make_shared<const PatchLabels>(std::move(labels));
    result.patches = std::move(table);
    return result;
}

Surface make_surface(Positions positions, std::vector<Triangle> triangles) {
    PatchLabels labels(triangles.size(), 0);
    return make_surface(std::move(positions), std::move(triangles), std::move(labels),
                        {{"wall", PatchKind::Wall}});
}

Surface make_surface(Positions positions, std::vector<Triangle> triangles, PatchLabels labels,
                     std::vector<Patch> patches) {
    Surface bare;
    bare.topology = std::make_shared<const Topology>(std::move(triangles), positions.size());
    bare.positions = std::make_shared<const Positions>(std::move(positions));
    return bare.with_patches(std::move(labels), std::move(patches));
}

Vec3 area_normal(const Positions& positions, const Triangle& triangle) {
    const Vec3& a = positions[triangle[0]];
    return (positions[triangle[1]] - a).cross(positions[triangle[2]] - a);
}

}  // namespace vesselbench
