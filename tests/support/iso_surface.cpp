#include "tests/support/iso_surface.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "geometry/image/flying_edges.h"

namespace vesselbench::test {

Surface iso_surface(const ImplicitShape& shape, const Eigen::AlignedBox3d& box, double cell) {
    GridFrame grid{.origin = box.min(), .spacing = cell};
    for (int a = 0; a < 3; ++a)
        grid.size[static_cast<std::size_t>(a)] =
            static_cast<int>(std::ceil(box.sizes()[a] / cell)) + 1;
    std::vector<double> values;
    for (int k = 0; k < grid.size[2]; ++k)
        for (int j = 0; j < grid.size[1]; ++j)
            for (int i = 0; i < grid.size[0]; ++i)
                values.push_back(shape(box.min() + cell * Vec3(i, j, k)));
    GridSurface found = flying_edges(values, grid);
    Positions points;
    for (const auto& [x, y, z] : found.points) points.emplace_back(x, y, z);
    return make_surface(std::move(points), std::move(found.triangles));
}

double capsule(const Vec3& p, const Vec3& a, const Vec3& b, double radius) {
    const Vec3 d = b - a;
    const double t = std::clamp((p - a).dot(d) / d.squaredNorm(), 0.0, 1.0);
    return (p - a - t * d).norm() - radius;
}

Surface with_noise(const Surface& surface, double amount) {
    double sum = 0.0;
    for (const Triangle& t : surface.triangles())
        for (std::size_t k = 0; k < 3; ++k)
            sum += (surface.points()[t[k]] - surface.points()[t[(k + 1) % 3]]).norm();
    const double edge = sum / (3.0 * static_cast<double>(surface.triangle_count()));
    std::mt19937 random(7);
    Positions moved = surface.points();
    for (Vec3& p : moved)
        for (int a = 0; a < 3; ++a) {
            // Twelve uniform deviates: nearly normal, and the same with every standard library.
            double deviate = -6.0;
            for (int k = 0; k < 12; ++k) deviate += static_cast<double>(random()) / 4294967296.0;
            p[a] += amount * edge * deviate;
        }
    return surface.with_positions(std::move(moved));
}

}  // namespace vesselbench::test
