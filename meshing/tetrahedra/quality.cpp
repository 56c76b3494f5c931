#include "meshing/tetrahedra/quality.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <tbb/parallel_for.h>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/parallel.h"

namespace vesselbench {

namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

constexpr std::uint32_t kOutside = MeshFace::kOutside;

// Calls use(k, corners) for each face of a cell.
template <class Use>
void for_each_face(const VolumeMesh& mesh, std::size_t cell, const Use& use) {
    std::size_t k = 0;
    if (cell < mesh.tetrahedra.size())
        for (const Triangle& face : faces_of(mesh.tetrahedra[cell])) use(k++, FaceCorners(face));
    else
        for (const FaceCorners& face : faces_of(mesh.prisms[cell - mesh.tetrahedra.size()]))
            use(k++, face);
}

// The three lowest corners, ascending: no two faces of a mesh share three corners.
Triangle key_of(const FaceCorners& face) {
    Quadrilateral sorted{face[0], face[1], face[2], face.size() > 3 ? face[3] : ~VertexId{0}};
    std::ranges::sort(sorted);
    return {sorted[0], sorted[1], sorted[2]};
}

struct Side {
    VertexId middle, high;    // the other two corners of its key, ascending
    std::uint32_t cell_face;  // 8 * cell + number of the face
};

// The sides of all cells in buckets by their lowest corner, in cell order.
struct SideBuckets {
    std::vector<std::uint32_t> offsets;
    std::vector<Side> sides;
};

SideBuckets side_buckets(const VolumeMesh& mesh, const Progress& cancel) {
    constexpr std::uint32_t kPiece = 1U << 16U;  // a few milliseconds
    SideBuckets buckets;
    buckets.offsets.assign(mesh.points.size() + 1, 0);
    const auto for_each_side = [&](const auto& use) {
        for (std::uint32_t cell = 0; cell < mesh.cell_count(); ++cell) {
            if (cell % kPiece == 0) cancel.check_cancelled();
            for_each_face(mesh, cell, [&](std::size_t k, const FaceCorners& face) {
                use(key_of(face), 8 * cell + static_cast<std::uint32_t>(k));
            });
        }
    };
    for_each_side([&](const Triangle& key, std::uint32_t) { ++buckets.offsets[key[0] + 1]; });
    std::partial_sum(buckets.offsets.begin(), buckets.offsets.end(), buckets.offsets.begin());
    std::vector<std::uint32_t> next = buckets.offsets;
    buckets.sides.resize(4 * mesh.tetrahedra.size() + 5 * mesh.prisms.size());
    for_each_side([&](const Triangle& key, std::uint32_t cell_face) {
        buckets.sides[next[key[0]]++] = {key[1], key[2], cell_face};
    });
    return buckets;
}

using PatchOfFace = std::vector<std::pair<Triangle, std::uint16_t>>;

PatchOfFace sorted_boundary(const VolumeMesh& mesh) {
    PatchOfFace patches;
    for (std::size_t f = 0; f < mesh.boundary.size(); ++f)
        patches.emplace_back(key_of(mesh.boundary[f]), mesh.boundary_patches[f]);
    for (std::size_t f = 0; f < mesh.boundary_sides.size(); ++f)
        patches.emplace_back(key_of(mesh.boundary_sides[f]), mesh.side_patches[f]);
    std::sort(patches.begin(), patches.end());
    return patches;
}

std::uint16_t patch_of(const PatchOfFace& patches, const FaceCorners& face) {
    const Triangle key = key_of(face);
    const auto found =
        std::lower_bound(patches.begin(), patches.end(), std::pair{key, std::uint16_t{0}});
    if (found == patches.end() || found->first != key)
        throw InvalidInput("volume mesh: an outer face belongs to no patch");
    return found->second;
}

// By patch, then by owner.
std::vector<MeshFace> outer_faces(const VolumeMesh& mesh, const CellNeighbours& neighbours) {
    const PatchOfFace patches = sorted_boundary(mesh);
    std::vector<MeshFace> outer;
    for (std::uint32_t cell = 0; cell < neighbours.size(); ++cell)
        for_each_face(mesh, cell, [&](std::size_t k, const FaceCorners& corners) {
            if (neighbours[cell][k] != kOutside) return;
            outer.push_back(
                {.corners = corners, .owner = cell, .patch = patch_of(patches, corners)});
        });
    std::stable_sort(outer.begin(), outer.end(),
                     [](const auto& l, const auto& r) { return l.patch < r.patch; });
    return outer;
}

struct CellShape {
    Vec3 centre;
    double volume;
};

// primitiveMeshTools::cellClosedness: ratio of the 2D extents of the sums of |face area|, and in 3D
// 1/6 of the L1 sum over volume^(2/3); the larger one.
template <class Cell>
double aspect_ratio(const VolumeMesh& mesh, const Cell& cell, double volume) {
    Vec3 sum = Vec3::Zero();
    for (const FaceCorners face : faces_of(cell))
        sum += (0.5 * face_normal(mesh.points, face)).cwiseAbs();
    const double flat = sum.maxCoeff() / std::max(sum.minCoeff(), 1e-300);
    const double stretched = sum.sum() / 6.0 / std::pow(std::max(volume, 1e-300), 2.0 / 3.0);
    return std::max(flat, stretched);
}

Vec3 cell_centre(const VolumeMesh& mesh, const Tetrahedron& tet) {
    const auto& p = mesh.points;
    return (p[tet[0]] + p[tet[1]] + p[tet[2]] + p[tet[3]]) / 4.0;
}

// primitiveMeshFaceCentresAndAreas: a quadrilateral's triangles around the mean of its corners,
// weighted by area.
Vec3 face_centre(const Positions& p, const FaceCorners& face) {
    if (face.size() == 3) return (p[face[0]] + p[face[1]] + p[face[2]]) / 3.0;
    const Vec3 middle = (p[face[0]] + p[face[1]] + p[face[2]] + p[face[3]]) / 4.0;
    Vec3 sum = Vec3::Zero();
    double area = 0.0;
    for (std::size_t k = 0; k < 4; ++k) {
        const Vec3 &a = p[face[k]], &b = p[face[(k + 1) % 4]];
        const double weight = (b - a).cross(middle - a).norm();
        sum += weight / 3.0 * (a + b + middle);
        area += weight;
    }
    return area > 0.0 ? Vec3(sum / area) : middle;
}

// primitiveMeshCellCentresAndVols: pyramids over the faces from the mean of their centres.
CellShape prism_shape(const Positions& points, const Prism& prism) {
    const auto faces = faces_of(prism);
    std::array<Vec3, 5> centres;
    Vec3 apex = Vec3::Zero(), sum = Vec3::Zero();
    for (std::size_t k = 0; k < 5; ++k) {
        centres[k] = face_centre(points, faces[k]);
        apex += centres[k] / 5.0;
    }
    double volume = 0.0;
    for (std::size_t k = 0; k < 5; ++k) {
        const double pyramid = face_normal(points, faces[k]).dot(centres[k] - apex) / 6.0;
        sum += pyramid * (0.75 * centres[k] + 0.25 * apex);
        volume += pyramid;
    }
    return {std::abs(volume) > 1e-300 ? Vec3(sum / volume) : apex, volume};
}

Vec3 cell_centre(const VolumeMesh& mesh, std::size_t cell) {
    const std::size_t count = mesh.tetrahedra.size();
    return cell < count ? cell_centre(mesh, mesh.tetrahedra[cell])
                        : prism_shape(mesh.points, mesh.prisms[cell - count]).centre;
}

// Between the faces that share an edge: both triangles and each side, and every two sides.
std::array<double, 9> dihedral_cosines(const Positions& points, const Prism& prism) {
    std::array<Vec3, 5> out;
    const auto faces = faces_of(prism);
    for (std::size_t k = 0; k < 5; ++k) out[k] = face_normal(points, faces[k]).normalized();
    std::array<double, 9> cosines;
    for (std::size_t side = 0; side < 3; ++side) {
        cosines[3 * side] = -out[0].dot(out[2 + side]);
        cosines[3 * side + 1] = -out[1].dot(out[2 + side]);
        cosines[3 * side + 2] = -out[2 + side].dot(out[2 + (side + 1) % 3]);
    }
    return cosines;
}

double edge_sum(const Positions& p, const Prism& prism) {
    double sum = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t next = (k + 1) % 3;
        sum += (p[prism[k]] - p[prism[next]]).norm() + (p[prism[k]] - p[prism[k + 3]]).norm() +
               (p[prism[k + 3]] - p[prism[next + 3]]).norm();
    }
    return sum;
}

