#include "smoothing/context/normal_peaks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "geometry/kernel/statistics.h"
#include "smoothing/context/gauss_map.h"

namespace vesselbench {

namespace {

constexpr double kFineRadius = 0.02;  // of the density that reveals sharp peaks [-]
constexpr std::size_t kPeaks = 32;    // a mask's surface has 13 normals, and some rare ones
constexpr double kApart = 2.5;        // of two peaks [deg]; 1:12 voxels have some 5 apart
constexpr double kPeakWidth = 1.0;    // [deg]
constexpr double kRingFrom = 2.0;     // [deg]
constexpr double kRingTo = 6.0;       // [deg]
constexpr double kMedianWidth = 2.0;  // of the normals entering the median [deg]
constexpr double kRightAngle =
    1.0;  // deviation allowed between two lattice axes and 90 degrees [deg]
constexpr double kFitsLattice =
    2.0;  // deviation of a face's normal from one of the lattice's [deg]
constexpr double kShareOnLattice = 0.95;  // of the faces, at least; surfaces of masks have 0.99
constexpr double kFewestFlatFaces = 8.0;  // along each lattice axis
constexpr double kShareOblique = 0.01;  // of the faces, oblique to the long edge; prisms have none

double radians(double degrees) {
    return degrees * std::numbers::pi / 180.0;
}

double cosine(double degrees) {
    return std::cos(radians(degrees));
}

/// Geometric median on the sphere by Weiszfeld's iteration; it stays on a plateau's own direction,
/// where a mean would be drawn to the side with more surface around it.
Vec3 median_axis(const std::vector<Vec3>& near, Vec3 axis) {
    constexpr int kIterations = 40;
    constexpr double kSmallest = 1e-6;  // [rad]; closer normals get equal weights
    const double limit = 2.0 * std::sin(0.5 * radians(kMedianWidth));
    for (int i = 0; i < kIterations; ++i) {
        Vec3 sum = Vec3::Zero();
        for (const Vec3& n : near) {
            const double distance = (n - axis).norm();
            if (distance <= limit) sum += n / std::max(distance, kSmallest);
        }
        if (sum.isZero()) break;
        const Vec3 next = sum.normalized();
        const bool done = (next - axis).norm() < 0.01 * kSmallest;
        axis = next;
        if (done) break;
    }
    return axis;
}

struct Neighbourhood {
    std::vector<Vec3> normals;  ///< turned to the same side
    std::vector<double> areas;
};

Neighbourhood neighbourhood(const FaceNormals& faces, const Vec3& axis) {
    const double limit = cosine(kRingTo + kMedianWidth);
    Neighbourhood near;
    for (std::size_t f = 0; f < faces.normals.size(); ++f) {
        const double dot = faces.normals[f].dot(axis);
        if (std::abs(dot) < limit) continue;
        near.normals.push_back(dot < 0.0 ? Vec3(-faces.normals[f]) : faces.normals[f]);
        near.areas.push_back(faces.areas[f]);
    }
    return near;
}

double share_along(const FaceNormals& faces, const std::vector<Vec3>& directions, double degrees) {
    const double limit = cosine(degrees);
    std::size_t fitting = 0;
    for (const Vec3& n : faces.normals)
        fitting += std::any_of(directions.begin(), directions.end(),
                               [&](const Vec3& d) { return std::abs(n.dot(d)) >= limit; });
    return static_cast<double>(fitting) / static_cast<double>(faces.normals.size());
}

/// Empty if no face is oblique to the long edge, as on prisms with few sides.
std::optional<VoxelLattice> lattice_of(const FaceNormals& faces,
                                       const std::array<const NormalPeak*, 3>& peaks) {
    // Flat faces have half the product of the other two edges: an edge is proportional to 1 / area.
    const Vec3 areas(peaks[0]->area, peaks[1]->area, peaks[2]->area);
    VoxelGrid grid{.spacing = std::sqrt(2.0 * areas.prod()) * areas.cwiseInverse()};
    for (int k = 0; k < 3; ++k) grid.axes.col(k) = peaks[static_cast<std::size_t>(k)]->axis;
    const Vec3 long_axis = grid.axes.col(grid.longest());
    const std::vector<Vec3> normals = mask_directions(grid);
    std::vector<Vec3> oblique;
    for (const Vec3& n : normals) {
        const double along =
            std::abs(n.dot(long_axis));  // at most 0.71, except for the axis itself
        if (along > std::sin(radians(kRightAngle)) && along < 0.9) oblique.push_back(n);
    }
    if (share_along(faces, oblique, 0.5 * kFitsLattice) < kShareOblique) return {};
    return VoxelLattice{grid, share_along(faces, normals, kFitsLattice)};
}

bool orthogonal(const NormalPeak& a, const NormalPeak& b) {
    return std::abs(a.axis.dot(b.axis)) <= std::sin(radians(kRightAngle));
}

}  // namespace

NormalPeak peak_near(const FaceNormals& faces, const Vec3& start) {
    const Neighbourhood near = neighbourhood(faces, start);
    NormalPeak peak;
    peak.axis = median_axis(near.normals, start);
    double ring = 0.0;
    std::vector<double> areas;
    for (std::size_t i = 0; i < near.normals.size(); ++i) {
        const double dot = near.normals[i].dot(peak.axis);
        if (dot >= cosine(kPeakWidth)) areas.push_back(near.areas[i]);
        if (dot < cosine(kRingFrom) && dot >= cosine(kRingTo)) ring += 1.0;
    }
    peak.faces = static_cast<double>(areas.size());
    // A tube's normals lie on a circle: their number is proportional to the angle. Other shapes
    // have fewer.
    peak.excess = std::max(0.0, peak.faces - ring * kPeakWidth / (kRingTo - kRingFrom));
    peak.area = median(std::move(areas));
    peak.axis = folded_axis(peak.axis);
    return peak;
}

std::vector<NormalPeak> highest_peaks(const FaceNormals& faces) {
    const GaussMap map(faces.normals, kFineRadius);
    const std::vector<std::uint64_t> density = map.densities();
    std::vector<std::size_t> order(map.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return density[a] > density[b]; });
    const auto apart = [](const auto& taken, const Vec3& axis) {
        return std::all_of(taken.begin(), taken.end(), [&](const Vec3& other) {
            return std::abs(other.dot(axis)) < cosine(kApart);
        });
    };
    std::vector<Vec3> starts;
    for (const std::size_t bin : order) {
        if (starts.size() == kPeaks) break;
        if (apart(starts, map.direction(bin))) starts.push_back(map.direction(bin));
    }
    std::vector<NormalPeak> refined(starts.size());
    tbb::parallel_for(std::size_t{0}, starts.size(),
                      [&](std::size_t i) { refined[i] = peak_near(faces, starts[i]); });
    std::vector<NormalPeak> peaks;
    std::vector<Vec3> taken;
    for (const NormalPeak& peak : refined) {
        if (!apart(taken, peak.axis)) continue;
        taken.push_back(peak.axis);
        peaks.push_back(peak);
    }
    std::stable_sort(peaks.begin(), peaks.end(),
                     [](const NormalPeak& a, const NormalPeak& b) { return a.excess > b.excess; });
    return peaks;
}

std::optional<VoxelLattice> voxel_lattice(const FaceNormals& faces,
                                          const std::vector<NormalPeak>& peaks) {
    double on_peaks = 0.0;
    for (const NormalPeak& peak : peaks) on_peaks += peak.faces;
    if (on_peaks < kShareOnLattice * static_cast<double>(faces.normals.size())) return {};
    std::vector<const NormalPeak*> flat;
    for (const NormalPeak& peak : peaks)
        if (peak.faces >= kFewestFlatFaces && peak.area > 0.0) flat.push_back(&peak);
    std::optional<VoxelLattice> best;
    for (std::size_t a = 0; a < flat.size(); ++a)
        for (std::size_t b = a + 1; b < flat.size(); ++b) {
            if (!orthogonal(*flat[a], *flat[b])) continue;
            for (std::size_t c = b + 1; c < flat.size(); ++c) {
                if (!orthogonal(*flat[a], *flat[c]) || !orthogonal(*flat[b], *flat[c])) continue;
                const auto lattice = lattice_of(faces, {flat[a], flat[b], flat[c]});
                if (lattice && (!best || lattice->share > best->share)) best = lattice;
            }
        }
    return best && best->share >= kShareOnLattice ? best : std::nullopt;
}

}  // namespace vesselbench
