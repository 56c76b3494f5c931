#include "meshing/tetrahedra/quality.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "geometry/errors.h"

namespace vesselbench {

namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

struct RawFace {
    Triangle key;      // corners, ascending
    Triangle corners;  // outward of its cell
    std::uint32_t cell;
};

std::vector<RawFace> raw_faces(const VolumeMesh& mesh) {
    std::vector<RawFace> faces;
    faces.reserve(4 * mesh.tetrahedra.size());
    for (std::uint32_t cell = 0; cell < mesh.tetrahedra.size(); ++cell) {
        for (const Triangle& corners : faces_of(mesh.tetrahedra[cell])) {
            RawFace face{corners, corners, cell};
            std::sort(face.key.begin(), face.key.end());
            faces.push_back(face);
        }
    }
    std::sort(faces.begin(), faces.end(), [](const RawFace& l, const RawFace& r) {
        return std::tie(l.key, l.cell) < std::tie(r.key, r.cell);
    });
    return faces;
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

std::uint16_t patch_of(const PatchOfFace& patches, const Triangle& key) {
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

// primitiveMeshTools::cellClosedness: 2D extent of the sums of |face area| against 3D, and
// 1/6 of the L1 sum against volume^(2/3); the larger one.
double aspect_ratio(const VolumeMesh& mesh, const Tetrahedron& tet, double volume) {
    Vec3 sum = Vec3::Zero();
    const auto& p = mesh.points;
    for (const Triangle& f : faces_of(tet))
        sum += (0.5 * (p[f[1]] - p[f[0]]).cross(p[f[2]] - p[f[0]])).cwiseAbs();
    const double flat = sum.maxCoeff() / std::max(sum.minCoeff(), 1e-300);
    const double stretched = sum.sum() / 6.0 / std::pow(std::max(volume, 1e-300), 2.0 / 3.0);
    return std::max(flat, stretched);
}

void add_cells(const VolumeMesh& mesh, VolumeQuality& quality, std::vector<CellShape>& shapes) {
    double edges = 0.0;
    quality.smallest_cell = mesh.tetrahedra.empty() ? 0.0 : 1e300;
    quality.smallest_dihedral = 180.0;
    for (const Tetrahedron& tet : mesh.tetrahedra) {
        const Vec3 &a = mesh.points[tet[0]], &b = mesh.points[tet[1]], &c = mesh.points[tet[2]],
                   &d = mesh.points[tet[3]];
        const double volume = (b - a).cross(c - a).dot(d - a) / 6.0;
        shapes.push_back({(a + b + c + d) / 4.0, volume});
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

// Distance of the point where the line between the cell centres meets the face from the face's
// centre, against the face's extent in that direction (primitiveMeshTools::faceSkewness).
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

// At the boundary the line is the owner's centre dropped along the normal
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

void add_faces(const VolumeMesh& mesh, const std::vector<CellShape>& shapes,
               VolumeQuality& quality) {
    double cosines = 0.0, ratios = 0.0;
    for (const MeshFace& face : mesh_faces(mesh)) {
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
        const double cosine = line.dot(normal) / (line.norm() * normal.norm() + 1e-300);
        const double angle = std::acos(std::clamp(cosine, -1.0, 1.0)) * kDegrees;
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
    // As checkMesh: the angle of the mean cosine.
    quality.mean_non_orthogonality = std::acos(std::clamp(cosines / inner, -1.0, 1.0)) * kDegrees;
    quality.mean_volume_ratio = ratios / inner;
}

}  // namespace

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
    const std::vector<RawFace> raw = raw_faces(mesh);
    const PatchOfFace patches = sorted_boundary(mesh);
    std::vector<MeshFace> faces;
    faces.reserve(raw.size() / 2 + mesh.boundary.size());
    for (std::size_t i = 0; i < raw.size(); ++i) {
        MeshFace face{.corners = raw[i].corners, .owner = raw[i].cell};
        if (i + 1 < raw.size() && raw[i + 1].key == raw[i].key) {
            if (i + 2 < raw.size() && raw[i + 2].key == raw[i].key)
                throw InvalidInput("volume mesh: a face belongs to three cells");
            face.neighbour = raw[++i].cell;
        } else {
            face.patch = patch_of(patches, raw[i].key);
        }
        faces.push_back(face);
    }
    const auto rank = [](const MeshFace& f) {
        const bool outer = f.neighbour == MeshFace::kOutside;
        return std::tuple(outer, outer ? f.patch : std::uint16_t{0}, f.owner, f.neighbour,
                          f.corners);
    };
    std::sort(faces.begin(), faces.end(),
              [&](const MeshFace& l, const MeshFace& r) { return rank(l) < rank(r); });
    return faces;
}

VolumeQuality volume_quality(const VolumeMesh& mesh) {
    VolumeQuality quality;
    quality.points = mesh.points.size();
    quality.cells = mesh.tetrahedra.size();
    std::vector<CellShape> shapes;
    shapes.reserve(mesh.tetrahedra.size());
    add_cells(mesh, quality, shapes);
    add_faces(mesh, shapes, quality);
    return quality;
}

}  // namespace vesselbench
