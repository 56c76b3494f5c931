#include "meshing/tetrahedra/quality.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <tbb/parallel_for.h>

#include "geometry/kernel/errors.h"

namespace vesselbench {

namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

constexpr std::uint32_t kOutside = MeshFace::kOutside;

struct Side {
    VertexId middle, high;    // the other two corners, ascending
    std::uint32_t cell_face;  // 4 * cell + number of the face
};

// The sides of all cells in buckets by their lowest corner, in cell order.
struct SideBuckets {
    std::vector<std::uint32_t> offsets;
    std::vector<Side> sides;
};

SideBuckets side_buckets(const VolumeMesh& mesh) {
    SideBuckets buckets;
    buckets.offsets.assign(mesh.points.size() + 1, 0);
    const auto for_each_side = [&](const auto& use) {
        for (std::uint32_t cell = 0; cell < mesh.tetrahedra.size(); ++cell)
            for (std::uint32_t k = 0; k < 4; ++k) {
                Triangle key = faces_of(mesh.tetrahedra[cell])[k];
                std::sort(key.begin(), key.end());
                use(key, 4 * cell + k);
            }
    };
    for_each_side([&](const Triangle& key, std::uint32_t) { ++buckets.offsets[key[0] + 1]; });
    std::partial_sum(buckets.offsets.begin(), buckets.offsets.end(), buckets.offsets.begin());
    std::vector<std::uint32_t> next = buckets.offsets;
    buckets.sides.resize(4 * mesh.tetrahedra.size());
    for_each_side([&](const Triangle& key, std::uint32_t cell_face) {
        buckets.sides[next[key[0]]++] = {key[1], key[2], cell_face};
    });
    return buckets;
}

// Cell behind each of the 4 * #cells sides, or kOutside.
std::vector<std::uint32_t> cells_behind(const VolumeMesh& mesh) {
    const SideBuckets buckets = side_buckets(mesh);
    std::vector<std::uint32_t> behind(4 * mesh.tetrahedra.size(), kOutside);
    tbb::parallel_for(std::size_t{0}, mesh.points.size(), [&](std::size_t v) {
        for (std::uint32_t i = buckets.offsets[v]; i < buckets.offsets[v + 1]; ++i)
            for (std::uint32_t j = i + 1; j < buckets.offsets[v + 1]; ++j) {
                const Side &a = buckets.sides[i], &b = buckets.sides[j];
                if (a.middle != b.middle || a.high != b.high) continue;
                if (behind[a.cell_face] != kOutside || behind[b.cell_face] != kOutside)
                    throw InvalidInput("volume mesh: a face belongs to three cells");
                behind[a.cell_face] = b.cell_face / 4;
                behind[b.cell_face] = a.cell_face / 4;
            }
    });
    return behind;
}

using PatchOfFace = std::vector<std::pair<Triangle, std::uint16_t>>;

PatchOfFace sorted_boundary(const VolumeMesh& mesh) {
    PatchOfFace patches;
    for (std::size_t f = 0; f < mesh.boundary.size(); ++f) {
        Triangle key = mesh.boundary[f];
        std::sort(key.begin(), key.end());
        patches.emplace_back(key, mesh.boundary_patches[f]);
    }
    std::sort(patches.begin(), patches.end());
    return patches;
}

std::uint16_t patch_of(const PatchOfFace& patches, Triangle key) {
    std::sort(key.begin(), key.end());
    const auto found =
        std::lower_bound(patches.begin(), patches.end(), std::pair{key, std::uint16_t{0}});
    if (found == patches.end() || found->first != key)
        throw InvalidInput("volume mesh: an outer face belongs to no patch");
    return found->second;
}

struct CellShape {
    Vec3 centre;
    double volume;
};

// primitiveMeshTools::cellClosedness: ratio of the 2D extents of the sums of |face area|, and in 3D
// 1/6 of the L1 sum over volume^(2/3); the larger one.
double aspect_ratio(const VolumeMesh& mesh, const Tetrahedron& tet, double volume) {
    Vec3 sum = Vec3::Zero();
    const auto& p = mesh.points;
    for (const Triangle& f : faces_of(tet))
        sum += (0.5 * (p[f[1]] - p[f[0]]).cross(p[f[2]] - p[f[0]])).cwiseAbs();
    const double flat = sum.maxCoeff() / std::max(sum.minCoeff(), 1e-300);
    const double stretched = sum.sum() / 6.0 / std::pow(std::max(volume, 1e-300), 2.0 / 3.0);
    return std::max(flat, stretched);
}

Vec3 cell_centre(const VolumeMesh& mesh, const Tetrahedron& tet) {
    const auto& p = mesh.points;
    return (p[tet[0]] + p[tet[1]] + p[tet[2]] + p[tet[3]]) / 4.0;
}

/// Of the angle between a face's normal and the line between the cells' centres.
double non_orthogonality_cosine(const Vec3& line, const Vec3& normal) {
    return line.dot(normal) / (line.norm() * normal.norm() + 1e-300);
}

double degrees_of(double cosine) {
    return std::acos(std::clamp(cosine, -1.0, 1.0)) * kDegrees;
}

void add_cells(const VolumeMesh& mesh, VolumeQuality& quality, std::vector<CellShape>& shapes) {
    double edges = 0.0;
    quality.smallest_cell = mesh.tetrahedra.empty() ? 0.0 : 1e300;
    quality.smallest_dihedral = 180.0;
    for (const Tetrahedron& tet : mesh.tetrahedra) {
        const Vec3 &a = mesh.points[tet[0]], &b = mesh.points[tet[1]], &c = mesh.points[tet[2]],
                   &d = mesh.points[tet[3]];
        const double volume = (b - a).cross(c - a).dot(d - a) / 6.0;
        shapes.push_back({cell_centre(mesh, tet), volume});
        edges += (a - b).norm() + (a - c).norm() + (a - d).norm() + (b - c).norm() +
                 (b - d).norm() + (c - d).norm();
        const auto angles = dihedral_angles(a, b, c, d);
        const auto [low, high] = std::minmax_element(angles.begin(), angles.end());
        quality.smallest_dihedral = std::min(quality.smallest_dihedral, *low);
        quality.largest_dihedral = std::max(quality.largest_dihedral, *high);
        quality.mean_smallest_dihedral += *low;
        quality.cells_below_10_deg += *low < 10.0 ? 1 : 0;
        quality.volume += volume;
        quality.smallest_cell = std::min(quality.smallest_cell, volume);
        quality.largest_aspect_ratio =
            std::max(quality.largest_aspect_ratio, aspect_ratio(mesh, tet, volume));
    }
    const auto count = static_cast<double>(std::max<std::size_t>(1, mesh.tetrahedra.size()));
    quality.mean_edge = edges / (6.0 * count);
    quality.mean_smallest_dihedral /= count;
}

// Distance between the face's centre and the point where the line between the cell centres meets
// the face, relative to the face's extent in that direction (primitiveMeshTools::faceSkewness).
double skewness(const VolumeMesh& mesh, const MeshFace& face, const Vec3& normal, const Vec3& from,
                const Vec3& to) {
    const auto& p = mesh.points;
    const Vec3 centre = (p[face.corners[0]] + p[face.corners[1]] + p[face.corners[2]]) / 3.0;
    const Vec3 line = to - from;
    const Vec3 offset =
        centre - from - (normal.dot(centre - from) / (normal.dot(line) + 1e-300)) * line;
    const double length = offset.norm();
    double extent = 0.2 * line.norm();
    for (const VertexId v : face.corners)
        extent = std::max(extent, std::abs(offset.dot(p[v] - centre)) / (length + 1e-300));
    return length / (extent + 1e-300);
}

// At the boundary the line is the normal through the owner's centre
// (primitiveMeshTools::boundaryFaceSkewness).
double boundary_skewness(const VolumeMesh& mesh, const MeshFace& face, const Vec3& normal,
                         const Vec3& owner) {
    const auto& p = mesh.points;
    const Vec3 centre = (p[face.corners[0]] + p[face.corners[1]] + p[face.corners[2]]) / 3.0;
    const Vec3 drop = normal.dot(centre - owner) / normal.squaredNorm() * normal;
    const Vec3 offset = centre - owner - drop;
    const double length = offset.norm();
    double extent = 0.4 * drop.norm();
    for (const VertexId v : face.corners)
        extent = std::max(extent, std::abs(offset.dot(p[v] - centre)) / (length + 1e-300));
    return length / (extent + 1e-300);
}

void add_faces(const VolumeMesh& mesh, std::span<const MeshFace> faces,
               const std::vector<CellShape>& shapes, VolumeQuality& quality) {
    double cosines = 0.0, ratios = 0.0;
    for (const MeshFace& face : faces) {
        ++quality.faces;
        const Vec3 normal = area_normal(mesh.points, face.corners);
        const CellShape& owner = shapes[face.owner];
        if (face.neighbour == MeshFace::kOutside) {
            quality.largest_skewness = std::max(
                quality.largest_skewness, boundary_skewness(mesh, face, normal, owner.centre));
            continue;
        }
        const CellShape& neighbour = shapes[face.neighbour];
        const Vec3 line = neighbour.centre - owner.centre;
        const double cosine = non_orthogonality_cosine(line, normal);
        const double angle = degrees_of(cosine);
        const double ratio = std::max(owner.volume, neighbour.volume) /
                             std::max(1e-300, std::min(owner.volume, neighbour.volume));
        ++quality.inner_faces;
        cosines += cosine;
        ratios += ratio;
        quality.faces_over_70_deg += angle > 70.0 ? 1 : 0;
        quality.largest_non_orthogonality = std::max(quality.largest_non_orthogonality, angle);
        quality.largest_volume_ratio = std::max(quality.largest_volume_ratio, ratio);
        quality.largest_skewness = std::max(
            quality.largest_skewness, skewness(mesh, face, normal, owner.centre, neighbour.centre));
    }
    const auto inner = static_cast<double>(std::max<std::size_t>(1, quality.inner_faces));
    // As in checkMesh: the angle of the mean cosine.
    quality.mean_non_orthogonality = degrees_of(cosines / inner);
    quality.mean_volume_ratio = ratios / inner;
}

}  // namespace

