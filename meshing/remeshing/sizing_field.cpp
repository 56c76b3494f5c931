#include "meshing/remeshing/sizing_field.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include <tbb/parallel_for.h>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/shortest_paths.h"
#include "geometry/kernel/surface_distance.h"
#include "meshing/remeshing/vertex_fields.h"

namespace vesselbench {

namespace {

void require(bool right, const char* name, double value, const char* range) {
    if (right) return;
    std::ostringstream text;
    text << name << " = " << value << " must be " << range;
    throw InvalidInput(text.str());
}

void require_parameters(const SizingParameters& p) {
    require(p.edge > 0.0 && std::isfinite(p.edge), "edge", p.edge, "above 0 mm");
    require(p.min_edge > 0.0, "min_edge", p.min_edge, "above 0 mm");
    require(p.max_edge >= p.min_edge, "max_edge", p.max_edge, "at least min_edge");
    require(p.gradation > 1.0, "gradation", p.gradation, "above 1");
}

/// Normals averaged over about half an edge of the target mesh: finer bumps are noise that the new
/// mesh cannot represent.
Positions smoothed_normals(const Surface& surface, double edge, const Progress& cancel) {
    const CompressedRows& rings = surface.topology->rings();
    const VertexCaps caps = caps_of_vertices(surface);
    Positions now = wall_normals(surface), next = now;
    const double reach = 0.7 * edge / mean_edge_length(surface);
    const int passes = std::clamp(static_cast<int>(reach * reach), 1, 60);
    for (int pass = 0; pass < passes; ++pass) {
        cancel.check_cancelled();
        tbb::parallel_for(std::size_t{0}, now.size(), [&](std::size_t v) {
            Vec3 sum = now[v];
            for (const VertexId u : rings.row(v))
                if (caps.patch[u] == 0 || caps.on_rim[u]) sum += now[u];
            next[v] = sum.squaredNorm() > 0.0 ? Vec3(sum.normalized()) : now[v];
        });
        std::swap(now, next);
    }
    return now;
}

/// Curvature [1/mm] from the change of the normals along the edges; on a cylinder that is the
/// largest principal curvature, because the mean square over all directions is half its square.
std::vector<double> curvatures(const Surface& surface, double edge, const Progress& cancel) {
    const Positions normals = smoothed_normals(surface, edge, cancel);
    cancel.check_cancelled();
    const CompressedRows& rings = surface.topology->rings();
    const VertexCaps caps = caps_of_vertices(surface);
    const Positions& points = surface.points();
    std::vector<double> result(points.size(), 0.0);
    tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t v) {
        double turned = 0.0, length = 0.0;
        for (const VertexId u : rings.row(v)) {
            if (caps.patch[u] != caps.patch[v] && !(caps.on_rim[u] || caps.on_rim[v])) continue;
            if (caps.patch[u] > 0 && !caps.on_rim[u]) continue;
            turned += (normals[u] - normals[v]).squaredNorm();
            length += (points[u] - points[v]).squaredNorm();
        }
        if (length > 0.0 && (caps.patch[v] == 0 || caps.on_rim[v]))
            result[v] = std::sqrt(2.0 * turned / length);
    });
    average(*surface.topology, 3, result);
    return result;
}

/// Distance to the opposite wall outside [mm]; infinite if there is none within reach. Walls that
/// do not face each other are one wall with a bump.
std::vector<double> outer_gaps(const Surface& surface, double reach, const Progress& cancel) {
    constexpr double kFacing = -0.7;
    const SurfaceDistance search = distance_to(surface);
    cancel.check_cancelled();
    const double skin = 1e-6 * reach;  // skips the wall that the ray starts on
    const Positions normals = wall_normals(surface);
    const VertexCaps caps = caps_of_vertices(surface);
    std::vector<double> gaps(surface.vertex_count(), std::numeric_limits<double>::infinity());
    tbb::parallel_for(std::size_t{0}, gaps.size(), [&](std::size_t v) {
        cancel.check_cancelled();
        if (caps.patch[v] > 0 || normals[v].isZero()) return;
        const auto hit =
            search.first_hit(surface.points()[v] + skin * normals[v], normals[v], reach);
        if (!hit) return;
        const Vec3 opposite =
            area_normal(surface.points(), surface.triangles()[hit->triangle]).normalized();
        if (opposite.dot(normals[v]) < kFacing) gaps[v] = hit->distance;
    });
    return gaps;
}

