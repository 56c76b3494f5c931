#include "geometry/image/iso_surface.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <span>
#include <string>
#include <utility>

#include <Eigen/LU>
#include <tbb/parallel_for.h>

#include "geometry/image/flying_edges.h"
#include "geometry/kernel/edges.h"
#include "geometry/kernel/errors.h"

namespace vesselbench {

namespace {

using Index3 = std::array<float, 3>;

/// A grid value closer to the iso-value than this fraction of the largest difference to a neighbour
/// makes a sliver; it is moved that far away. The surface moves by at most that fraction of a voxel
/// edge.
constexpr float kClear = 1e-2f;

constexpr const char* kWhat = "extracting the surface";

/// The value relative to the iso-value, positive inside, never too close to 0.
float cleared(const Image& image, int i, int j, int k, float iso, float sign, float fallback) {
    const auto relative = [&](int x, int y, int z) { return sign * (image.at(x, y, z) - iso); };
    const float value = relative(i, j, k);
    float reach = 0.0f;
    const auto look = [&](int x, int y, int z) {
        if (x >= 0 && y >= 0 && z >= 0 && x < image.size[0] && y < image.size[1] &&
            z < image.size[2])
            reach = std::max(reach, std::abs(relative(x, y, z) - value));
    };
    look(i - 1, j, k);
    look(i + 1, j, k);
    look(i, j - 1, k);
    look(i, j + 1, k);
    look(i, j, k - 1);
    look(i, j, k + 1);
    const float least = kClear * (reach > 0.0f ? reach : fallback);
    if (std::abs(value) >= least) return value;
    return value >= 0.0f ? least : -least;
}

/// The image relative to the iso-value with one layer of outside around it.
std::vector<float> padded(const Image& image, double iso, bool inside_below,
                          const Progress& cancel) {
    const auto [ni, nj, nk] = image.size;
    const std::size_t slice = static_cast<std::size_t>(ni + 2) * static_cast<std::size_t>(nj + 2);
    std::vector<float> values(slice * static_cast<std::size_t>(nk + 2));
    const auto [least, most] = std::minmax_element(image.voxels->begin(), image.voxels->end());
    const float range = std::max(*most - *least, 1e-20f);
    const float sign = inside_below ? -1.0f : 1.0f;
    const auto level = static_cast<float>(iso);
    tbb::parallel_for(-1, nk + 1, [&, ni = ni, nj = nj, nk = nk](int k) {
        cancel.check_cancelled();
        float* at = values.data() + static_cast<std::size_t>(k + 1) * slice;
        for (int j = -1; j <= nj; ++j)
            for (int i = -1; i <= ni; ++i, ++at) {
                const bool within = i >= 0 && j >= 0 && k >= 0 && i < ni && j < nj && k < nk;
                *at = within ? cleared(image, i, j, k, level, sign, range) : -range;
            }
    });
    return values;
}

/// The iso-surface in index coordinates of the image; the padding layer's vertices are beyond its
/// border.
GridSurface index_mesh(const Image& image, double iso, bool inside_below,
                       const Progress& progress) {
    const auto [ni, nj, nk] = image.size;
    progress.report(0.0, kWhat);
    const std::vector<float> values = padded(image, iso, inside_below, progress);
    progress.report(0.3, kWhat);
    return flying_edges(std::span<const float>(values),
                        {.size = {ni + 2, nj + 2, nk + 2}, .origin = Vec3(-1.0, -1.0, -1.0)});
}

/// The border planes a point lies in: bit 2a for index 0 of axis a, bit 2a + 1 for the last one.
unsigned border_planes(const Index3& p, const std::array<int, 3>& size) {
    unsigned planes = 0;
    for (std::size_t a = 0; a < 3; ++a) {
        if (p[a] <= 0.0f) planes |= 1u << (2 * a);
        if (p[a] >= static_cast<float>(size[a] - 1)) planes |= 2u << (2 * a);
    }
    return planes;
}

/// Projects the padding layer onto the border planes and merges the vertices that coincide there.
void press_to_border(GridSurface& mesh, const std::array<int, 3>& size) {
    std::map<Index3, VertexId> at_border;
    std::vector<VertexId> new_id(mesh.points.size());
    std::vector<Index3> kept;
    for (std::size_t v = 0; v < mesh.points.size(); ++v) {
        Index3 p = mesh.points[v];
        const bool border = border_planes(p, size) != 0;
        for (std::size_t a = 0; a < 3; ++a)
            p[a] = std::clamp(p[a], 0.0f, static_cast<float>(size[a] - 1));
        const auto id = static_cast<VertexId>(kept.size());
        new_id[v] = border ? at_border.try_emplace(p, id).first->second : id;
        if (new_id[v] == id) kept.push_back(p);
    }
    for (Triangle& t : mesh.triangles)
        for (VertexId& v : t) v = new_id[v];
    std::erase_if(mesh.triangles, names_vertex_twice);
    mesh.points = std::move(kept);
}

/// Per triangle 0 for the wall, else 1 + the number of the border plane that contains it.
PatchLabels border_labels(const GridSurface& mesh, const std::array<int, 3>& size) {
    PatchLabels labels;
    labels.reserve(mesh.triangles.size());
    for (const auto& [a, b, c] : mesh.triangles) {
        const unsigned common = border_planes(mesh.points[a], size) &
                                border_planes(mesh.points[b], size) &
                                border_planes(mesh.points[c], size);
        labels.push_back(
            static_cast<std::uint16_t>(common == 0 ? 0 : std::countr_zero(common) + 1));
    }
    return labels;
}

}  // namespace

Surface iso_surface(const Image& image, double iso, bool inside_below, const Progress& progress) {
    for (const int n : image.size)
        if (n < 2)
            throw InvalidInput(
                "the image has fewer than two voxels along an axis: a surface needs "
                "a volume");
    GridSurface mesh = index_mesh(image, iso, inside_below, progress);
    progress.report(0.6, kWhat);
    press_to_border(mesh, image.size);
    progress.report(0.8, kWhat);
    PatchLabels labels = border_labels(mesh, image.size);
    std::vector<Patch> patches = {{"wall", PatchKind::Wall}};
    for (int p = 1; p <= 6; ++p) patches.push_back({"border_" + std::to_string(p), PatchKind::Cut});
    Positions positions;
    positions.reserve(mesh.points.size());
    for (const Index3& p : mesh.points)
        positions.push_back(image.to_patient(Vec3(p[0], p[1], p[2])));
    if (image.index_to_patient.topLeftCorner<3, 3>().determinant() < 0.0)
        for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
    progress.report(0.9, kWhat);
    return make_surface(std::move(positions), std::move(mesh.triangles), std::move(labels),
                        std::move(patches));
}

}  // namespace vesselbench