/// Of the angle between a face's normal and the line between the cells' centres.
double non_orthogonality_cosine(const Vec3& line, const Vec3& normal) {
    return line.dot(normal) / (line.norm() * normal.norm() + 1e-300);
}

double degrees_of(double cosine) {
    return std::acos(std::clamp(cosine, -1.0, 1.0)) * kDegrees;
}

std::array<double, 6> dihedral_cosines(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const std::array<Vec3, 4> out = {
        (c - b).cross(d - b).normalized(), (d - a).cross(c - a).normalized(),
        (b - a).cross(d - a).normalized(), (c - a).cross(b - a).normalized()};
    std::array<double, 6> cosines;
    std::size_t n = 0;
    for (int i = 0; i < 4; ++i)
        for (int j = i + 1; j < 4; ++j) cosines[n++] = -out[i].dot(out[j]);
    return cosines;
}

// Sums and extremes over some of the cells or faces.
struct CellSums {
    double edges = 0.0, volume = 0.0, smallest_dihedrals = 0.0;
    double smallest_cell = 1e300, smallest_dihedral = 180.0, largest_dihedral = 0.0;
    double largest_aspect_ratio = 0.0;
    std::size_t below_10_deg = 0;
    double smallest_jacobian = 1.0;

    friend CellSums operator+(const CellSums& l, const CellSums& r) {
        return {l.edges + r.edges,
                l.volume + r.volume,
                l.smallest_dihedrals + r.smallest_dihedrals,
                std::min(l.smallest_cell, r.smallest_cell),
                std::min(l.smallest_dihedral, r.smallest_dihedral),
                std::max(l.largest_dihedral, r.largest_dihedral),
                std::max(l.largest_aspect_ratio, r.largest_aspect_ratio),
                l.below_10_deg + r.below_10_deg,
                std::min(l.smallest_jacobian, r.smallest_jacobian)};
    }
};

