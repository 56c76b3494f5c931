#include "geometry/vessel/centerlines/wall_section.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "geometry/kernel/cross_section.h"
#include "geometry/kernel/robust.h"

namespace vesselbench {
namespace {

constexpr std::size_t kSectors = 24;
constexpr double kReach = 2.2;      ///< samples farther away than this many radii are ignored
constexpr double kSlab = 0.45;      ///< half thickness of the slab in radii, widened if needed;
                                    ///< samples have less weight towards its faces
constexpr double kSameWall = 1.35;  ///< samples of a sector up to this many times as far as its
                                    ///< nearest one belong to the same wall
constexpr double kNoWall = 1.3;     ///< without a wall, one is assumed at this many radii

using Vec2 = Eigen::Vector2d;

struct Sector {
    double nearest = std::numeric_limits<double>::infinity();
    double area = 0.0;
    double radius = 0.0;
};

struct PlaneSample {
    double distance = 0.0;
    double area = 0.0;
    std::size_t sector = 0;
};

std::size_t sector_of(const Vec2& offset) {
    const double turn = std::atan2(offset.y(), offset.x()) / (2.0 * std::numbers::pi) + 0.5;
    return std::min(kSectors - 1, static_cast<std::size_t>(turn * kSectors));
}

Vec2 sector_direction(std::size_t sector) {
    const double angle =
        2.0 * std::numbers::pi * ((static_cast<double>(sector) + 0.5) / kSectors - 0.5);
    return {std::cos(angle), std::sin(angle)};
}

/// Sectors without samples between sectors with samples: a coarse mesh, not an opening.
void bridge_gaps(std::array<Sector, kSectors>& sectors) {
    constexpr std::size_t kWidest = 2;
    const auto given = sectors;
    for (std::size_t k = 0; k < kSectors; ++k) {
        if (given[k].area <= 0.0) continue;
        std::size_t gap = 0;
        while (gap <= kWidest && given[(k + gap + 1) % kSectors].area <= 0.0) ++gap;
        if (gap == 0 || gap > kWidest) continue;
        const Sector& next = given[(k + gap + 1) % kSectors];
        for (std::size_t g = 1; g <= gap; ++g) {
            const double f = static_cast<double>(g) / static_cast<double>(gap + 1);
            Sector& between = sectors[(k + g) % kSectors];
            between.radius = (1.0 - f) * given[k].radius + f * next.radius;
            between.area = std::min(given[k].area, next.area);
        }
    }
}

std::array<Sector, kSectors> average(const std::vector<PlaneSample>& samples) {
    std::array<Sector, kSectors> sectors;
    for (const PlaneSample& s : samples) {
        sectors[s.sector].nearest = std::min(sectors[s.sector].nearest, s.distance);
    }
    for (const PlaneSample& s : samples) {
        Sector& sector = sectors[s.sector];
        if (s.distance > kSameWall * sector.nearest) continue;
        sector.area += s.area;
        sector.radius += s.area * s.distance;
    }
    for (Sector& s : sectors) {
        if (s.area <= 0.0) continue;
        s.radius /= s.area;
    }
    bridge_gaps(sectors);
    return sectors;
}

/// The centre of the largest circle between contour points, by ascent on the soft minimum
/// -tau log sum exp(-d / tau) of their distances.
Vec2 circle_centre(const std::array<Vec2, kSectors>& contour, double tau, double most) {
    constexpr int kSteps = 30;
    Vec2 centre = Vec2::Zero();
    for (int step = 0; step < kSteps; ++step) {
        std::array<double, kSectors> d{};
        for (std::size_t k = 0; k < kSectors; ++k) d[k] = (contour[k] - centre).norm();
        const double least = *std::min_element(d.begin(), d.end());
        Vec2 away = Vec2::Zero();
        double sum = 0.0;
        for (std::size_t k = 0; k < kSectors; ++k) {
            const double weight = std::exp(-(d[k] - least) / tau);
            away -= weight * (contour[k] - centre) / std::max(d[k], 1e-12);
            sum += weight;
        }
        centre += tau / sum * away;
        if (centre.norm() > most) return most * centre.normalized();
    }
    return centre;
}

/// Least distance from the centre to the wall points, each averaged with its neighbours.
double circle_radius(const std::array<Sector, kSectors>& sectors, const Vec2& centre) {
    constexpr std::array<double, 5> kWeights = {1.0, 2.0, 3.0, 2.0, 1.0};
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < kSectors; ++k) {
        if (sectors[k].area <= 0.0) continue;
        double sum = 0.0;
        double weights = 0.0;
        for (std::size_t n = 0; n < kWeights.size(); ++n) {
            const std::size_t at = (k + n + kSectors - 2) % kSectors;
            const Sector& s = sectors[at];
            if (s.area <= 0.0) continue;
            sum += kWeights[n] * (s.radius * sector_direction(at) - centre).norm();
            weights += kWeights[n];
        }
        least = std::min(least, sum / weights);
    }
    return least;
}

}  // namespace

