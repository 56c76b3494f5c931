#include "geometry/vessel/centerlines/flat_closures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <tuple>
#include <utility>

#include "geometry/kernel/surface_distance.h"
#include "geometry/kernel/triangle_neighbours.h"
#include "geometry/vessel/centerlines/terraces.h"

namespace vesselbench {
namespace {

constexpr double kPlane = 0.9994;    ///< cosine of 2 degrees: normals of one plane
constexpr double kUneven = 0.866;    ///< cosine of 30 degrees: normals of an uneven disc
constexpr double kFlatRim = 0.0524;  ///< tangent of 3 degrees: height over radius of a flat rim
/// Tangent of half a degree: a rim that a plane has cut. Around it, the wall of a flaring mouth may
/// turn by no more than around a disc in one plane.
constexpr double kCutRim = 0.0087;
constexpr double kFlatDisc = 0.1405;  ///< tangent of 8 degrees: the same inside an uneven disc
constexpr int kGrowths = 6;           ///< rounds after which a disc has found its size
constexpr double kRim = 0.77;         ///< cosine of 40 degrees: the wall turns away by more
/// Cosine of 25 degrees: the same for a disc in one plane. At an oblique cap of a bent or narrowing
/// vessel a seventh of the rim turns by less than 40. So it does at a knob of a few triangles.
constexpr double kPlanarRim = 0.906;
constexpr std::size_t kOnKnob = 10;  ///< triangles; fewer are a cap only if the wall turns by kRim
constexpr double kSharpRim = 0.9;    ///< fraction of the rim that must be sharp
/// A disc between creases may bulge or be dented by this much [radii]: smoothing and sloppy capping
/// push the middle of a cap off the plane of its rim. A dome without a crease rises by 1.
constexpr double kDeepestDent = 0.5;
/// Cosines of the angles that make a crease of the surface, tried one after the other: the sharper
/// one is not misled by coarse triangles, the blunter one is closed around an oblique cap.
constexpr std::array<double, 2> kCreases = {0.77, 0.906};
/// Edges of the rim of such a disc; fewer are a rounded end of a coarse surface.
constexpr std::size_t kFewestCreases = 10;
constexpr double kRoundness = 0.6;    ///< 4 pi area / perimeter^2 of a disc; an ellipse of 1 : 2.4
constexpr double kWidestLumen = 1.4;  ///< distance to the wall two radii behind it, in radii
/// Fraction of the area; with more, the surface is not a vessel: a short bifurcation has 0.35.
constexpr double kMostFlat = 0.45;

/// Area of the smallest disc over the surface's.
constexpr double kLeastShare = 1e-5;

/// Area of a mouth over that of the smallest closure: only coarse walls have smaller flat places.
constexpr double kLeastMouth = 0.5;

/// Finds planar regions and classifies them.
class Search {
public:
    Search(const Positions& points, std::span<const Triangle> triangles)
        : points_(points),
          triangles_(triangles),
          near_(edge_neighbours(triangles)),
          visited_(triangles.size(), 0) {
        for (const Triangle& t : triangles) {
            const Vec3 a = 0.5 * (points[t[1]] - points[t[0]]).cross(points[t[2]] - points[t[0]]);
            areas_.push_back(a.norm());
            normals_.push_back(a.norm() > 0.0 ? Vec3(a.normalized()) : Vec3(Vec3::Zero()));
        }
    }

    /// The planar region around a triangle; its triangles are marked as used.
    std::vector<TriangleId> grow(TriangleId seed, std::vector<bool>& taken) const {
        std::vector<TriangleId> region{seed};
        taken[seed] = true;
        for (std::size_t i = 0; i < region.size(); ++i) {
            for (const TriangleId t : near_[region[i]]) {
                if (t == kNoTriangle || taken[t]) continue;
                if (areas_[t] > 0.0 && normals_[t].dot(normals_[seed]) < kPlane) continue;
                taken[t] = true;
                region.push_back(t);
            }
        }
        std::sort(region.begin(), region.end());
        return region;
    }

    /// The region grown over what lies in the same plane as a whole: a disc may be uneven, such as
    /// one filled with a fan of long triangles.
    std::vector<TriangleId> settled(std::vector<TriangleId> region) {
        for (int round = 0; round < kGrowths; ++round) {
            const Disc disc = disc_of(region);
            std::vector<TriangleId> grown = within(disc, region);
            const bool same = grown.size() == region.size();
            region = std::move(grown);
            if (same) break;
        }
        return region;
    }

