#include "smoothing/context/stack_orientation.h"

#include <algorithm>
#include <cmath>

#include "geometry/kernel/argument_checks.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/parallel.h"
#include "smoothing/context/cut_ends.h"
#include "smoothing/context/gauss_map.h"
#include "smoothing/context/normal_peaks.h"

namespace vesselbench {

namespace {

constexpr double kCertain = 2.0 / 3.0;    // confidence above which the axis is certain
constexpr double kFewestFaces = 20.0;     // for a peak to be certain
constexpr double kSmallestShare = 0.003;  // of all faces, likewise
constexpr double kOtherPeak = 0.9945;  // cosine of 6 degrees: closer ones belong to the same peak
constexpr double kOffAxis = 0.9998;    // cosine of 1 degree: a peak farther from the voxels' axes

/// \param counts 0 where a face is ignored; empty: all count
FaceNormals face_normals(const Topology& topology, const Positions& positions,
                         const std::vector<std::uint8_t>& counts) {
    const auto triangles = topology.triangles();
    std::vector<Vec3> scaled(triangles.size());
    for_each_vertex(triangles.size(),
                    [&](std::size_t t) { scaled[t] = area_normal(positions, triangles[t]); });
    FaceNormals faces;
    for (std::size_t t = 0; t < scaled.size(); ++t) {
        const double length = scaled[t].norm();
        if (!(length > 0.0) || !std::isfinite(length) || (!counts.empty() && !counts[t])) continue;
        faces.normals.emplace_back(scaled[t] / length);
        faces.areas.push_back(0.5 * length);
    }
    return faces;
}

double flat_share(const FaceNormals& faces, const Vec3& axis, double theta_limit) {
    const auto flat = std::count_if(faces.normals.begin(), faces.normals.end(), [&](const Vec3& n) {
        return 1.0 - std::abs(n.dot(axis)) < theta_limit;  // Eq. 5.3
    });
    return static_cast<double>(flat) / static_cast<double>(faces.normals.size());
}

/// Bins denser than midway between mean and maximum, connected within the radius; the centre of
/// each cluster.
std::vector<Vec3> cluster_centres(const FaceNormals& faces, double radius) {
    const GaussMap map(faces.normals, radius);
    const std::vector<std::uint64_t> density = map.densities();
    double sum = 0.0;
    for (std::size_t b = 0; b < map.size(); ++b)
        sum += static_cast<double>(map.count(b)) * static_cast<double>(density[b]);
    const double highest = static_cast<double>(*std::max_element(density.begin(), density.end()));
    const double threshold = 0.5 * (sum / static_cast<double>(faces.normals.size()) + highest);
    std::vector<float> side(map.size(), 0.0F);  // relative to the cluster's first bin; 0: none
    std::vector<Vec3> centres;
    for (std::size_t first = 0; first < map.size(); ++first) {
        if (side[first] != 0.0F || static_cast<double>(density[first]) < threshold) continue;
        std::vector<std::size_t> members{first};
        side[first] = 1.0F;
        Vec3 centre = Vec3::Zero();
        for (std::size_t m = 0; m < members.size(); ++m) {
            const std::size_t b = members[m];
            centre += static_cast<double>(side[b]) * map.count(b) * map.direction(b);
            map.visit_within(map.direction(b), [&](std::size_t other, float sign) {
                if (side[other] != 0.0F || static_cast<double>(density[other]) < threshold) return;
                side[other] = sign * side[b];
                members.push_back(other);
            });
        }
        // A belt around the sphere has no centre; its first bin represents it.
        const bool belt = centre.norm() < 1e-6 * static_cast<double>(faces.normals.size());
        centres.push_back(belt ? map.direction(first) : Vec3(centre.normalized()));
    }
    return centres;
}

/// The thesis's choice: the cluster with the most flat faces around its centre.
Vec3 flattest_cluster(const FaceNormals& faces, const StackOrientationParameters& parameters) {
    Vec3 best = Vec3::UnitZ();
    double most = -1.0;
    for (const Vec3& centre : cluster_centres(faces, parameters.radius)) {
        const double share = flat_share(faces, centre, parameters.theta_limit);
        if (share <= most) continue;
        most = share;
        best = centre;
    }
    return best;
}

/// How distinct a peak is: in number and share of its faces, and relative to the next one. 2/3 if
/// it has just enough faces, or three times as many as the next.
double peak_confidence(const std::vector<NormalPeak>& peaks, std::size_t faces) {
    const double excess = peaks.front().excess;
    if (!(excess > 0.0)) return 0.0;
    const double enough = std::max(kFewestFaces, kSmallestShare * static_cast<double>(faces));
    const auto rival = std::find_if(peaks.begin(), peaks.end(), [&](const NormalPeak& peak) {
        return std::abs(peak.axis.dot(peaks.front().axis)) < kOtherPeak;
    });
    const double next = rival != peaks.end() ? rival->excess : 0.0;
    return std::min(excess / (excess + 0.5 * enough), 1.0 - next / excess);
}

/// 2/3 if the longest voxel edge is just enough longer than the next.
double grid_confidence(const VoxelGrid& grid) {
    const int k = grid.longest();
    const double second = std::max(grid.spacing[(k + 1) % 3], grid.spacing[(k + 2) % 3]);
    constexpr double kLongestSecond = 1.0 / VoxelGrid::kCubic;
    return std::clamp(kCertain * (1.0 - second / grid.spacing[k]) / (1.0 - kLongestSecond), 0.0,
                      1.0);
}

/// Peaks of cubic voxels count only along their axes.
bool is_along_axis(const VoxelGrid& grid, const Vec3& direction) {
    return (grid.axes.transpose() * direction).cwiseAbs().maxCoeff() > kOffAxis;
}

/// The voxels of an interpolated surface; of a mask whose lattice shows too few faces, too.
std::optional<VoxelGrid> grid_of(const Topology& topology, const Positions& positions) {
    auto grid = interpolated_grid(topology, positions);
    // A mask's vertices halfway between voxels lie in planes of their own.
    if (grid && is_of_mask(topology, positions, *grid)) grid->spacing *= 2.0;
    return grid;
}

/// Takes the direction across parallel ends if the voxels allow it and nothing more certain speaks
/// against it.
void consider_ends(std::span<const CutEnd> ends, StackOrientation& found) {
    const auto axis = axis_of_ends(ends);
    if (!axis || (found.grid && !is_along_axis(*found.grid, axis->direction))) return;
    const bool other = std::abs(axis->direction.dot(found.direction)) < kOtherPeak;
    if (found.confidence < kCertain) {
        if (axis->confidence <= found.confidence) return;
        found.direction = axis->direction;
        found.confidence = axis->confidence;
    } else if (other && axis->confidence >= kCertain) {
        found.confidence = 1.0 - axis->confidence;  // two directions, each of which seems certain
    }
}

StackOrientation estimate(const Topology& topology, const Positions& positions,
                          const FaceNormals& faces, std::span<const CutEnd> ends,
                          const StackOrientationParameters& parameters) {
    StackOrientation found;
    if (faces.normals.empty()) return found;
    const std::vector<NormalPeak> peaks = highest_peaks(faces);
    const auto lattice = voxel_lattice(faces, peaks);
    found.grid = lattice ? lattice->grid : grid_of(topology, positions);
    if (found.grid) {
        found.direction = found.grid->axes.col(found.grid->longest());
        found.confidence = grid_confidence(*found.grid);
    }
    if (!lattice && found.confidence < kCertain) {
        found.direction = peaks.front().axis;
        const bool possible = !found.grid || is_along_axis(*found.grid, found.direction);
        found.confidence = possible ? peak_confidence(peaks, faces.normals.size()) : 0.0;
    }
    // Voxels that are longest across the slices need no further evidence.
    if (found.confidence < kCertain || !found.grid || found.grid->is_cubic())
        consider_ends(ends, found);
    found.certain = found.confidence >= kCertain;
    if (!found.certain)
        found.direction = peak_near(faces, flattest_cluster(faces, parameters)).axis;
    found.direction = folded_axis(found.direction);
    found.flat_share = flat_share(faces, found.direction, parameters.theta_limit);
    return found;
}

void require_usable(const StackOrientationParameters& parameters) {
    require_range("radius", parameters.radius, 0.02, 0.5);
    require_positive("theta_limit", parameters.theta_limit);
    require_range("theta_limit", parameters.theta_limit, 0.0, 1.0);
}

}  // namespace

StackOrientation estimate_stack_orientation(const Topology& topology, const Positions& positions,
                                            const StackOrientationParameters& parameters) {
    require_usable(parameters);
    return estimate(topology, positions, face_normals(topology, positions, {}), {}, parameters);
}

StackOrientation estimate_stack_orientation(const Surface& surface,
                                            const StackOrientationParameters& parameters) {
    require_usable(parameters);
    if (surface.empty()) return {};
    std::vector<std::uint8_t> wall(surface.triangle_count());
    for (TriangleId t = 0; t < wall.size(); ++t)
        wall[t] = surface.patch_of(t).kind == PatchKind::Wall ? 1 : 0;
    return estimate(*surface.topology, surface.points(),
                    face_normals(*surface.topology, surface.points(), wall), cut_ends(surface),
                    parameters);
}

StackOrientation estimate_stack_orientation(const Surface& surface, std::span<const Cap> caps,
                                            const StackOrientationParameters& parameters) {
    require_usable(parameters);
    if (surface.empty()) return {};
    std::vector<std::uint8_t> wall(surface.triangle_count(), 1);
    for (const Cap& cap : caps)
        for (const TriangleId t : cap.triangles) wall[t] = 0;
    return estimate(*surface.topology, surface.points(),
                    face_normals(*surface.topology, surface.points(), wall),
                    cut_ends(surface, caps), parameters);
}

}  // namespace vesselbench
