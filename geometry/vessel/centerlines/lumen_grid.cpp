#include "geometry/vessel/centerlines/lumen_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <tbb/parallel_for.h>

#include "geometry/kernel/shortest_paths.h"
#include "geometry/kernel/surface_distance.h"

namespace vesselbench {
namespace {

/// A loop checks for a cancel after so many turns: within milliseconds.
constexpr std::size_t kTurns = 4096;

constexpr int kBorder = 2;  ///< outer voxels around the lumen's box

/// Two voxels that are 26-neighbours are at most sqrt(3) voxels apart; if both are this far from
/// the wall, the segment between them cannot cross two walls.
constexpr double kClearance = 0.87;

/// Scan lines are shifted by these fractions of a voxel, so that they do not pass through the
/// vertices of surfaces that are aligned with a grid themselves.
constexpr double kShift[3] = {0.00137, 0.00213, 0.00171};

struct Crossing {
    std::uint32_t line = 0;
    float at = 0.0F;  ///< along the axis, in voxels
    std::int8_t sign = 0;
};

/// Twice the signed area of a, b, p in the plane; exactly antisymmetric in a and b.
double edge_side(const Positions& points, VertexId a, VertexId b, int u, int v, double pu,
                 double pv) {
    const bool swapped = a > b;
    if (swapped) std::swap(a, b);
    const Vec3& A = points[a];
    const Vec3& B = points[b];
    const double side = (B[u] - A[u]) * (pv - A[v]) - (B[v] - A[v]) * (pu - A[u]);
    return swapped ? -side : side;
}

/// The scan lines along one axis of a grid.
class Scan {
public:
    Scan(const LumenGrid& grid, int axis)
        : grid_(grid), axis_(axis), u_((axis + 1) % 3), v_((axis + 2) % 3) {}

    void cross(const Positions& points, const Triangle& t) {
        double low[2] = {1e300, 1e300};
        double high[2] = {-1e300, -1e300};
        for (const VertexId id : t) {
            const double c[2] = {to_grid(points[id], u_), to_grid(points[id], v_)};
            for (int k = 0; k < 2; ++k) {
                low[k] = std::min(low[k], c[k]);
                high[k] = std::max(high[k], c[k]);
            }
        }
        for (int j = static_cast<int>(std::ceil(low[1])); j <= std::floor(high[1]); ++j) {
            for (int i = static_cast<int>(std::ceil(low[0])); i <= std::floor(high[0]); ++i) {
                cross_line(points, t, i, j);
            }
        }
    }

    /// Adds 1 to the votes of all voxels inside along this axis.
    void vote(InsideRule rule, std::vector<std::uint8_t>& votes) {
        std::sort(crossings_.begin(), crossings_.end(), [](const Crossing& a, const Crossing& b) {
            if (a.line != b.line) return a.line < b.line;
            return a.at != b.at ? a.at < b.at : a.sign < b.sign;
        });
        for (std::size_t k = 0; k < crossings_.size();) {
            std::size_t end = k;
            while (end < crossings_.size() && crossings_[end].line == crossings_[k].line) ++end;
            vote_line(k, end, rule, votes);
            k = end;
        }
    }

private:
    double to_grid(const Vec3& p, int axis) const {
        return (p[axis] - grid_.origin[axis]) / grid_.spacing - kShift[axis];
    }

    double line_position(int axis, int i) const {
        return grid_.origin[axis] + grid_.spacing * (i + kShift[axis]);
    }

    void cross_line(const Positions& points, const Triangle& t, int i, int j) {
        const double pu = line_position(u_, i);
        const double pv = line_position(v_, j);
        const double a = edge_side(points, t[1], t[2], u_, v_, pu, pv);
        const double b = edge_side(points, t[2], t[0], u_, v_, pu, pv);
        const double c = edge_side(points, t[0], t[1], u_, v_, pu, pv);
        const bool positive = a >= 0 && b >= 0 && c >= 0;
        const bool negative = a < 0 && b < 0 && c < 0;
        if (!positive && !negative) return;
        const double sum = a + b + c;
        if (sum == 0.0) return;
        const double w =
            (a * points[t[0]][axis_] + b * points[t[1]][axis_] + c * points[t[2]][axis_]) / sum;
        const double at = (w - grid_.origin[axis_]) / grid_.spacing;
        crossings_.push_back({static_cast<std::uint32_t>(j * grid_.size[u_] + i),
                              static_cast<float>(at), static_cast<std::int8_t>(positive ? 1 : -1)});
    }