    /// \param turn cosine of the angle by which the wall turns away at the rim
    bool closes_vessel(const std::vector<TriangleId>& region, double turn,
                       const SurfaceDistance& surface) {
        return is_disc(region, turn) && lumen_behind(region, surface) < kWidestLumen;
    }

    /// True if it is round and bounded by a sharp rim.
    bool is_disc(const std::vector<TriangleId>& region, double turn) {
        const auto [centre, normal, area] = disc_of(region);
        mark(region);
        double rim = 0.0;
        double sharp = 0.0;
        for (const TriangleId t : region) {
            for (std::size_t k = 0; k < 3; ++k) {
                const TriangleId other = near_[t][k];
                if (other != kNoTriangle && visited_[other] == visit_) continue;
                const double length =
                    (points_[triangles_[t][(k + 1) % 3]] - points_[triangles_[t][k]]).norm();
                rim += length;
                if (other != kNoTriangle && normals_[other].dot(normal) < turn) sharp += length;
            }
        }
        return sharp >= kSharpRim * rim && 4.0 * std::numbers::pi * area >= kRoundness * rim * rim;
    }

    /// Distance to the wall two radii behind a disc, in radii; infinite if one radius behind it is
    /// not inside.
    double lumen_behind(const std::vector<TriangleId>& region,
                        const SurfaceDistance& surface) const {
        const auto [centre, normal, area] = disc_of(region);
        const double radius = std::sqrt(area / std::numbers::pi);
        if (!surface.inside(centre - radius * normal))
            return std::numeric_limits<double>::infinity();
        return surface.closest_point(centre - 2.0 * radius * normal).distance / radius;
    }

    /// True if the rim lies in its plane.
    /// \param most height over radius
    bool has_flat_rim(const std::vector<TriangleId>& region, double most) const {
        const Heights rim = rim_heights(region);
        return rim.high - rim.low <=
               2.0 * most * std::sqrt(disc_of(region).area / std::numbers::pi);
    }

    /// The parts of the surface that edges with a turn outward of a crease bound.
    /// \param turn cosine of the angle of a crease
    std::vector<std::vector<TriangleId>> parts_between_creases(double turn) const {
        std::vector<std::vector<TriangleId>> parts;
        std::vector<bool> taken(triangles_.size(), false);
        for (TriangleId seed = 0; seed < triangles_.size(); ++seed) {
            if (taken[seed]) continue;
            std::vector<TriangleId> part{seed};
            taken[seed] = true;
            for (std::size_t i = 0; i < part.size(); ++i)
                for (const TriangleId t : near_[part[i]])
                    if (t != kNoTriangle && !taken[t] && !is_crease(part[i], t, turn)) {
                        taken[t] = true;
                        part.push_back(t);
                    }
            std::ranges::sort(part);
            parts.push_back(std::move(part));
        }
        return parts;
    }

    /// True if a part between creases is a disc of which only the rim is flat.
    bool is_dented_disc(const std::vector<TriangleId>& part) {
        if (part.size() < kOnKnob) return false;
        const bool sharp = is_disc(part, kRim) && has_flat_rim(part, kFlatRim);
        if (!sharp && !(is_disc(part, kPlanarRim) && has_flat_rim(part, kCutRim))) return false;
        const auto [centre, normal, area] = disc_of(part);
        const double planar = enclosed_area(part), radius = std::sqrt(planar / std::numbers::pi);
        const Heights rim = rim_heights(part);
        if (rim.edges < kFewestCreases) return false;
        for (const TriangleId t : part)
            for (const VertexId v : triangles_[t]) {
                const double height = (points_[v] - centre).dot(normal);
                if (std::max(rim.low - height, height - rim.high) > kDeepestDent * radius)
                    return false;
            }
        return true;
    }

    /// The area inside the rim, whatever the triangles between do.
    double enclosed_area(const std::vector<TriangleId>& region) const {
        Vec3 sum = Vec3::Zero();
        for (const TriangleId t : region) sum += areas_[t] * normals_[t];
        return sum.norm();
    }

    Vec3 normal(const std::vector<TriangleId>& region) const { return disc_of(region).normal; }

