#include "geometry/vessel/centerlines/terraces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "geometry/kernel/measure.h"

namespace vesselbench {

namespace {

/// How near to one direction a share of the wall has to be.
struct Parallel {
    double cosine = 1.0;
    double share = 0.0;  ///< of the wall's area [-]
};

/// Faces of a staircase are parallel but for rounding (0.05 degrees), or for a little smoothing
/// (0.5 degrees; of a straight vessel's wall at right angles to the cap, 0.6 % are so near).
/// Staircases of voxels have 3.5 % of their wall parallel to a step; thin vessels across the slices
/// 0.6 %.
constexpr std::array kParallel = {Parallel{0.9999996, 0.003}, Parallel{0.99996, 0.02}};

/// Faces at the same height within this many mean edges are of one plane.
constexpr double kOnePlane = 0.1;
/// Opposite ends of a vessel may be parallel, but a staircase has many steps.
constexpr std::size_t kCapPlanes = 2;

/// Area of the planes of parallel faces, without the two that have most of it.
/// \param faces height along their direction, and area; sorted
/// \param apart heights of one plane [mm]
double area_of_steps(const std::vector<std::pair<double, double>>& faces, double apart) {
    std::vector<double> planes;
    for (std::size_t i = 0; i < faces.size(); ++i) {
        if (i == 0 || faces[i].first - faces[i - 1].first > apart) planes.push_back(0.0);
        planes.back() += faces[i].second;
    }
    std::ranges::sort(planes, std::greater{});
    double steps = 0.0;
    for (std::size_t i = kCapPlanes; i < planes.size(); ++i) steps += planes[i];
    return steps;
}

}  // namespace

bool is_terrace(const Positions& points, std::span<const Triangle> wall, const Vec3& direction) {
    std::array<std::vector<std::pair<double, double>>, kParallel.size()> faces;  // height, area
    double whole = 0.0, edges = 0.0;
    for (const Triangle& corners : wall) {
        const Vec3 normal = area_normal(points, corners);
        const double size = normal.norm(), along = std::abs(normal.dot(direction));
        whole += size;
        edges += std::sqrt(size);
        for (std::size_t i = 0; i < kParallel.size(); ++i)
            if (along > kParallel[i].cosine * size)
                faces[i].emplace_back(points[corners[0]].dot(direction), size);
    }
    const double apart =
        kOnePlane * edges / static_cast<double>(std::max<std::size_t>(wall.size(), 1));
    for (std::size_t i = 0; i < kParallel.size(); ++i) {
        std::ranges::sort(faces[i]);
        if (area_of_steps(faces[i], apart) > kParallel[i].share * whole) return true;
    }
    return !(whole > 0.0);
}

}  // namespace vesselbench