    void vote_line(std::size_t begin, std::size_t end, InsideRule rule,
                   std::vector<std::uint8_t>& votes) const {
        int winding = 0;
        int count = 0;
        const int line = static_cast<int>(crossings_[begin].line);
        std::array<int, 3> at{};
        at[u_] = line % grid_.size[u_];
        at[v_] = line / grid_.size[u_];
        for (std::size_t k = begin; k + 1 < end; ++k) {
            winding += crossings_[k].sign;
            ++count;
            const bool inside = rule == InsideRule::Winding ? winding != 0 : count % 2 == 1;
            if (!inside) continue;
            const int first = static_cast<int>(std::ceil(crossings_[k].at));
            for (int w = std::max(first, 0); w < crossings_[k + 1].at && w < grid_.size[axis_];
                 ++w) {
                at[axis_] = w;
                ++votes[grid_.id(at[0], at[1], at[2])];
            }
        }
    }

    const LumenGrid& grid_;
    int axis_, u_, v_;
    std::vector<Crossing> crossings_;
};

/// Voxels along an axis of a grid around so long a box.
double voxels_along(double length, double spacing) {
    return std::ceil(length / spacing) + 2 * kBorder + 1;
}

LumenGrid empty_grid(const Positions& points, std::span<const Triangle> triangles, double spacing) {
    Eigen::AlignedBox3d box;
    for (const Triangle& t : triangles) {
        for (const VertexId v : t) box.extend(points[v]);
    }
    LumenGrid grid;
    grid.spacing = spacing;
    grid.origin = box.min() - Vec3::Constant(kBorder * spacing);
    for (int a = 0; a < 3; ++a) {
        grid.size[a] = static_cast<int>(voxels_along(box.sizes()[a], spacing));
    }
    return grid;
}

/// Removes the voxels that are closer than the clearance to one triangle.
void clear_wall(const Positions& points, const Triangle& t, LumenGrid& grid) {
    const double reach = kClearance * grid.spacing;
    const Vec3 &a = points[t[0]], &b = points[t[1]], &c = points[t[2]];
    const Vec3 low = a.cwiseMin(b).cwiseMin(c) - Vec3::Constant(reach) - grid.origin;
    const Vec3 high = a.cwiseMax(b).cwiseMax(c) + Vec3::Constant(reach) - grid.origin;
    std::array<int, 3> from{};
    std::array<int, 3> to{};
    for (int k = 0; k < 3; ++k) {
        from[k] = std::max(0, static_cast<int>(std::ceil(low[k] / grid.spacing)));
        to[k] = std::min(grid.size[k] - 1, static_cast<int>(std::floor(high[k] / grid.spacing)));
    }
    const Vec3 normal = (b - a).cross(c - a).normalized();
    const bool flat = normal.allFinite();
    for (int k = from[2]; k <= to[2]; ++k) {
        for (int j = from[1]; j <= to[1]; ++j) {
            for (int i = from[0]; i <= to[0]; ++i) {
                const VoxelId v = grid.id(i, j, k);
                if (!grid.lumen[v]) continue;
                const Vec3 p = grid.origin + grid.spacing * Vec3(i, j, k);
                if (flat && std::abs(normal.dot(p - a)) >= reach) continue;
                if ((closest_point_on_triangle(p, a, b, c) - p).squaredNorm() < reach * reach) {
                    grid.lumen[v] = 0;
                }
            }
        }
    }
}

void list_voxels(LumenGrid& grid) {
    grid.voxels.clear();
    for (std::size_t v = 0; v < grid.lumen.size(); ++v) {
        if (grid.lumen[v]) grid.voxels.push_back(static_cast<VoxelId>(v));
    }
}

/// One-dimensional squared distance transform of a line of n values, `step` apart.
void transform_line(float* f, std::size_t n, std::size_t step, std::vector<float>& work,
                    std::vector<int>& parabola, std::vector<float>& border) {
    for (std::size_t q = 0; q < n; ++q) work[q] = f[q * step];
    const float far = std::numeric_limits<float>::infinity();
    int k = 0;
    parabola[0] = 0;
    border[0] = -far;
    border[1] = far;
    for (int q = 1; q < static_cast<int>(n); ++q) {
        float s = 0.0F;
        for (;; --k) {
            const int p = parabola[static_cast<std::size_t>(k)];
            s = (work[static_cast<std::size_t>(q)] - work[static_cast<std::size_t>(p)] +
                 static_cast<float>(q * q - p * p)) /
                static_cast<float>(2 * (q - p));
            if (s > border[static_cast<std::size_t>(k)] || k == 0) break;
        }
        if (s <= border[static_cast<std::size_t>(k)]) s = border[static_cast<std::size_t>(k)];
        ++k;
        parabola[static_cast<std::size_t>(k)] = q;
        border[static_cast<std::size_t>(k)] = s;
        border[static_cast<std::size_t>(k) + 1] = far;
    }
    k = 0;
    for (int q = 0; q < static_cast<int>(n); ++q) {
        while (border[static_cast<std::size_t>(k) + 1] < static_cast<float>(q)) ++k;
        const int p = parabola[static_cast<std::size_t>(k)];
        f[static_cast<std::size_t>(q) * step] =
            static_cast<float>((q - p) * (q - p)) + work[static_cast<std::size_t>(p)];
    }
}

void transform_axis(std::vector<float>& f, const std::array<int, 3>& size, int axis,
                    const Progress& cancel) {
    const std::size_t n[3] = {static_cast<std::size_t>(size[0]), static_cast<std::size_t>(size[1]),
                              static_cast<std::size_t>(size[2])};
    const std::size_t steps[3] = {1, n[0], n[0] * n[1]};
    const int u = axis == 0 ? 1 : 0;
    const int v = axis == 2 ? 1 : 2;
    tbb::parallel_for(std::size_t{0}, n[v], [&](std::size_t j) {
        cancel.check_cancelled();
        std::vector<float> work(n[axis]);
        std::vector<int> parabola(n[axis] + 1);
        std::vector<float> border(n[axis] + 2);
        for (std::size_t i = 0; i < n[u]; ++i) {
            transform_line(f.data() + i * steps[u] + j * steps[v], n[axis], steps[axis], work,
                           parabola, border);
        }
    });
}

}  // namespace

bool LumenGrid::nearest(const Vec3& p, double reach, VoxelId& found) const {
    const Vec3 g = (p - origin) / spacing;
    const double r = reach / spacing;
    double best = r * r;
    bool any = false;
    std::array<int, 3> low{};
    std::array<int, 3> high{};
    for (int a = 0; a < 3; ++a) {
        low[a] = std::max(0, static_cast<int>(std::ceil(g[a] - r)));
        high[a] = std::min(size[a] - 1, static_cast<int>(std::floor(g[a] + r)));
    }
    for (int k = low[2]; k <= high[2]; ++k) {
        for (int j = low[1]; j <= high[1]; ++j) {
            for (int i = low[0]; i <= high[0]; ++i) {
                const double d = (Vec3(i, j, k) - g).squaredNorm();
                if (d >= best || !lumen[id(i, j, k)]) continue;
                best = d;
                found = id(i, j, k);
                any = true;
            }
        }
    }
    return any;
}

std::array<int, 26> LumenGrid::neighbour_offsets() const {
    std::array<int, 26> offsets{};
    std::size_t n = 0;
    for (int k = -1; k <= 1; ++k) {
        for (int j = -1; j <= 1; ++j) {
            for (int i = -1; i <= 1; ++i) {
                if (i != 0 || j != 0 || k != 0) {
                    offsets[n++] = (k * size[1] + j) * size[0] + i;
                }
            }
        }
    }
    return offsets;
}

std::array<float, 26> LumenGrid::neighbour_lengths() const {
    std::array<float, 26> lengths{};
    std::size_t n = 0;
    for (int k = -1; k <= 1; ++k) {
        for (int j = -1; j <= 1; ++j) {
            for (int i = -1; i <= 1; ++i) {
                const int sum = i * i + j * j + k * k;
                if (sum != 0) lengths[n++] = static_cast<float>(spacing * std::sqrt(sum));
            }
        }
    }
    return lengths;
}

double voxel_count(const Eigen::AlignedBox3d& box, double spacing) {
    double count = 1.0;
    for (const double length : box.sizes()) count *= voxels_along(length, spacing);
    return count;
}

LumenGrid voxelise(const Positions& points, std::span<const Triangle> triangles, double spacing,
                   InsideRule rule, const Progress& progress) {
    LumenGrid grid = empty_grid(points, triangles, spacing);
    const std::size_t count = static_cast<std::size_t>(grid.size[0]) *
                              static_cast<std::size_t>(grid.size[1]) *
                              static_cast<std::size_t>(grid.size[2]);
    std::vector<std::uint8_t> votes(count, 0);
    for (int axis = 0; axis < 3; ++axis) {
        progress.check_cancelled();
        Scan scan(grid, axis);
        for (std::size_t t = 0; t < triangles.size(); ++t) {
            if (t % kTurns == 0) progress.check_cancelled();
            scan.cross(points, triangles[t]);
        }
        scan.vote(rule, votes);
    }
    grid.lumen.resize(count);
    for (std::size_t v = 0; v < count; ++v) grid.lumen[v] = votes[v] >= 2 ? 1 : 0;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        if (t % kTurns == 0) progress.check_cancelled();
        clear_wall(points, triangles[t], grid);
    }
    list_voxels(grid);
    return grid;
}

