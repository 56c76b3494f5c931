#include "geometry/vessel/ends/flat_faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include <Eigen/Dense>

#include "geometry/kernel/cross_section.h"
#include "geometry/kernel/surface_distance.h"
#include "geometry/kernel/triangle_neighbours.h"

namespace vesselbench {

namespace {

/// Cosines: directions of one face, and of those triangles of it from which no other face starts.
constexpr double kOneFace = 0.94;   // 20 degrees
constexpr double kMiddle = 0.9945;  // 6 degrees
/// A face is a filled ellipse of at most this length over width, seen along its normal.
constexpr double kLongest = 2.0;
constexpr double kFilled = 0.75;
/// Smaller ones are triangles of a coarse wall [mean edges].
constexpr double kSmallest = 2.0;
/// The vessel is measured so far behind the face, and its longer half is so wide there [radii of
/// the face]: the median may be smaller where the vessel leaves obliquely.
constexpr double kBehind = 0.75;
constexpr double kNarrowest = 0.8, kWidest = 1.8;
constexpr int kRays = 16;
/// The vessel stays as wide within these factors, looked at in steps of so many radii.
constexpr double kNarrower = 0.7, kWider = 1.35;
constexpr double kStep = 0.25;
constexpr double kFarthest = 8.0;
constexpr double kLeastLength = 1.0;

/// Around a face that closes a vessel the wall falls off as deep as the vessel is measured, and
/// leans outward by less than 45 degrees on the way, in so many of the sectors in which there are
/// triangles to tell: in the others a branch leaves, or the vessel turns. Around a flat place of a
/// dome it falls off nowhere, and beside one in the side of a vessel not along it [-].
constexpr std::size_t kSectors = 24;
constexpr double kFalling = 0.8;
/// It does not rise over the face, as daughters beside the wall of a furcation do [radii of the
/// face], but in a branch narrower than this [radii of the vessel].
constexpr double kRise = 0.5;
constexpr double kThinBranch = 0.5;
constexpr double kJustInside = 1e-3;  // mean edges

constexpr int kRounds = 3;

/// A triangle is no seed if the regions around it that are no faces have so many triangles
/// together: the rim of a large flat place would grow the same region once a triangle. Regions of a
/// few thousand triangles are grown from each seed.
constexpr std::uint32_t kMostGrown = 1U << 22U;

/// A set of triangles that is emptied at once.
class TriangleSet {
public:
    explicit TriangleSet(std::size_t triangles) : marks_(triangles, 0) {}

    void clear() { ++mark_; }

    void assign(const std::vector<TriangleId>& triangles) {
        clear();
        for (const TriangleId t : triangles) insert(t);
    }

    [[nodiscard]] bool contains(TriangleId t) const {
        return t != kNoTriangle && marks_[t] == mark_;
    }

    /// \return true if it was not in the set
    bool insert(TriangleId t) { return std::exchange(marks_[t], mark_) != mark_; }

    void erase(TriangleId t) { marks_[t] = 0; }

private:
    std::vector<std::uint32_t> marks_;
    std::uint32_t mark_ = 1;
};

class FaceSearch {
public:
    explicit FaceSearch(const Surface& surface)
        : surface_(surface),
          distance_(distance_to(surface)),
          grown_(surface.triangle_count(), 0),
          seen_(surface.triangle_count()),
          in_(surface.triangle_count()),
          outside_(surface.triangle_count()) {
        double edges = 0.0;
        normals_.reserve(surface.triangle_count());
        sizes_.reserve(surface.triangle_count());
        for (TriangleId t = 0; t < surface.triangle_count(); ++t) {
            normals_.push_back(area_normal(surface.points(), surface.triangles()[t]));
            sizes_.push_back(normals_.back().norm());
            wall_.push_back(surface.patch_of(t).kind == PatchKind::Wall && sizes_.back() > 0.0);
            edges += std::sqrt(sizes_.back());
        }
        neighbours_ = edge_neighbours(surface.triangles());
        edge_ = edges / static_cast<double>(std::max<std::size_t>(1, normals_.size()));
    }