double largest_non_orthogonality(const VolumeMesh& mesh, std::span<const MeshFace> faces) {
    double largest = 0.0;
    for (const MeshFace& face : faces) {
        if (face.neighbour == MeshFace::kOutside) continue;
        const Vec3 line = cell_centre(mesh, mesh.tetrahedra[face.neighbour]) -
                          cell_centre(mesh, mesh.tetrahedra[face.owner]);
        const Vec3 normal = area_normal(mesh.points, face.corners);
        largest = std::max(largest, degrees_of(non_orthogonality_cosine(line, normal)));
    }
    return largest;
}

std::array<double, 6> dihedral_angles(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const std::array<Vec3, 4> out = {
        (c - b).cross(d - b).normalized(), (d - a).cross(c - a).normalized(),
        (b - a).cross(d - a).normalized(), (c - a).cross(b - a).normalized()};
    std::array<double, 6> angles;
    std::size_t n = 0;
    for (int i = 0; i < 4; ++i)
        for (int j = i + 1; j < 4; ++j)
            angles[n++] = std::acos(std::clamp(-out[i].dot(out[j]), -1.0, 1.0)) * kDegrees;
    return angles;
}

std::vector<MeshFace> mesh_faces(const VolumeMesh& mesh) {
    const std::vector<std::uint32_t> behind = cells_behind(mesh);
    const PatchOfFace patches = sorted_boundary(mesh);
    std::vector<MeshFace> faces, outer;
    faces.reserve(2 * mesh.tetrahedra.size() + mesh.boundary.size());
    for (std::uint32_t cell = 0; cell < mesh.tetrahedra.size(); ++cell) {
        const auto corners = faces_of(mesh.tetrahedra[cell]);
        const std::size_t first = faces.size();
        for (std::uint32_t k = 0; k < 4; ++k) {
            const std::uint32_t other = behind[4 * cell + k];
            if (other == kOutside)
                outer.push_back(
                    {.corners = corners[k], .owner = cell, .patch = patch_of(patches, corners[k])});
            else if (cell < other)
                faces.push_back({.corners = corners[k], .owner = cell, .neighbour = other});
        }
        std::sort(faces.begin() + static_cast<std::ptrdiff_t>(first), faces.end(),
                  [](const auto& l, const auto& r) { return l.neighbour < r.neighbour; });
    }
    std::stable_sort(outer.begin(), outer.end(),
                     [](const auto& l, const auto& r) { return l.patch < r.patch; });
    faces.insert(faces.end(), outer.begin(), outer.end());
    return faces;
}

VolumeQuality volume_quality(const VolumeMesh& mesh) {
    return volume_quality(mesh, mesh_faces(mesh));
}

VolumeQuality volume_quality(const VolumeMesh& mesh, std::span<const MeshFace> faces) {
    VolumeQuality quality;
    quality.points = mesh.points.size();
    quality.cells = mesh.tetrahedra.size();
    std::vector<CellShape> shapes;
    shapes.reserve(mesh.tetrahedra.size());
    add_cells(mesh, quality, shapes);
    add_faces(mesh, faces, shapes, quality);
    return quality;
}

std::vector<double> smallest_dihedral_angles(const VolumeMesh& mesh, const Progress& progress) {
    constexpr std::size_t kBetweenChecks = 1 << 14;
    std::vector<double> values(mesh.tetrahedra.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (i % kBetweenChecks == 0) progress.check_cancelled();
        const Tetrahedron& t = mesh.tetrahedra[i];
        values[i] = std::ranges::min(dihedral_angles(mesh.points[t[0]], mesh.points[t[1]],
                                                     mesh.points[t[2]], mesh.points[t[3]]));
    }
    return values;
}

}  // namespace vesselbench