void measure_depth(LumenGrid& grid, const Progress& cancel) {
    constexpr float kFar = 1e12F;
    grid.depth.resize(grid.lumen.size());
    for (std::size_t v = 0; v < grid.lumen.size(); ++v) {
        grid.depth[v] = grid.lumen[v] ? kFar : 0.0F;
    }
    for (int axis = 0; axis < 3; ++axis) transform_axis(grid.depth, grid.size, axis, cancel);
    // The nearest outer voxel is in the clearance band, on average in its middle.
    const auto spacing = static_cast<float>(grid.spacing);
    const auto clearance = static_cast<float>(0.5 * kClearance * grid.spacing);
    for (const VoxelId v : grid.voxels)
        grid.depth[v] = std::sqrt(grid.depth[v]) * spacing + clearance;
}

LumenParts lumen_parts(const LumenGrid& grid, const Progress& cancel) {
    const auto offsets = grid.neighbour_offsets();
    LumenParts parts;
    parts.of_voxel.assign(grid.lumen.size(), LumenParts::kNone);
    for (const VoxelId seed : grid.voxels) {
        if (parts.of_voxel[seed] != LumenParts::kNone) continue;
        const auto name = static_cast<std::uint32_t>(parts.members.size());
        std::vector<VoxelId> part = {seed};
        parts.of_voxel[seed] = name;
        for (std::size_t next = 0; next < part.size(); ++next)
            for (const int offset : offsets) {
                const auto w = static_cast<VoxelId>(static_cast<int>(part[next]) + offset);
                if (grid.lumen[w] == 0 || parts.of_voxel[w] != LumenParts::kNone) continue;
                parts.of_voxel[w] = name;
                part.push_back(w);
            }
        parts.members.push_back(std::move(part));
        cancel.check_cancelled();
    }
    return parts;
}