    [[nodiscard]] std::vector<FlatFace> run(const Progress& progress) {
        LoopProgress seeds(progress, surface_.triangle_count(), "looking for flat faces");
        std::vector<FlatFace> faces;
        for (TriangleId t = 0; t < surface_.triangle_count(); ++t) {
            seeds.step();
            if (!is_seed(t)) continue;
            grown_[t] = kMostGrown;
            progress.check_cancelled();
            const Vec3 first = mean_normal(grown(t, normals_[t].normalized()));
            const std::vector<TriangleId> region = grown(t, first);
            const Vec3 normal = mean_normal(region);
            const auto face = face_of(region, normal);
            const auto size = static_cast<std::uint32_t>(region.size());
            for (const TriangleId r : region)
                if (face || normals_[r].dot(normal) > kMiddle * sizes_[r])
                    grown_[r] = kMostGrown;
                else if (grown_[r] < kMostGrown)
                    grown_[r] += std::min(size, kMostGrown);
            if (face && !is_known(*face, faces)) faces.push_back(*face);
        }
        return faces;
    }

private:
    [[nodiscard]] bool is_seed(TriangleId t) const { return wall_[t] && grown_[t] < kMostGrown; }

    [[nodiscard]] std::vector<TriangleId> grown(TriangleId seed, const Vec3& normal) {
        seen_.clear();
        seen_.insert(seed);
        std::vector<TriangleId> region{seed};
        for (std::size_t i = 0; i < region.size(); ++i)
            for (const TriangleId next : neighbours_[region[i]])
                if (next != kNoTriangle && wall_[next] &&
                    normals_[next].dot(normal) >= kOneFace * sizes_[next] && seen_.insert(next))
                    region.push_back(next);
        return region;
    }

    /// Neighbours in in_.
    [[nodiscard]] std::ptrdiff_t inside_beside(TriangleId t) const {
        return std::ranges::count_if(neighbours_[t],
                                     [&](TriangleId next) { return in_.contains(next); });
    }

    /// Without the fringes and notches of a region's border; ascending.
    [[nodiscard]] std::vector<TriangleId> even(std::vector<TriangleId> region) {
        in_.assign(region);
        for (int round = 0; round < kRounds; ++round) {
            std::vector<TriangleId> added, removed;
            for (const TriangleId t : region) {
                if (inside_beside(t) < 2) removed.push_back(t);
                for (const TriangleId next : neighbours_[t])
                    if (next != kNoTriangle && wall_[next] && !in_.contains(next) &&
                        inside_beside(next) >= 2)
                        added.push_back(next);
            }
            for (const TriangleId t : removed) in_.erase(t);
            std::erase_if(region, [&](TriangleId t) { return !in_.contains(t); });
            for (const TriangleId t : added)
                if (in_.insert(t)) region.push_back(t);
        }
        std::ranges::sort(region);
        return region;
    }

    /// What is connected beside a region, in_; empty if it is larger than the region, and then part
    /// of outside_.
    [[nodiscard]] std::vector<TriangleId> hole_at(TriangleId beside, std::size_t most) {
        std::vector<TriangleId> part{beside};
        seen_.clear();
        seen_.insert(beside);
        bool open = false;
        for (std::size_t i = 0; i < part.size() && part.size() <= most && !open; ++i)
            for (const TriangleId next : neighbours_[part[i]])
                if (next != kNoTriangle && !in_.contains(next) && seen_.insert(next)) {
                    open = open || outside_.contains(next);
                    part.push_back(next);
                }
        if (!open && part.size() <= most) return part;
        for (const TriangleId t : part) outside_.insert(t);
        return {};
    }

    /// With the holes in a region that are smaller than it; ascending. in_ has the same.
    [[nodiscard]] std::vector<TriangleId> filled(std::vector<TriangleId> region) {
        in_.assign(region);
        outside_.clear();
        const std::size_t count = region.size();
        for (std::size_t i = 0; i < count; ++i)
            for (const TriangleId beside : neighbours_[region[i]]) {
                if (beside == kNoTriangle || in_.contains(beside) || outside_.contains(beside))
                    continue;
                for (const TriangleId t : hole_at(beside, count)) {
                    in_.insert(t);
                    region.push_back(t);
                }
            }
        std::ranges::sort(region);
        return region;
    }

    /// Filled, and where its border touches itself at a vertex, with the triangles around it.
    [[nodiscard]] std::vector<TriangleId> one_disc(std::vector<TriangleId> region) {
        for (int round = 0; round < kRounds; ++round) {
            region = filled(std::move(region));
            std::map<VertexId, int> border;  // ends of border edges
            for (const TriangleId t : region)
                for (std::size_t k = 0; k < 3; ++k)
                    if (!in_.contains(neighbours_[t][k]))
                        for (const std::size_t end : {k, (k + 1) % 3})
                            ++border[surface_.triangles()[t][end]];
            const std::size_t before = region.size();
            for (const auto& [vertex, ends] : border)
                if (ends > 2)
                    for (const TriangleId t : surface_.topology->triangles_at().row(vertex))
                        if (in_.insert(t)) region.push_back(t);
            if (region.size() == before) break;
            std::ranges::sort(region);
        }
        return region;
    }

