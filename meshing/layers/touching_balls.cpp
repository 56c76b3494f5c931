#include "meshing/layers/touching_balls.h"

#include <optional>

#include <tbb/parallel_for.h>

#include "geometry/kernel/box_tree.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/statistics.h"
#include "geometry/kernel/surface_distance.h"
#include "geometry/kernel/touching_ball.h"

namespace vesselbench {

namespace {

constexpr double kNearby = 1.5;  // of the radius: for the median
constexpr int kMedians = 2;      // over neighbours, before that
constexpr double kSkin = 1e-6;   // of the box: skips the wall that a ray starts on

// The wall's vertices and the middles of its triangles.
Positions samples_of(const Surface& wall) {
    Positions samples = wall.points();
    for (const auto& [a, b, c] : wall.triangles())
        samples.emplace_back((wall.points()[a] + wall.points()[b] + wall.points()[c]) / 3.0);
    return samples;
}

BoxTree tree_of(const Positions& points) {
    std::vector<BoxTree::Box> boxes;
    boxes.reserve(points.size());
    for (const Vec3& p : points) boxes.emplace_back(p, p);
    return BoxTree(boxes);
}

// The sample nearest to a place and closer than `reach`; the lowest of equals. None: #samples.
std::size_t nearest_sample(const BoxTree& tree, const Positions& samples, const Vec3& place,
                           double reach) {
    std::size_t nearest = samples.size();
    double best = reach * reach;
    tree.traverse(
        [&](const BoxTree::Box& box) { return box.squaredExteriorDistance(place) <= best; },
        [&](std::size_t i) {
            const double distance = (samples[i] - place).squaredNorm();
            if (distance < best || (distance == best && i < nearest)) {
                best = distance;
                nearest = i;
            }
        });
    return nearest;
}

}  // namespace

std::vector<double> touching_balls(const LayeredWall& wall, const Progress& progress) {
    const SurfaceDistance search(wall.wall);
    const Positions samples = samples_of(wall.wall);
    const BoxTree tree = tree_of(samples);
    const double farthest = bounds(wall.wall).diagonal();
    std::vector<double> radii(wall.wall.vertex_count());
    const auto nearest = [&](const Vec3& centre, double reach) -> std::optional<Vec3> {
        const std::size_t i = nearest_sample(tree, samples, centre, reach);
        return i == samples.size() ? std::nullopt : std::optional(samples[i]);
    };
    tbb::parallel_for(std::size_t{0}, radii.size(), [&](std::size_t v) {
        progress.check_cancelled();
        const Vec3 &at = wall.wall.points()[v], inward = -wall.normals[v];
        if (inward.isZero()) return;
        const double skin = kSkin * farthest;
        const auto hit = search.first_hit(at + skin * inward, inward, farthest);
        const double across = hit ? hit->distance + skin : farthest;
        radii[v] = touching_ball(at, inward, 0.5 * across, nearest);
    });
    return radii;
}

std::vector<double> vessel_radii(const LayeredWall& wall, const std::vector<double>& balls,
                                 const Progress& progress) {
    const CompressedRows& rings = wall.wall.topology->rings();
    const Positions& points = wall.wall.points();
    std::vector<double> rough = balls, radii(balls.size());
    for (int pass = 0; pass < kMedians; ++pass) {
        const std::vector<double> before = rough;
        tbb::parallel_for(std::size_t{0}, rough.size(), [&](std::size_t v) {
            std::vector<double> near = {before[v]};
            for (const auto u : rings.row(v)) near.push_back(before[u]);
            rough[v] = median(std::move(near));
        });
    }
    const BoxTree tree = tree_of(points);
    tbb::parallel_for(std::size_t{0}, radii.size(), [&](std::size_t v) {
        progress.check_cancelled();
        const double reach = kNearby * kNearby * rough[v] * rough[v];
        std::vector<double> near;
        tree.traverse(
            [&](const BoxTree::Box& box) {
                return box.squaredExteriorDistance(points[v]) <= reach;
            },
            [&](std::size_t u) {
                if ((points[u] - points[v]).squaredNorm() <= reach) near.push_back(balls[u]);
            });
        radii[v] = median(std::move(near));
    });
    return radii;
}

}  // namespace vesselbench
