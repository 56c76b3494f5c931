#include "geometry/vessel/repair/stray_holes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "geometry/editing/hole_patch.h"
#include "geometry/kernel/statistics.h"
#include "geometry/kernel/surface_distance.h"
#include "geometry/vessel/repair/soup.h"

namespace vesselbench {

namespace {

/// Smallest width of a vessel end relative to the lumen behind it [-]; holes in a wall face the
/// whole lumen and are below it.
constexpr double kWideAsLumen = 0.4;
constexpr double kLeastRound = 0.25;     ///< slits are not ends [-]
constexpr std::size_t kFewestEdges = 6;  ///< loops of fewer edges are always stray

/// A deliberate cut: many edges, flat, round; or lying in a plane.
constexpr std::size_t kCutEdges = 16;
constexpr double kCutFlat = 0.02;
constexpr double kCutRound = 0.85;
constexpr double kPlaneFlat = 0.002;
constexpr double kPlaneRound = 0.6;

/// A vessel torn off, or cut along its triangles, has a zigzag rim, longer than the end is wide.
/// Each pass moves the corners halfway to their neighbours' mean.
constexpr int kZigzagPasses = 4;

/// A rim that runs round a vessel has the area of its section, however torn it is, and the wall
/// beside it is not parallel to it.
constexpr double kRoundVessel = 0.7;  ///< radius over that of the lumen [-]
constexpr double kMostFacing = 0.5;   ///< OpenLoop::facing
constexpr double kMostElongated = 3.0;
/// A closed hole of many edges this wide beside the lumen [-] may be a branch torn off at the wall.
constexpr double kTornOff = 0.15;

/// Rings of triangles around a hole that determine the bending of its patch.
constexpr int kRings = 3;

double cut_part(const TriangleSoup& mesh, const std::vector<VertexId>& loop) {
    std::size_t cut = 0;
    for (const VertexId v : loop) cut += mesh.marks[v];
    return static_cast<double>(cut) / static_cast<double>(loop.size());
}

/// 4 pi area / length^2 of a loop without its zigzag.
double roundness_of(Positions corners) {
    const std::size_t n = corners.size();
    Positions next(n);
    for (int pass = 0; pass < kZigzagPasses; ++pass) {
        for (std::size_t i = 0; i < n; ++i)
            next[i] = 0.25 * (corners[(i + n - 1) % n] + 2.0 * corners[i] + corners[(i + 1) % n]);
        corners.swap(next);
    }
    Vec3 twice_area = Vec3::Zero();
    double length = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
        const Vec3& next_corner = corners[(i + 1) % n];
        twice_area += (corners[i] - corners[0]).cross(next_corner - corners[0]);
        length += (next_corner - corners[i]).norm();
    }
    return length > 0.0 ? 2.0 * std::numbers::pi * twice_area.norm() / (length * length) : 0.0;
}

/// \return OpenLoop::elongation
double elongation_of(const Positions& corners, const Vec3& normal) {
    const Vec3 x = normal.unitOrthogonal(), y = normal.cross(x).normalized();
    double xx = 0.0, xy = 0.0, yy = 0.0;
    for (const Vec3& corner : corners) {
        const double a = corner.dot(x), b = corner.dot(y);
        xx += a * a;
        xy += a * b;
        yy += b * b;
    }
    const double apart = std::hypot(xx - yy, 2.0 * xy), least = xx + yy - apart;
    return least > 0.0 ? std::sqrt((xx + yy + apart) / least)
                       : std::numeric_limits<double>::infinity();
}

OpenLoop shape_of(const TriangleSoup& mesh, std::vector<VertexId> vertices) {
    OpenLoop loop;
    loop.vertices = std::move(vertices);
    const std::size_t n = loop.vertices.size();
    for (const VertexId v : loop.vertices) loop.centre += mesh.points[v];
    loop.centre /= static_cast<double>(n);
    Vec3& normal = loop.normal;
    Positions corners;
    for (std::size_t i = 0; i < n; ++i) {
        const Vec3 a = mesh.points[loop.vertices[i]] - loop.centre;
        const Vec3 b = mesh.points[loop.vertices[(i + 1) % n]] - loop.centre;
        normal += 0.5 * a.cross(b);
        corners.push_back(a);
    }
    const double area = normal.norm();
    loop.radius = std::sqrt(area / std::numbers::pi);
    loop.elongation = elongation_of(corners, normal);
    loop.roundness = roundness_of(std::move(corners));
    if (area > 0.0)
        for (const VertexId v : loop.vertices)
            loop.flatness =
                std::max(loop.flatness,
                         std::abs((mesh.points[v] - loop.centre).dot(normal / area)) / loop.radius);
    loop.from_cut = cut_part(mesh, loop.vertices) > 0.5;
    return loop;
}

/// Half the distance from the inner side of the wall beside the rim to the opposite wall.
double lumen_radius(const TriangleSoup& mesh, const SurfaceDistance& distance,
                    const std::vector<TriangleId>& rim_triangles) {
    std::vector<double> widths;
    for (const TriangleId t : rim_triangles) {
        const Vec3 normal = area_normal(mesh.points, mesh.triangles[t]).normalized();
        const Vec3 from = centroid(mesh, mesh.triangles[t]);
        for (const SurfaceHit& hit : distance.all_hits(from, -normal)) {
            if (!hit.from_inside || hit.triangle == t) continue;
            widths.push_back(hit.distance);
            break;
        }
    }
    if (2 * widths.size() < rim_triangles.size() || widths.empty()) return 0.0;
    return 0.5 * median(widths);
}

/// \return OpenLoop::facing
double facing_of(const TriangleSoup& mesh, const Vec3& normal,
                 const std::vector<TriangleId>& rim_triangles) {
    double along = 0.0, whole = 0.0;
    for (const TriangleId t : rim_triangles) {
        const Vec3 wall = area_normal(mesh.points, mesh.triangles[t]);
        along += std::abs(wall.dot(normal));
        whole += wall.norm() * normal.norm();
    }
    return whole > 0.0 ? along / whole : 1.0;
}

/// The most frequent patch label of the rim triangles.
std::uint16_t label_around(const TriangleSoup& mesh, const Topology& topology,
                           const std::vector<VertexId>& loop) {
    std::map<std::uint16_t, int> votes;
    for (const VertexId v : loop)
        for (const TriangleId t : topology.triangles_at().row(v)) ++votes[mesh.labels[t]];
    const auto most =
        std::max_element(votes.begin(), votes.end(),
                         [](const auto& a, const auto& b) { return a.second < b.second; });
    return most == votes.end() ? std::uint16_t{0} : most->first;
}

Hole hole_in(const TriangleSoup& mesh, const Topology& topology,
             const std::vector<VertexId>& loop) {
    Hole hole{.loop = loop,
              .around = {},
              .point = [&mesh](VertexId v) { return mesh.points[v]; },
              .first_new = static_cast<VertexId>(mesh.points.size())};
    const auto at = [&](VertexId v) {
        const auto row = topology.triangles_at().row(v);
        return std::vector<TriangleId>(row.begin(), row.end());
    };
    const auto corners = [&](TriangleId t) { return mesh.triangles[t]; };
    for (const TriangleId t : triangles_around(loop, kRings, at, corners))
        hole.around.push_back(mesh.triangles[t]);
    return hole;
}

void close_loop(TriangleSoup& mesh, const Topology& topology, const std::vector<VertexId>& loop) {
    const Hole hole = hole_in(mesh, topology, loop);
    HolePatch patch =
        loop.size() <= 3 ? fill_plainly(hole) : fill_smoothly(hole, 1, PatchOrder::AsReported);
    if (patch.result != HolePatch::Result::Filled) patch = fill_plainly(hole);
    const std::uint16_t label = label_around(mesh, topology, loop);
    for (const Vec3& p : patch.points) mesh.add_vertex_between(p, loop);
    for (const Triangle& t : patch.triangles) mesh.add_triangle(t, label);
}

bool runs_round_vessel(const OpenLoop& loop) {
    return loop.lumen_radius > 0.0 && loop.radius > kRoundVessel * loop.lumen_radius &&
           loop.facing < kMostFacing && loop.elongation < kMostElongated;
}

/// Empty for a loop that is hardly an end, such as that of missing triangles.
std::optional<ClosedHole> closed_end(const OpenLoop& loop) {
    ClosedHole end{loop.centre, loop.radius, loop.lumen_radius};
    if (runs_round_vessel(loop)) return end;
    if (loop.vertices.size() < kCutEdges) return std::nullopt;
    end.in_wall = !is_wide_as_lumen(loop);
    if (end.in_wall && (loop.radius < kTornOff * loop.lumen_radius)) return std::nullopt;
    return end;
}

bool stays_open(const OpenLoop& loop, const RepairParameters& parameters) {
    if (loop.from_cut || loop.vertices.size() <= 3) return false;
    if (parameters.close_holes_up_to) return loop.radius > *parameters.close_holes_up_to;
    return is_vessel_end(loop);
}

}  // namespace