std::size_t keep_large_components(LumenGrid& grid, double fraction) {
    const LumenParts parts = lumen_parts(grid);
    std::size_t largest = 0;
    for (const auto& part : parts.members) largest = std::max(largest, part.size());
    const double least = fraction * static_cast<double>(largest);
    std::size_t kept = 0;
    for (const auto& part : parts.members) {
        const bool is_large = static_cast<double>(part.size()) >= least;
        kept += is_large ? 1 : 0;
        if (!is_large)
            for (const VoxelId v : part) grid.lumen[v] = 0;
    }
    list_voxels(grid);
    return kept;
}

std::vector<VoxelId> add_geodesic_distances(const LumenGrid& grid, VoxelId from,
                                            std::vector<float>& distances, const Progress& cancel) {
    const auto offsets = grid.neighbour_offsets();
    const auto lengths = grid.neighbour_lengths();
    std::vector<VoxelId> reached;
    ShortestPaths paths(distances);
    paths.lower(from, 0.0F);
    while (const auto at = paths.next()) {
        if (reached.size() % kTurns == 0) cancel.check_cancelled();
        reached.push_back(at->vertex);
        for (std::size_t n = 0; n < 26; ++n) {
            const auto w = static_cast<VoxelId>(static_cast<int>(at->vertex) + offsets[n]);
            if (grid.lumen[w]) paths.lower(w, at->distance + lengths[n]);
        }
    }
    return reached;
}

}  // namespace vesselbench