struct FaceSums {
    std::size_t inner = 0, over_70_deg = 0;
    double cosines = 0.0, ratios = 0.0;
    double largest_angle = 0.0, largest_ratio = 1.0, largest_skewness = 0.0;

    friend FaceSums operator+(const FaceSums& l, const FaceSums& r) {
        return {l.inner + r.inner,
                l.over_70_deg + r.over_70_deg,
                l.cosines + r.cosines,
                l.ratios + r.ratios,
                std::max(l.largest_angle, r.largest_angle),
                std::max(l.largest_ratio, r.largest_ratio),
                std::max(l.largest_skewness, r.largest_skewness)};
    }
};

template <std::size_t Count>
void add_dihedrals(const std::array<double, Count>& cosines, CellSums& sums) {
    const auto [low, high] = std::minmax_element(cosines.begin(), cosines.end());
    const double smallest = degrees_of(*high);
    sums.smallest_dihedral = std::min(sums.smallest_dihedral, smallest);
    sums.largest_dihedral = std::max(sums.largest_dihedral, degrees_of(*low));
    sums.smallest_dihedrals += smallest;
    sums.below_10_deg += smallest < 10.0 ? 1 : 0;
}

void add_volume(const CellShape& shape, double aspect_ratio, CellSums& sums) {
    sums.volume += shape.volume;
    sums.smallest_cell = std::min(sums.smallest_cell, shape.volume);
    sums.largest_aspect_ratio = std::max(sums.largest_aspect_ratio, aspect_ratio);
}