std::vector<OpenLoop> open_loops(const TriangleSoup& mesh) {
    const Topology topology(mesh.triangles, mesh.points.size());
    std::vector<OpenLoop> loops;
    for (auto& vertices : topology.boundary_loops())
        if (vertices.size() > 2) loops.push_back(shape_of(mesh, std::move(vertices)));
    const bool any = std::any_of(loops.begin(), loops.end(),
                                 [](const OpenLoop& loop) { return !loop.from_cut; });
    if (!any) return loops;
    const SurfaceDistance distance(mesh.points, mesh.triangles);
    for (OpenLoop& loop : loops) {
        if (loop.from_cut) continue;
        std::vector<TriangleId> beside;
        for (const VertexId v : loop.vertices)
            for (const TriangleId t : topology.triangles_at().row(v)) beside.push_back(t);
        std::sort(beside.begin(), beside.end());
        beside.erase(std::unique(beside.begin(), beside.end()), beside.end());
        loop.lumen_radius = lumen_radius(mesh, distance, beside);
        loop.facing = facing_of(mesh, loop.normal, beside);
    }
    return loops;
}

bool is_vessel_end(const OpenLoop& loop) {
    if (loop.vertices.size() < kFewestEdges || !(loop.radius > 0.0)) return false;
    const auto is_cut = [&](double flat, double round) {
        return loop.vertices.size() >= kCutEdges && loop.flatness < flat && loop.roundness > round;
    };
    if (is_cut(kCutFlat, kCutRound) || is_cut(kPlaneFlat, kPlaneRound)) return true;
    if (runs_round_vessel(loop)) return true;
    return loop.roundness > kLeastRound && is_wide_as_lumen(loop);
}

