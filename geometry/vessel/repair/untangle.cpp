#include "geometry/vessel/repair/untangle.h"

#include <algorithm>
#include <utility>

namespace vesselbench {

namespace {

/// Attempts that only smooth: they preserve the connectivity and change least.
constexpr int kSmoothingAttempts = 2;
constexpr int kSmoothingSteps = 5;
constexpr double kStep = 0.5;  ///< fraction of the way to the neighbours' mean [-]

/// Marks the triangles of the pairs and `rings` rings of triangles around them.
std::vector<std::uint8_t> marked_around(const TriangleSoup& mesh, const Topology& topology,
                                        const std::vector<TrianglePair>& pairs, int rings) {
    std::vector<std::uint8_t> marked(mesh.triangles.size(), 0);
    std::vector<TriangleId> front;
    const auto mark = [&](TriangleId t) {
        if (!marked[t]) front.push_back(t);
        marked[t] = 1;
    };
    for (const auto& [a, b] : pairs) {
        mark(a);
        mark(b);
    }
    for (int ring = 0; ring < rings; ++ring) {
        const std::vector<TriangleId> last = std::exchange(front, {});
        for (const TriangleId t : last)
            for (const VertexId v : mesh.triangles[t])
                for (const TriangleId near : topology.triangles_at().row(v)) mark(near);
    }
    return marked;
}

void smooth(TriangleSoup& mesh, const Topology& topology, const std::vector<std::uint8_t>& marked,
            RepairReport& report) {
    std::vector<VertexId> moving;
    for (TriangleId t = 0; t < marked.size(); ++t)
        if (marked[t])
            for (const VertexId v : mesh.triangles[t])
                if (!topology.boundary_vertices()[v]) moving.push_back(v);
    std::sort(moving.begin(), moving.end());
    moving.erase(std::unique(moving.begin(), moving.end()), moving.end());
    Positions next(moving.size());
    for (int step = 0; step < kSmoothingSteps; ++step) {
        for (std::size_t i = 0; i < moving.size(); ++i) {
            Vec3 mean = Vec3::Zero();
            const auto ring = topology.rings().row(moving[i]);
            for (const VertexId u : ring) mean += mesh.points[u];
            mean /= static_cast<double>(ring.size());
            next[i] = (1.0 - kStep) * mesh.points[moving[i]] + kStep * mean;
        }
        for (std::size_t i = 0; i < moving.size(); ++i) mesh.points[moving[i]] = next[i];
    }
    report.smoothed_vertices += moving.size();
}

void cut_out(TriangleSoup& mesh, const std::vector<std::uint8_t>& marked, RepairReport& report) {
    for (TriangleId t = 0; t < marked.size(); ++t)
        if (marked[t]) {
            for (const VertexId v : mesh.triangles[t]) mesh.marks[v] = 1;
            ++report.refilled_triangles;
        }
    mesh.remove_triangles(marked);
}

BoxTree::Box inflated(const BoxTree::Box& box) {
    const Vec3 margin = Vec3::Constant(box.diagonal().norm());
    return {Vec3(box.min() - margin), Vec3(box.max() + margin)};
}

Regions regions_of(const TriangleSoup& mesh, const std::vector<std::uint8_t>& marked) {
    Regions regions;
    for (TriangleId t = 0; t < marked.size(); ++t) {
        if (!marked[t]) continue;
        BoxTree::Box box;
        for (const VertexId v : mesh.triangles[t]) box.extend(mesh.points[v]);
        regions.push_back(inflated(box));
    }
    return regions;
}

}  // namespace

std::vector<TrianglePair> self_intersections_in(const TriangleSoup& mesh, const Regions& regions,
                                                const Progress& progress) {
    if (regions.empty()) return {};
    const BoxTree tree(regions);
    const auto boxes = triangle_boxes(mesh.points, mesh.triangles);
    std::vector<TriangleId> near;
    std::vector<Triangle> triangles;
    for (TriangleId t = 0; t < boxes.size(); ++t) {
        bool touches = false;
        tree.traverse(
            [&](const BoxTree::Box& box) { return !touches && box.intersects(boxes[t]); },
            [&](std::uint32_t r) { touches = touches || regions[r].intersects(boxes[t]); });
        if (!touches) continue;
        near.push_back(t);
        triangles.push_back(mesh.triangles[t]);
    }
    auto pairs = self_intersections(mesh.points, triangles, progress);
    for (auto& [a, b] : pairs) {
        a = near[a];
        b = near[b];
    }
    return pairs;
}

Regions untangle(TriangleSoup& mesh, const std::vector<TrianglePair>& pairs, int attempt,
                 RepairReport& report) {
    const Topology topology(mesh.triangles, mesh.points.size());
    const bool smoothing = attempt < kSmoothingAttempts;
    const int rings = smoothing ? attempt + 1 : attempt - kSmoothingAttempts;
    const auto marked = marked_around(mesh, topology, pairs, rings);
    Regions regions = regions_of(mesh, marked);
    if (smoothing)
        smooth(mesh, topology, marked, report);
    else
        cut_out(mesh, marked, report);
    return regions;
}

}  // namespace vesselbench