void add_cell(const VolumeMesh& mesh, const Tetrahedron& tet, CellSums& sums, CellShape& shape) {
    const Vec3 &a = mesh.points[tet[0]], &b = mesh.points[tet[1]], &c = mesh.points[tet[2]],
               &d = mesh.points[tet[3]];
    shape = {cell_centre(mesh, tet), (b - a).cross(c - a).dot(d - a) / 6.0};
    sums.edges += (a - b).norm() + (a - c).norm() + (a - d).norm() + (b - c).norm() +
                  (b - d).norm() + (c - d).norm();
    add_dihedrals(dihedral_cosines(a, b, c, d), sums);
    add_volume(shape, aspect_ratio(mesh, tet, shape.volume), sums);
}

void add_cell(const VolumeMesh& mesh, const Prism& prism, CellSums& sums, CellShape& shape) {
    constexpr double kEdgesOfTetrahedron = 6.0 / 9.0;  // the mean is over six edges a cell
    shape = prism_shape(mesh.points, prism);
    sums.edges += kEdgesOfTetrahedron * edge_sum(mesh.points, prism);
    sums.smallest_jacobian = std::min(sums.smallest_jacobian, scaled_jacobian(mesh.points, prism));
    add_dihedrals(dihedral_cosines(mesh.points, prism), sums);
    add_volume(shape, aspect_ratio(mesh, prism, shape.volume), sums);
}

std::vector<CellShape> add_cells(const VolumeMesh& mesh, VolumeQuality& quality) {
    const std::size_t tetrahedra = mesh.tetrahedra.size();
    std::vector<CellShape> shapes(mesh.cell_count());
    const auto sums = summed<CellSums>(shapes.size(), [&](CellSums& some, std::size_t i) {
        if (i < tetrahedra)
            add_cell(mesh, mesh.tetrahedra[i], some, shapes[i]);
        else
            add_cell(mesh, mesh.prisms[i - tetrahedra], some, shapes[i]);
    });
    quality.smallest_scaled_jacobian = sums.smallest_jacobian;
    quality.volume = sums.volume;
    quality.smallest_cell = shapes.empty() ? 0.0 : sums.smallest_cell;
    quality.smallest_dihedral = sums.smallest_dihedral;
    quality.largest_dihedral = sums.largest_dihedral;
    quality.cells_below_10_deg = sums.below_10_deg;
    quality.largest_aspect_ratio = sums.largest_aspect_ratio;
    const auto count = static_cast<double>(std::max<std::size_t>(1, shapes.size()));
    quality.mean_edge = sums.edges / (6.0 * count);
    quality.mean_smallest_dihedral = sums.smallest_dihedrals / count;
    return shapes;
}

// Distance between the face's centre and the point where the line between the cell centres meets
// the face, relative to the face's extent in that direction (primitiveMeshTools::faceSkewness).
double skewness(const VolumeMesh& mesh, const MeshFace& face, const Vec3& normal, const Vec3& from,
                const Vec3& to) {
    const auto& p = mesh.points;
    const Vec3 centre = face_centre(p, face.corners);
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
    const Vec3 centre = face_centre(p, face.corners);
    const Vec3 drop = normal.dot(centre - owner) / normal.squaredNorm() * normal;
    const Vec3 offset = centre - owner - drop;
    const double length = offset.norm();
    double extent = 0.4 * drop.norm();
    for (const VertexId v : face.corners)
        extent = std::max(extent, std::abs(offset.dot(p[v] - centre)) / (length + 1e-300));
    return length / (extent + 1e-300);
}