WallSections::WallSections(const VesselWall& wall, double finest)
    : distance_(wall.wall.size() == wall.closed.size() ? *wall.distance
                                                       : distance_to(wall.points, wall.wall)),
      closed_(*wall.distance) {
    std::vector<Sample> between;
    samples_.resize(wall.points.size());
    for (const Triangle& t : wall.wall) {
        const Vec3 &a = wall.points[t[0]], &b = wall.points[t[1]], &c = wall.points[t[2]];
        const Vec3 area = 0.5 * (b - a).cross(c - a);
        const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
        const int n = std::clamp(static_cast<int>(std::ceil(longest / finest)), 1, 12);
        const double share = area.norm() / (n == 1 ? 3.0 : 0.5 * (n + 1) * (n + 2));
        for (int i = 0; i <= n; ++i) {
            for (int j = 0; i + j <= n; ++j) {
                const bool corner = i == n || j == n || i + j == 0;
                if (corner) continue;
                const double fa = static_cast<double>(n - i - j) / n;
                between.push_back(
                    {fa * a + static_cast<double>(i) / n * b + static_cast<double>(j) / n * c, area,
                     share});
            }
        }
        for (const VertexId v : t) {
            samples_[v].point = wall.points[v];
            samples_[v].normal += area;
            samples_[v].area += share;
        }
    }
    std::erase_if(samples_, [](const Sample& s) { return s.area <= 0.0; });
    samples_.insert(samples_.end(), between.begin(), between.end());
    std::vector<BoxTree::Box> boxes;
    for (Sample& s : samples_) {
        s.normal.normalize();
        boxes.emplace_back(s.point);
    }
    tree_ = BoxTree(boxes);
}

WallSection WallSections::at(const LinePlace& place, double softness) const {
    WallSection section{place.point, 0.0, 0.0};
    const auto axes = plane_axes(place.tangent);
    const Vec3 &u = axes.first, &v = axes.second;
    const double reach = kReach * place.radius;
    std::vector<PlaneSample> inside;
    for (double slab = kSlab; slab < 1.5; slab *= 1.5) {
        inside.clear();
        const double half = slab * place.radius;
        const auto touches = [&](const BoxTree::Box& box) {
            if (box.squaredExteriorDistance(place.point) > reach * reach) return false;
            const double middle = place.tangent.dot(box.center() - place.point);
            const double extent = 0.5 * place.tangent.cwiseAbs().dot(box.sizes());
            return std::abs(middle) <= half + extent;
        };
        const auto take = [&](const Sample& s) {
            const Vec3 d = s.point - place.point;
            const double along = d.dot(place.tangent);
            if (std::abs(along) >= half || d.squaredNorm() > reach * reach) return;
            const Vec3 from_line = d - 0.5 * along * along * place.curvature;
            const Vec2 offset(from_line.dot(u), from_line.dot(v));
            const double distance = offset.norm();
            if (distance < 1e-3 * place.radius) return;
            const Vec3 direction = (offset.x() * u + offset.y() * v) / distance;
            if (s.normal.dot(direction) < 0.2) return;  // a wall seen from outside, or a closure
            inside.push_back({distance, biweight(along, half) * s.area, sector_of(offset)});
        };
        tree_.traverse(touches, [&](std::uint32_t i) { take(samples_[i]); });
        if (inside.size() >= 4 * kSectors) break;
    }
    const auto sectors = average(inside);
    std::array<Vec2, kSectors> contour;
    std::size_t filled = 0;
    for (std::size_t k = 0; k < kSectors; ++k) {
        const bool wall = sectors[k].area > 0.0;
        filled += wall ? 1 : 0;
        contour[k] = (wall ? sectors[k].radius : kNoWall * place.radius) * sector_direction(k);
    }
    section.covered = static_cast<double>(filled) / kSectors;
    if (filled == 0) return section;
    const Vec2 centre = circle_centre(contour, softness * place.radius, 0.3 * place.radius);
    section.centre = place.point + centre.x() * u + centre.y() * v;
    section.radius = circle_radius(sectors, centre);
    return section;
}

double WallSections::free_way(const Vec3& from, const Vec3& direction) const {
    const auto hit = closed_.first_hit(from, direction);
    return hit ? hit->distance : std::numeric_limits<double>::infinity();
}

}  // namespace vesselbench
