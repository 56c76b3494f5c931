#include "geometry/phantoms/exact_surface.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <tbb/parallel_for.h>

#include "geometry/image/flying_edges.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/wording.h"

namespace vesselbench {

namespace {

/// Newton steps that move a vertex from its linear interpolation onto the surface (each step
/// squares the error).
constexpr int kNewtonSteps = 4;
/// Grid points per axis that are skipped together if the surface is far away.
constexpr int kBlock = 8;

/// Samples of the field, 8 bytes each: 2 GiB.
constexpr double kMostSamples = 256.0 * 1024 * 1024;
constexpr const char* kWhat = "making the phantom's surface";
constexpr int kReports = 20;

/// Calls visit(i) for i < count on all threads, and reports after every twentieth of them.
template <class Visit>
void for_all(std::size_t count, const Progress& progress, const Visit& visit) {
    const std::size_t part = (count + kReports - 1) / kReports;
    for (std::size_t from = 0; from < count; from += part) {
        progress.report(static_cast<double>(from) / static_cast<double>(count), kWhat);
        tbb::parallel_for(from, std::min(from + part, count), [&](std::size_t i) {
            progress.check_cancelled();
            visit(i);
        });
    }
}

/// Points of a grid over the box.
Eigen::Array3i grid_size(const Eigen::AlignedBox3d& box, double edge) {
    if (!(edge > 0.0)) throw InvalidInput("a phantom's surface edges must be longer than 0 mm");
    const Eigen::Array3d size = (box.sizes() / edge).array().ceil() + 1.0;
    if (!(size.prod() <= kMostSamples))
        throw InvalidInput(
            formatted(edge, "edges of %.3g mm would sample the phantom's surface ") +
            formatted(size.prod() / 1e6, "at %.0f million points, more than ") +
            formatted(kMostSamples / 1e6, "%.0f million; use surface edges of ") +
            formatted(edge * std::cbrt(size.prod() / kMostSamples) * 1.05, "%.2g mm or more"));
    return size.cast<int>();
}

/// The field at the points of a grid over the box, the first axis fastest.
std::vector<double> sampled(const PhantomField& field, const Vec3& origin,
                            const Eigen::Array3i& points, double edge, const Progress& progress) {
    std::vector<double> values(static_cast<std::size_t>(points[0]) *
                               static_cast<std::size_t>(points[1]) *
                               static_cast<std::size_t>(points[2]));
    const Eigen::Array3i blocks = (points + kBlock - 1) / kBlock;
    for_all(static_cast<std::size_t>(blocks.prod()), progress, [&](std::size_t b) {
        const int block = static_cast<int>(b);
        const Eigen::Array3i at(block % blocks[0], block / blocks[0] % blocks[1],
                                block / (blocks[0] * blocks[1]));
        const Eigen::Array3i from = at * kBlock, to = (from + kBlock).min(points);
        const double at_centre =
            field(origin + edge * 0.5 * (from + to - 1).cast<double>().matrix());
        // The field changes by about 1 mm per mm: in a block far from the surface, all signs equal
        // its centre's.
        const bool far = std::abs(at_centre) > 1.5 * edge * kBlock;
        for (int k = from[2]; k < to[2]; ++k)
            for (int j = from[1]; j < to[1]; ++j)
                for (int i = from[0]; i < to[0]; ++i)
                    values[(static_cast<std::size_t>(k) * static_cast<std::size_t>(points[1]) +
                            static_cast<std::size_t>(j)) *
                               static_cast<std::size_t>(points[0]) +
                           static_cast<std::size_t>(i)] =
                        far ? at_centre : field(origin + edge * Vec3(i, j, k));
    });
    return values;
}

Vec3 on_surface(const PhantomField& field, Vec3 p) {
    for (int step = 0; step < kNewtonSteps; ++step) {
        const Vec3 gradient = field.gradient(p);
        const double steepness = gradient.squaredNorm();
        if (steepness < 1e-6) break;
        p -= field(p) / steepness * gradient;
    }
    return p;
}

}  // namespace

Surface exact_surface(const PhantomField& field, const Eigen::AlignedBox3d& box, double edge,
                      const Progress& progress) {
    const Eigen::Array3i size = grid_size(box, edge);
    const GridSurface found =
        flying_edges(sampled(field, box.min(), size, edge, progress.part(0.0, 0.6)),
                     {.size = {size[0], size[1], size[2]}, .origin = box.min(), .spacing = edge});
    Positions points(found.points.size());
    for_all(points.size(), progress.part(0.6, 1.0), [&](std::size_t v) {
        const auto& [x, y, z] = found.points[v];
        points[v] = on_surface(field, Vec3(x, y, z));
    });
    std::vector<Triangle> triangles;
    // The field grows outward, but the triangles face smaller values: swap two corners.
    for (const auto& [a, b, c] : found.triangles)
        if (a != b && b != c && c != a) triangles.push_back({a, c, b});
    return make_surface(std::move(points), std::move(triangles));
}

}  // namespace vesselbench