    [[nodiscard]] Vec3 mean_normal(const std::vector<TriangleId>& region) const {
        Vec3 sum = Vec3::Zero();
        for (const TriangleId t : region) sum += normals_[t];
        return sum.normalized();
    }

    [[nodiscard]] std::optional<FlatFace> face_of(const std::vector<TriangleId>& region,
                                                  const Vec3& normal) {
        double area = 0.0;
        Vec3 centre = Vec3::Zero();
        for (const TriangleId t : region) {
            const double size = 0.5 * normals_[t].dot(normal);
            area += size;
            centre += size * middle(t);
        }
        centre /= area;
        const double radius = std::sqrt(area / std::numbers::pi);
        if (radius < kSmallest * edge_ || !is_disc(region, normal, centre, area))
            return std::nullopt;
        const Lumen behind = lumen_at(centre - kBehind * radius * normal, normal);
        const double lumen = behind.radius;
        if (!(lumen > 0.0) || behind.quartile < kNarrowest * radius ||
            behind.quartile > kWidest * radius)
            return std::nullopt;
        FlatFace face{.centre = centre,
                      .normal = normal,
                      .radius = lumen,
                      .triangles = one_disc(even(region))};
        face.length = length_behind(face);
        if (face.length <= kLeastLength * lumen || !is_plug(face, radius)) return std::nullopt;
        return face;
    }

    static bool is_known(const FlatFace& face, const std::vector<FlatFace>& faces) {
        return std::ranges::any_of(faces, [&](const FlatFace& other) {
            return (face.centre - other.centre).norm() < other.radius &&
                   face.normal.dot(other.normal) > kOneFace;
        });
    }

    /// How far the vessel goes on behind a face about as wide [mm]. Sections parallel to the face,
    /// each around the middle of the last one: those of an oblique vessel are alike.
    [[nodiscard]] double length_behind(const FlatFace& face) const {
        const double step = kStep * face.radius;
        double depth = kBehind * face.radius;
        Vec3 point = face.centre - depth * face.normal;
        const Lumen first = lumen_at(point, face.normal);
        for (; depth < kFarthest * face.radius; depth += step) {
            const Lumen lumen = lumen_at(point, face.normal);
            if (lumen.radius < kNarrower * first.radius || lumen.radius > kWider * first.radius ||
                lumen.quartile > kWider * first.quartile)
                break;
            point = lumen.middle - step * face.normal;
        }
        return depth;
    }

    /// Directions around a face, by sector.
    struct Around {
        Vec3 centre, normal, u, v;

        [[nodiscard]] double height(const Vec3& p) const { return (p - centre).dot(normal); }

        [[nodiscard]] double side(const Vec3& p) const {
            return (p - centre - height(p) * normal).norm();
        }

        [[nodiscard]] std::size_t sector(const Vec3& p) const {
            const double turn = std::atan2((p - centre).dot(v), (p - centre).dot(u));
            const double share = 0.5 + 0.5 * turn / std::numbers::pi;
            return std::min(kSectors - 1, static_cast<std::size_t>(share * kSectors));
        }
    };

    /// How far the wall around a face may lie to the side, by sector [mm].
    [[nodiscard]] std::array<double, kSectors> reaches(const FlatFace& face, const Around& around,
                                                       double radius) const {
        std::array<double, kSectors> reach{};
        reach.fill((1.0 + kBehind) * radius);
        for (const TriangleId t : face.triangles)
            for (const VertexId v : surface_.triangles()[t]) {
                const Vec3& p = surface_.points()[v];
                double& most = reach[around.sector(p)];
                most = std::max(most, around.side(p) + kBehind * radius);
            }
        return reach;
    }