void add_face(const VolumeMesh& mesh, const MeshFace& face, const std::vector<CellShape>& shapes,
              FaceSums& sums) {
    const Vec3 normal = face_normal(mesh.points, face.corners);
    const CellShape& owner = shapes[face.owner];
    if (face.neighbour == MeshFace::kOutside) {
        sums.largest_skewness =
            std::max(sums.largest_skewness, boundary_skewness(mesh, face, normal, owner.centre));
        return;
    }
    const CellShape& neighbour = shapes[face.neighbour];
    const Vec3 line = neighbour.centre - owner.centre;
    const double cosine = non_orthogonality_cosine(line, normal);
    const double angle = degrees_of(cosine);
    const double ratio = std::max(owner.volume, neighbour.volume) /
                         std::max(1e-300, std::min(owner.volume, neighbour.volume));
    ++sums.inner;
    sums.cosines += cosine;
    sums.ratios += ratio;
    sums.over_70_deg += angle > 70.0 ? 1 : 0;
    sums.largest_angle = std::max(sums.largest_angle, angle);
    sums.largest_ratio = std::max(sums.largest_ratio, ratio);
    sums.largest_skewness = std::max(sums.largest_skewness,
                                     skewness(mesh, face, normal, owner.centre, neighbour.centre));
}

void add_faces(const VolumeMesh& mesh, std::span<const MeshFace> faces,
               const std::vector<CellShape>& shapes, VolumeQuality& quality) {
    const auto sums = summed<FaceSums>(faces.size(), [&](FaceSums& some, std::size_t i) {
        add_face(mesh, faces[i], shapes, some);
    });
    quality.faces = faces.size();
    quality.inner_faces = sums.inner;
    quality.faces_over_70_deg = sums.over_70_deg;
    quality.largest_non_orthogonality = sums.largest_angle;
    quality.largest_volume_ratio = sums.largest_ratio;
    quality.largest_skewness = sums.largest_skewness;
    const auto inner = static_cast<double>(std::max<std::size_t>(1, quality.inner_faces));
    // As in checkMesh: the angle of the mean cosine.
    quality.mean_non_orthogonality = degrees_of(sums.cosines / inner);
    quality.mean_volume_ratio = sums.ratios / inner;
}

}  // namespace

double largest_non_orthogonality(const VolumeMesh& mesh, std::span<const MeshFace> faces) {
    double largest = 0.0;
    for (const MeshFace& face : faces) {
        if (face.neighbour == MeshFace::kOutside) continue;
        const Vec3 line = cell_centre(mesh, face.neighbour) - cell_centre(mesh, face.owner);
        const Vec3 normal = face_normal(mesh.points, face.corners);
        largest = std::max(largest, degrees_of(non_orthogonality_cosine(line, normal)));
    }
    return largest;
}

std::array<double, 6> dihedral_angles(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    std::array<double, 6> angles = dihedral_cosines(a, b, c, d);
    for (double& angle : angles) angle = degrees_of(angle);
    return angles;
}

CellNeighbours cell_neighbours(const VolumeMesh& mesh, const Progress& cancel) {
    const SideBuckets buckets = side_buckets(mesh, cancel);
    CellNeighbours neighbours(mesh.cell_count(),
                              {kOutside, kOutside, kOutside, kOutside, kOutside});
    tbb::parallel_for(std::size_t{0}, mesh.points.size(), [&](std::size_t v) {
        cancel.check_cancelled();
        for (std::uint32_t i = buckets.offsets[v]; i < buckets.offsets[v + 1]; ++i)
            for (std::uint32_t j = i + 1; j < buckets.offsets[v + 1]; ++j) {
                const Side &a = buckets.sides[i], &b = buckets.sides[j];
                if (a.middle != b.middle || a.high != b.high) continue;
                std::uint32_t& behind_a = neighbours[a.cell_face / 8][a.cell_face % 8];
                std::uint32_t& behind_b = neighbours[b.cell_face / 8][b.cell_face % 8];
                if (behind_a != kOutside || behind_b != kOutside)
                    throw InvalidInput("volume mesh: a face belongs to three cells");
                behind_a = b.cell_face / 8;
                behind_b = a.cell_face / 8;
            }
    });
    return neighbours;
}

