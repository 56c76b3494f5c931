#include "meshing/remeshing/error_bound.h"

#include <algorithm>
#include <limits>

#include "geometry/kernel/measure.h"
#include "geometry/kernel/surface_samples.h"
#include "meshing/remeshing/vertex_fields.h"

namespace vesselbench {

namespace {

/// Longest edge, in sample spacings, from which a triangle counts as large.
constexpr double kLarge = 3.0;

}  // namespace

ErrorBound::ErrorBound(const Surface& source, std::span<const double> weights, double max_error)
    : points_(source.points()),
      triangles_(source.triangles().begin(), source.triangles().end()),
      weights_(weights.begin(), weights.end()),
      max_error_(max_error),
      spacing_(0.5 * mean_edge_length(source)),
      search_(distance_to(source)),
      samples_of_(source.triangle_count()) {
    weights_.resize(points_.size(), 1.0);
    std::vector<std::uint8_t> seen(points_.size(), 0);
    const std::vector<std::uint8_t>& on_boundary = source.topology->boundary_vertices();
    for (TriangleId t = 0; t < triangles_.size(); ++t) {
        for (int i = 0; i < 3; ++i) {
            const VertexId a = triangles_[t][i], b = triangles_[t][(i + 1) % 3];
            if (seen[a] == 0) add_sample(points_[a], weights_[a], t);
            seen[a] = 1;
            if (a < b || (on_boundary[a] != 0 && on_boundary[b] != 0))  // belongs to the other side
                add_sample(0.5 * (points_[a] + points_[b]), 0.5 * (weights_[a] + weights_[b]), t);
        }
        add_inner_samples(t);
    }
}

/// The centroid, or the centres of equal parts of a triangle if it is larger than most.
void ErrorBound::add_inner_samples(TriangleId t) {
    const auto [a, b, c] = triangles_[t];
    const double longest = longest_edge(points_, triangles_[t]);
    const int parts = longest > kLarge * spacing_ ? sample_parts(longest, spacing_) : 1;
    for_each_part(parts, [&](double u, double v) {
        const double rest = 1.0 - u - v;
        add_sample(rest * points_[a] + u * points_[b] + v * points_[c],
                   rest * weights_[a] + u * weights_[b] + v * weights_[c], t);
    });
}

void ErrorBound::add_sample(const Vec3& place, double weight, TriangleId triangle) {
    samples_of_[triangle].push_back(static_cast<std::uint32_t>(samples_.size()));
    samples_.push_back({place, weight * max_error_});
}

double ErrorBound::allowed_at(const SurfacePoint& at) const {
    const Triangle& triangle = triangles_[at.triangle];
    const Vec3 shares = barycentric(points_, triangle, at.point);
    double weight = 0.0;
    for (int i = 0; i < 3; ++i) weight += shares[i] * weights_[triangle[i]];
    return weight * max_error_;
}

bool ErrorBound::is_near_source(const Fresh& triangle) const {
    const auto& [t, a, b, c] = triangle;
    const int n = std::max(sample_parts(longest_edge(a, b, c), spacing_), 2);
    for (int i = 0; i <= n; ++i)
        for (int j = 0; i + j <= n; ++j) {
            const Vec3 place =
                a + (static_cast<double>(i) / n) * (b - a) + (static_cast<double>(j) / n) * (c - a);
            const auto found = search_.closest_point(place, max_error_);
            if (!found || found->distance > allowed_at(*found)) return false;
        }
    return true;
}

bool ErrorBound::allows(std::span<const TriangleId> gone, std::span<const Fresh> fresh) {
    moves_.clear();
    for (const TriangleId t : gone)
        for (const std::uint32_t s : samples_of_[t]) {
            double least = std::numeric_limits<double>::infinity();
            std::uint32_t nearest = 0;
            for (std::uint32_t i = 0; i < fresh.size(); ++i) {
                const auto& [triangle, a, b, c] = fresh[i];
                const Vec3& p = samples_[s].place;
                const double distance = (closest_point_on_triangle(p, a, b, c) - p).norm();
                if (distance >= least) continue;
                least = distance;
                nearest = i;
            }
            if (least > samples_[s].allowed) return false;
            moves_.emplace_back(s, nearest);
        }
    return std::ranges::all_of(fresh, [&](const Fresh& f) { return is_near_source(f); });
}

void ErrorBound::accept(std::span<const TriangleId> gone, std::span<const Fresh> fresh) {
    for (const TriangleId t : gone) samples_of_[t].clear();
    for (const auto& [sample, place] : moves_) samples_of_[fresh[place].triangle].push_back(sample);
}

}  // namespace vesselbench