bool is_wide_as_lumen(const OpenLoop& loop) {
    return loop.radius > kWideAsLumen * loop.lumen_radius;
}

bool close_stray_holes(TriangleSoup& mesh, const RepairParameters& parameters,
                       RepairReport& report) {
    const Topology topology(mesh.triangles, mesh.points.size());
    report.openings.clear();
    double largest_closed = 0.0, smallest_kept = std::numeric_limits<double>::infinity();
    bool closed = false;
    for (const OpenLoop& loop : open_loops(mesh)) {
        if (stays_open(loop, parameters)) {
            report.openings.push_back({loop.centre, loop.radius, loop.vertices.size()});
            smallest_kept = std::min(smallest_kept, loop.radius);
            continue;
        }
        close_loop(mesh, topology, loop.vertices);
        closed = true;
        if (loop.from_cut) continue;
        ++report.closed_holes;
        largest_closed = std::max(largest_closed, loop.radius);
        report.places.push_back({RepairKind::Hole, loop.centre, loop.radius});
        if (const auto end = closed_end(loop)) report.closed_ends.push_back(*end);
    }
    if (!report.closed_up_to && largest_closed > 0.0 && largest_closed < smallest_kept)
        report.closed_up_to =
            std::isfinite(smallest_kept) ? 0.5 * (largest_closed + smallest_kept) : largest_closed;
    return closed;
}

}  // namespace vesselbench