    double area(const std::vector<TriangleId>& region) const {
        double sum = 0.0;
        for (const TriangleId t : region) sum += areas_[t];
        return sum;
    }

    double whole_area() const {
        double sum = 0.0;
        for (const double a : areas_) sum += a;
        return sum;
    }

private:
    struct Disc {
        Vec3 centre, normal;
        double area = 0.0;
    };

    /// Of a rim, over the disc's middle in the direction of its normal [mm].
    struct Heights {
        double low = 0.0, high = 0.0;
        std::size_t edges = 0;
    };

    Heights rim_heights(const std::vector<TriangleId>& region) const {
        const Disc disc = disc_of(region);
        Heights heights{std::numeric_limits<double>::infinity(),
                        -std::numeric_limits<double>::infinity()};
        for (const TriangleId t : region)
            for (std::size_t k = 0; k < 3; ++k)
                if (!std::ranges::binary_search(region, near_[t][k]))
                    for (const VertexId v : {triangles_[t][k], triangles_[t][(k + 1) % 3]}) {
                        heights.edges += v == triangles_[t][k] ? 1 : 0;
                        const double height = (points_[v] - disc.centre).dot(disc.normal);
                        heights.low = std::min(heights.low, height);
                        heights.high = std::max(heights.high, height);
                    }
        return heights;
    }

    /// True if the surface turns outward, away from both triangles, by more than a crease.
    bool is_crease(TriangleId a, TriangleId b, double turn) const {
        if (!(areas_[a] > 0.0 && areas_[b] > 0.0) || normals_[a].dot(normals_[b]) >= turn)
            return false;
        return (middle(b) - middle(a)).dot(normals_[a]) < 0.0;
    }

    Vec3 middle(TriangleId t) const {
        return (points_[triangles_[t][0]] + points_[triangles_[t][1]] + points_[triangles_[t][2]]) /
               3.0;
    }

    Disc disc_of(const std::vector<TriangleId>& region) const {
        Disc disc{Vec3::Zero(), Vec3::Zero()};
        for (const TriangleId t : region) {
            disc.area += areas_[t];
            disc.normal += areas_[t] * normals_[t];
            for (const VertexId v : triangles_[t]) disc.centre += areas_[t] / 3.0 * points_[v];
        }
        disc.centre /= disc.area;
        disc.normal.normalize();
        return disc;
    }

    /// Makes a region what was visited last.
    void mark(const std::vector<TriangleId>& region) {
        ++visit_;
        for (const TriangleId t : region) visited_[t] = visit_;
    }

    /// What is connected with a region in a disc's plane.
    std::vector<TriangleId> within(const Disc& disc, std::vector<TriangleId> region) {
        const double height = kFlatDisc * std::sqrt(disc.area / std::numbers::pi);
        const auto lies_in = [&](TriangleId t) {
            if (areas_[t] > 0.0 && normals_[t].dot(disc.normal) < kUneven) return false;
            return std::ranges::all_of(triangles_[t], [&](VertexId v) {
                return std::abs((points_[v] - disc.centre).dot(disc.normal)) <= height;
            });
        };
        mark(region);
        for (std::size_t i = 0; i < region.size(); ++i)
            for (const TriangleId t : near_[region[i]])
                if (t != kNoTriangle && visited_[t] != visit_ && lies_in(t)) {
                    visited_[t] = visit_;
                    region.push_back(t);
                }
        std::ranges::sort(region);
        return region;
    }