/// The longest edge whose triangles stay within the deviation of a wall of this curvature [mm].
double printable_edge(double resolution, double curvature, double radius) {
    // A triangle's middle is edge^2 / 6 times the curvature below a ball; edges scatter by a third.
    constexpr double kSquares = 5.0;
    constexpr double kMostPerRadius = 0.7;  // 9 edges around
    const double most = kMostPerRadius * radius;
    if (!(resolution > 0.0)) return 0.0;
    return curvature * most * most > kSquares * resolution
               ? std::sqrt(kSquares * resolution / curvature)
               : most;
}

}  // namespace

double slope_of(double gradation) {
    return 0.25 * (gradation - 1.0);
}

double usual_radius(const Surface& surface, const std::vector<double>& radii) {
    std::vector<std::pair<double, double>> parts;  // radius, area
    double total = 0.0;
    for (TriangleId t = 0; t < surface.triangle_count(); ++t) {
        if (surface.patch_of(t).kind != PatchKind::Wall) continue;
        const Triangle& triangle = surface.triangles()[t];
        const double area = area_normal(surface.points(), triangle).norm();
        parts.emplace_back((radii[triangle[0]] + radii[triangle[1]] + radii[triangle[2]]) / 3.0,
                           area);
        total += area;
    }
    std::sort(parts.begin(), parts.end());
    double below = 0.0;
    for (const auto& [radius, area] : parts) {
        below += area;
        if (below >= 0.5 * total && radius > 0.0) return radius;
    }
    throw InvalidInput("the surface has no wall to measure the radius of");
}

void limit_slope(const Surface& surface, double slope, std::vector<double>& sizes,
                 const Progress& cancel) {
    constexpr std::size_t kTurns = 4096;  // a few milliseconds
    ShortestPaths paths(sizes);           // a size is a distance that grows with the slope
    for (VertexId v = 0; v < sizes.size(); ++v) paths.start(v);
    const CompressedRows& rings = surface.topology->rings();
    const Positions& points = surface.points();
    std::size_t turns = 0;
    while (const auto at = paths.next()) {
        if (turns++ % kTurns == 0) cancel.check_cancelled();
        for (const VertexId u : rings.row(at->vertex))
            paths.lower(u, at->distance + slope * (points[u] - points[at->vertex]).norm());
    }
}

std::vector<double> sizing_field(const Surface& surface, const std::vector<double>& radii,
                                 const SizingParameters& parameters, const Progress& progress) {
    require_parameters(parameters);
    const double usual = usual_radius(surface, radii);
    progress.report(0.0, "measuring curvature");
    const std::vector<double> curvature = curvatures(surface, parameters.edge, progress);
    progress.report(0.4, "measuring gaps");
    double longest = parameters.max_edge;
    for (std::size_t v = 0; v < radii.size(); ++v)
        longest = std::max(longest, printable_edge(parameters.resolution, curvature[v], radii[v]));
    const std::vector<double> gaps =
        outer_gaps(surface, 2.0 * parameters.gap_edges * longest, progress);
    // An edge that the user wants long for its vessel exceeds `turn` on every wall.
    const double turn = std::max(parameters.turn, 1.5 * parameters.edge / usual);
    std::vector<double> sizes(radii.size());
    for (std::size_t v = 0; v < sizes.size(); ++v) {
        double size = parameters.edge * radii[v] / usual;
        if (curvature[v] * size > turn) size = turn / curvature[v];
        const double printable = printable_edge(parameters.resolution, curvature[v], radii[v]);
        const double most = std::max(parameters.max_edge, printable);
        size = std::min(std::max(size, printable), gaps[v] / parameters.gap_edges);
        sizes[v] = std::clamp(size, parameters.min_edge, most);
    }
    progress.report(0.8, "limiting the gradation");
    limit_slope(surface, slope_of(parameters.gradation), sizes, progress);
    return sizes;
}

}  // namespace vesselbench