    /// True if the vessel ends at the face. \param radius of the face [mm]
    [[nodiscard]] bool is_plug(const FlatFace& face, double radius) {
        const auto [u, v] = plane_axes(face.normal);
        const Around around{face.centre, face.normal, u, v};
        const std::array<double, kSectors> reach = reaches(face, around, radius);
        std::array<bool, kSectors> falls{}, leaves{};
        std::vector<TriangleId> part = face.triangles;
        in_.assign(part);
        for (std::size_t i = 0; i < part.size(); ++i) {
            const Vec3 at = middle(part[i]);
            const std::size_t sector = around.sector(at);
            if (around.side(at) > reach[sector]) {
                leaves[sector] = leaves[sector] || around.height(at) > -kBehind * radius;
                continue;
            }
            if (around.height(at) <= -kBehind * radius) {
                falls[sector] = true;
                continue;
            }
            if (around.height(at) > kRise * radius) {
                if (lumen_behind(part[i]) > kThinBranch * face.radius) return false;
                continue;
            }
            for (const TriangleId next : neighbours_[part[i]])
                if (next != kNoTriangle && in_.insert(next)) part.push_back(next);
        }
        double fallen = 0.0, known = 0.0;
        for (std::size_t k = 0; k < kSectors; ++k) {
            fallen += falls[k] ? 1.0 : 0.0;
            known += falls[k] || leaves[k] ? 1.0 : 0.0;
        }
        return fallen > 0.0 && fallen >= kFalling * known;
    }

    /// Width of the vessel behind a triangle [mm].
    [[nodiscard]] double lumen_behind(TriangleId t) const {
        const Vec3 inward = -normals_[t].stableNormalized();
        const auto hit = distance_.first_hit(middle(t) + kJustInside * edge_ * inward, inward);
        return hit ? hit->distance : 0.0;
    }

    [[nodiscard]] Vec3 middle(TriangleId t) const {
        const auto& [a, b, c] = surface_.triangles()[t];
        return (surface_.points()[a] + surface_.points()[b] + surface_.points()[c]) / 3.0;
    }

    /// By its second moments.
    [[nodiscard]] bool is_disc(const std::vector<TriangleId>& region, const Vec3& normal,
                               const Vec3& centre, double area) const {
        const auto [u, v] = plane_axes(normal);
        Eigen::Matrix2d moments = Eigen::Matrix2d::Zero();
        for (const TriangleId t : region) {
            const Vec3 p = middle(t) - centre;
            const Eigen::Vector2d q(p.dot(u), p.dot(v));
            moments += 0.5 * normals_[t].dot(normal) / area * q * q.transpose();
        }
        const Eigen::Vector2d spread =
            Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(moments).eigenvalues();
        if (!(spread[0] > 0.0) || spread[1] > kLongest * kLongest * spread[0]) return false;
        return area > kFilled * 4.0 * std::numbers::pi * std::sqrt(spread[0] * spread[1]);
    }

    /// The vessel's section around a point.
    struct Lumen {
        double radius = 0.0;  ///< median over directions [mm]; 0: the point is outside
        double quartile =
            0.0;  ///< a quarter of the directions is longer, as along a flat side [mm]
        Vec3 middle = Vec3::Zero();
    };

    [[nodiscard]] Lumen lumen_at(const Vec3& point, const Vec3& across) const {
        if (!distance_.inside(point)) return {};
        const auto [u, v] = plane_axes(across);
        std::array<double, kRays> lengths{};
        Vec3 moment = Vec3::Zero();
        double weight = 0.0;
        for (int k = 0; k < kRays; ++k) {
            const double angle = 2.0 * std::numbers::pi * k / kRays;
            const Vec3 way = std::cos(angle) * u + std::sin(angle) * v;
            const auto hit = distance_.first_hit(point, way);
            const double length = hit ? hit->distance : 0.0;
            lengths[static_cast<std::size_t>(k)] = length;
            weight += length * length;
            moment += length * length * length * way;
        }
        std::ranges::sort(lengths);
        if (!(weight > 0.0)) return {};
        return {lengths[kRays / 2], lengths[3 * kRays / 4], point + 2.0 / 3.0 * moment / weight};
    }

    const Surface& surface_;
    SurfaceDistance distance_;
    std::vector<Vec3> normals_;  ///< twice the area [mm^2]
    std::vector<double> sizes_;  ///< of the normals
    std::vector<std::uint8_t> wall_;
    std::vector<std::array<TriangleId, 3>> neighbours_;
    std::vector<std::uint32_t> grown_;  ///< triangles of regions around it that are no faces
    TriangleSet seen_, in_, outside_;   ///< of one search at a time
    double edge_ = 0.0;                 ///< [mm]
};

}  // namespace

std::vector<FlatFace> find_flat_faces(const Surface& surface, const Progress& progress) {
    return FaceSearch(surface).run(progress);
}

}  // namespace vesselbench