    const Positions& points_;
    std::span<const Triangle> triangles_;
    std::vector<std::array<TriangleId, 3>> near_;
    std::vector<double> areas_;
    Positions normals_;
    std::vector<std::uint32_t> visited_;  ///< number of the last visit
    std::uint32_t visit_ = 0;
};

/// Adds closures and mouths that are not flat, but whose sharp rims are. A dome's rim is none: the
/// wall turns inward at the neck of an aneurysm.
/// \param found by triangle: in a closure; on return also in one of those added
void add_dented_discs(Search& search, const SurfaceDistance& surface, FlatDiscs& discs,
                      std::vector<bool>& found) {
    std::vector<bool> taken = found;
    for (const auto& mouth : discs.mouths)
        for (const TriangleId t : mouth) taken[t] = true;
    const double least = kLeastShare * search.whole_area();
    for (const double turn : kCreases)
        for (auto& part : search.parts_between_creases(turn)) {
            if (search.enclosed_area(part) < least || !search.is_dented_disc(part)) continue;
            const double lumen = search.lumen_behind(part, surface);
            const bool closes = lumen < kWidestLumen;
            const std::vector<bool>& others = closes ? found : taken;
            if (!std::isfinite(lumen) ||
                std::ranges::any_of(part, [&](TriangleId t) { return others[t]; }))
                continue;
            for (const TriangleId t : part) taken[t] = true;
            if (closes)
                for (const TriangleId t : part) found[t] = true;
            (closes ? discs.closures : discs.mouths).push_back(std::move(part));
        }
}

/// Drops the mouths that became part of a closure or are much smaller than all of them.
void keep_mouths(const Search& search, FlatDiscs& discs, const std::vector<bool>& in_closure) {
    double least = std::numeric_limits<double>::infinity();
    for (const auto& disc : discs.closures) least = std::min(least, search.area(disc));
    std::erase_if(discs.mouths, [&](const auto& mouth) {
        return search.area(mouth) < kLeastMouth * least ||
               std::ranges::any_of(mouth, [&](TriangleId t) { return in_closure[t]; });
    });
}

/// The triangles that are in none of the discs.
std::vector<Triangle> wall_beside(std::span<const Triangle> triangles, const FlatDiscs& discs) {
    std::vector<bool> flat(triangles.size(), false);
    for (const auto* list : {&discs.closures, &discs.mouths})
        for (const auto& disc : *list)
            for (const TriangleId t : disc) flat[t] = true;
    std::vector<Triangle> wall;
    for (TriangleId t = 0; t < triangles.size(); ++t)
        if (!flat[t]) wall.push_back(triangles[t]);
    return wall;
}

/// Steps of a staircase are neither closures nor mouths, and where one closure is a step, the
/// others look like steps.
void drop_terraces(const Search& search, const Positions& points,
                   std::span<const Triangle> triangles, FlatDiscs& discs) {
    const std::vector<Triangle> wall = wall_beside(triangles, discs);
    const auto is_step = [&](const auto& disc) {
        return is_terrace(points, wall, search.normal(disc));
    };
    if (std::ranges::any_of(discs.closures, is_step)) discs = {};
    std::erase_if(discs.mouths, is_step);
}

}  // namespace

FlatDiscs find_flat_closures(const Positions& points, std::span<const Triangle> triangles,
                             const SurfaceDistance& surface) {
    Search search(points, triangles);
    const double whole = search.whole_area();
    std::vector<bool> taken(triangles.size(), false);
    std::vector<bool> found(triangles.size(), false);  ///< in a disc
    // Area of the largest planar region that was grown over a triangle without success: on a large
    // smooth wall, thousands of smaller ones would grow over the same patches.
    std::vector<double> tried(triangles.size(), 0.0);
    FlatDiscs discs;
    for (TriangleId t = 0; t < triangles.size(); ++t) {
        if (taken[t]) continue;
        auto region = search.grow(t, taken);
        const double planar = search.area(region);
        // A disc has at least as many triangles as a hexagon, and is not tiny.
        if (region.size() < 4 || planar < kLeastShare * whole) continue;
        const double turn = region.size() < kOnKnob ? kRim : kPlanarRim;
        if (!search.closes_vessel(region, turn, surface)) {
            if (search.is_disc(region, turn) && std::isfinite(search.lumen_behind(region, surface)))
                discs.mouths.push_back(region);
            if (tried[t] >= planar) continue;
            region = search.settled(std::move(region));
            const bool known = std::ranges::any_of(region, [&](TriangleId r) { return found[r]; });
            if (known || !search.closes_vessel(region, kRim, surface) ||
                !search.has_flat_rim(region, kFlatRim)) {
                for (const TriangleId r : region) tried[r] = std::max(tried[r], planar);
                continue;
            }
        }
        for (const TriangleId r : region) taken[r] = found[r] = true;
        discs.closures.push_back(std::move(region));
    }
    add_dented_discs(search, surface, discs, found);
    double flat = 0.0;
    for (const auto& disc : discs.closures) flat += search.area(disc);
    if (flat > kMostFlat * whole || discs.closures.empty()) return {};
    keep_mouths(search, discs, found);
    drop_terraces(search, points, triangles, discs);
    return discs;
}

}  // namespace vesselbench
