#include "tests/support/surface_facts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace vesselbench::test {

bool is_closed_manifold(const Surface& surface) {
    std::map<std::pair<VertexId, VertexId>, int> seen;
    for (const auto& t : surface.triangles())
        for (int k = 0; k < 3; ++k) ++seen[{t[k], t[(k + 1) % 3]}];
    for (const auto& [edge, count] : seen) {
        const auto twin = seen.find({edge.second, edge.first});
        if (count != 1 || twin == seen.end() || twin->second != 1) return false;
    }
    return true;
}

double enclosed_volume(const Surface& surface) {
    double sum = 0.0;
    const Positions& x = surface.points();
    for (const auto& [a, b, c] : surface.triangles()) sum += x[a].dot(x[b].cross(x[c])) / 6.0;
    return sum;
}

double smallest_angle_deg(const Surface& surface, const std::function<bool(const Vec3&)>& chosen) {
    double smallest = 180.0;
    const Positions& x = surface.points();
    for (const auto& t : surface.triangles()) {
        if (!chosen(x[t[0]]) || !chosen(x[t[1]]) || !chosen(x[t[2]])) continue;
        for (int k = 0; k < 3; ++k) {
            const Vec3 a = x[t[(k + 1) % 3]] - x[t[k]], b = x[t[(k + 2) % 3]] - x[t[k]];
            smallest = std::min(smallest,
                                std::atan2(a.cross(b).norm(), a.dot(b)) * 180.0 / std::numbers::pi);
        }
    }
    return smallest;
}

Surface merged(const Surface& a, const Surface& b) {
    Positions points = a.points();
    points.insert(points.end(), b.points().begin(), b.points().end());
    std::vector<Triangle> triangles(a.triangles().begin(), a.triangles().end());
    PatchLabels labels = *a.patch_labels;
    std::vector<Patch> patches = a.patches;
    std::vector<std::uint16_t> label_of;
    for (const Patch& patch : b.patches) {
        const auto known = std::find(patches.begin(), patches.end(), patch);
        label_of.push_back(static_cast<std::uint16_t>(known - patches.begin()));
        if (known == patches.end()) patches.push_back(patch);
    }
    const auto shift = static_cast<VertexId>(a.vertex_count());
    for (TriangleId t = 0; t < b.triangle_count(); ++t) {
        const auto& [p, q, r] = b.triangles()[t];
        triangles.push_back({p + shift, q + shift, r + shift});
        labels.push_back(label_of[(*b.patch_labels)[t]]);
    }
    return make_surface(std::move(points), std::move(triangles), std::move(labels),
                        std::move(patches));
}

}  // namespace vesselbench::test