std::vector<MeshFace> mesh_faces(const VolumeMesh& mesh) {
    return mesh_faces(mesh, cell_neighbours(mesh));
}

std::vector<MeshFace> mesh_faces(const VolumeMesh& mesh, const CellNeighbours& neighbours) {
    std::vector<std::size_t> first(neighbours.size() + 1, 0);  // each cell's inner faces
    for_each_vertex(neighbours.size(), [&](std::size_t cell) {
        for (const std::uint32_t other : neighbours[cell])
            first[cell + 1] += other != kOutside && cell < other ? 1 : 0;
    });
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<MeshFace> faces(first.back());
    for_each_vertex(neighbours.size(), [&](std::size_t cell) {
        MeshFace* const begin = faces.data() + first[cell];
        MeshFace* end = begin;
        for_each_face(mesh, cell, [&](std::size_t k, const FaceCorners& corners) {
            if (const std::uint32_t other = neighbours[cell][k]; other != kOutside && cell < other)
                *end++ = {.corners = corners,
                          .owner = static_cast<std::uint32_t>(cell),
                          .neighbour = other};
        });
        std::sort(begin, end,
                  [](const auto& l, const auto& r) { return l.neighbour < r.neighbour; });
    });
    const std::vector<MeshFace> outer = outer_faces(mesh, neighbours);
    faces.insert(faces.end(), outer.begin(), outer.end());
    return faces;
}

VolumeQuality volume_quality(const VolumeMesh& mesh) {
    return volume_quality(mesh, mesh_faces(mesh));
}

VolumeQuality volume_quality(const VolumeMesh& mesh, std::span<const MeshFace> faces) {
    VolumeQuality quality;
    quality.points = mesh.points.size();
    quality.cells = mesh.cell_count();
    quality.prisms = mesh.prisms.size();
    const std::vector<CellShape> shapes = add_cells(mesh, quality);
    add_faces(mesh, faces, shapes, quality);
    return quality;
}

double scaled_jacobian(const Positions& points, const Prism& prism) {
    constexpr double kEquilateral = 1.1547005383792515;  // 2 / sqrt 3, over the sine of 60 degrees
    double smallest = 1.0;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 up = points[prism[k]] - points[prism[k + 3]];
        for (const std::size_t base : {std::size_t{0}, std::size_t{3}}) {
            const Vec3& corner = points[prism[base + k]];
            const Vec3 next = points[prism[base + (k + 1) % 3]] - corner,
                       previous = points[prism[base + (k + 2) % 3]] - corner;
            const double lengths = next.norm() * previous.norm() * up.norm();
            smallest = std::min(
                smallest, kEquilateral * next.cross(previous).dot(up) / std::max(lengths, 1e-300));
        }
    }
    return smallest;
}

std::vector<double> smallest_dihedral_angles(const VolumeMesh& mesh, const Progress& progress) {
    constexpr std::size_t kBetweenChecks = 1 << 14;
    std::vector<double> values(mesh.cell_count());
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (i % kBetweenChecks == 0) progress.check_cancelled();
        if (i >= mesh.tetrahedra.size()) {
            const Prism& prism = mesh.prisms[i - mesh.tetrahedra.size()];
            values[i] = degrees_of(std::ranges::max(dihedral_cosines(mesh.points, prism)));
            continue;
        }
        const Tetrahedron& t = mesh.tetrahedra[i];
        values[i] = std::ranges::min(dihedral_angles(mesh.points[t[0]], mesh.points[t[1]],
                                                     mesh.points[t[2]], mesh.points[t[3]]));
    }
    return values;
}

}  // namespace vesselbench
