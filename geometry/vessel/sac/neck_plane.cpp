#include "geometry/vessel/sac/neck_plane.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <Eigen/Eigenvalues>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/wording.h"
#include "geometry/vessel/centerlines/centerline_graph.h"
#include "geometry/vessel/openings/branch_part.h"
#include "geometry/vessel/openings/branch_root.h"
#include "geometry/vessel/tree/tube.h"

namespace vesselbench {

namespace {

/// A sac stands out of its parent's tube by more than this [radii of the tube]; the first of them
/// that keeps the dome apart from the vessel's ends.
constexpr std::array kProtrusions = {0.2, 0.4, 0.7, 1.0, 1.5};

/// Height over the nearest of the tubes [radii of it].
double relative_height(const std::vector<Tube>& tubes, const Vec3& x) {
    double least = std::numeric_limits<double>::infinity();
    for (const auto& tube : tubes) {
        const TubeCoordinates at = tube.coordinates(x);
        least = std::min(least, at.height / at.radius);
    }
    return least;
}

VertexId nearest_vertex(const Surface& surface, const Vec3& x) {
    VertexId best = 0;
    for (VertexId v = 1; v < surface.vertex_count(); ++v)
        if ((surface.points()[v] - x).squaredNorm() < (surface.points()[best] - x).squaredNorm())
            best = v;
    return best;
}

/// The vertex of the sac that is nearest to its dome: an inner point may be nearer to the wall
/// below the neck. None: the plane misses the surface.
std::optional<VertexId> dome_vertex(const Surface& surface, const SacNeck& neck) {
    std::optional<VertexId> best;
    double least = std::numeric_limits<double>::infinity();
    for (VertexId v = 0; v < surface.vertex_count(); ++v) {
        const double squared = (surface.points()[v] - neck.dome).squaredNorm();
        if (squared >= least || neck.plane.distance(surface.points()[v]) <= 0.0) continue;
        least = squared;
        best = v;
    }
    return best;
}

/// Vertices of open ends and of the openings' patches; without any, those at the vessel's other
/// tips.
std::vector<std::uint8_t> foreign_vertices(const Surface& surface, const NamedBranch& branch) {
    std::vector<std::uint8_t> foreign = surface.topology->boundary_vertices();
    for (TriangleId t = 0; t < surface.triangle_count(); ++t)
        if (surface.patch_of(t).kind != PatchKind::Wall)
            for (const VertexId v : surface.triangles()[t]) foreign[v] = 1;
    if (std::find(foreign.begin(), foreign.end(), 1) != foreign.end()) return foreign;
    for (std::size_t node = 0; node < branch.graph->nodes.size(); ++node)
        if (node != branch.tip && branch.graph->nodes[node].is_tip())
            foreign[nearest_vertex(surface, branch.graph->nodes[node].position)] = 1;
    return foreign;
}

/// The connected vertices around the dome with values above a limit.
/// \return empty if a foreign one is among them
std::vector<VertexId> standing_out(const Surface& surface, const std::vector<double>& heights,
                                   double limit, VertexId dome,
                                   const std::vector<std::uint8_t>& foreign) {
    std::vector<std::uint8_t> seen(heights.size(), 0);
    std::vector<VertexId> found = {dome};
    seen[dome] = 1;
    for (std::size_t i = 0; i < found.size(); ++i) {
        if (foreign[found[i]] != 0) return {};
        for (const VertexId v : surface.topology->rings().row(found[i]))
            if (!std::exchange(seen[v], 1) && heights[v] > limit) found.push_back(v);
    }
    return found;
}

/// Plane fitted to the border of a set of vertices, its normal towards them.
Plane border_plane(const Surface& surface, const std::vector<VertexId>& inside) {
    std::vector<std::uint8_t> in(surface.vertex_count(), 0);
    Vec3 middle = Vec3::Zero();
    for (const VertexId v : inside) {
        in[v] = 1;
        middle += surface.points()[v] / static_cast<double>(inside.size());
    }
    Positions border;
    for (const VertexId v : inside)
        for (const VertexId u : surface.topology->rings().row(v))
            if (!in[u]) border.push_back(0.5 * (surface.points()[v] + surface.points()[u]));
    Vec3 centre = Vec3::Zero();
    for (const Vec3& x : border) centre += x / static_cast<double>(border.size());
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (const Vec3& x : border) spread += (x - centre) * (x - centre).transpose();
    Plane plane{centre,
                Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(0)};
    if (plane.distance(middle) < 0.0) plane.normal = -plane.normal;
    return plane;
}

/// The plane at which the sac stands out of its parent's tube.
std::optional<Plane> first_guess(const Surface& surface, const BranchRoot& root, VertexId tip,
                                 const std::vector<std::uint8_t>& foreign) {
    std::vector<Tube> tubes = root.parents;
    tubes.insert(tubes.end(), root.others.begin(), root.others.end());
    std::vector<double> heights;
    for (const Vec3& x : surface.points()) heights.push_back(relative_height(tubes, x));
    for (const double limit : kProtrusions) {
        if (heights[tip] <= limit) break;
        const auto inside = standing_out(surface, heights, limit, tip, foreign);
        if (inside.size() > 3) return border_plane(surface, inside);
    }
    return std::nullopt;
}

/// Mean over the parent's tubes, at the place nearest to the neck [mm].
double parent_diameter(const std::vector<Tube>& parents, const Vec3& neck) {
    double sum = 0.0;
    for (const auto& tube : parents) sum += 2.0 * tube.radius(tube.coordinates(neck).along);
    return sum / static_cast<double>(parents.size());
}

/// Searches the best plane by offsets and tilts that become smaller.
class NeckSearch {
public:
    NeckSearch(const Surface& surface, VertexId dome, const std::vector<std::uint8_t>& foreign)
        : surface_(surface), dome_(dome), foreign_(foreign) {}

    std::optional<SacPart> at(const Plane& plane) const {
        return sac_above(surface_, plane, dome_, foreign_);
    }

    /// The first plane of a row towards the dome that separates it.
    std::optional<SacPart> first(const Plane& guess) const {
        const double reach = guess.distance(surface_.points()[dome_]);
        for (int i = 0; i < kRows; ++i)
            if (auto part = at({guess.point + i * reach / kRows * guess.normal, guess.normal}))
                return part;
        return std::nullopt;
    }

    /// \param across direction from which tilts are counted, so that a rotated vessel gives the same
    SacPart best(SacPart from, const Vec3& across) const {
        double step = 1.0;
        const double radius = std::sqrt(from.neck_area / std::numbers::pi);
        double least = cost(from);
        while (step > kFinest) {
            bool better = false;
            for (const Plane& plane : around(from, across, step, radius)) {
                auto part = at(plane);
                if (const double c = cost(part); c < least * (1.0 - kNoGain)) {
                    least = c;
                    from = std::move(*part);
                    better = true;
                    break;
                }
            }
            if (!better) step *= 0.5;
        }
        return from;
    }

private:
    static constexpr int kRows = 20;
    static constexpr double kFinest = 0.02;  ///< of the first step [-]
    static constexpr double kOffset = 0.3;   ///< first step [radii of the neck]
    static constexpr double kTilt = 0.35;    ///< first step [rad]
    static constexpr double kNoGain = 1e-9;  ///< less is rounding [-]

    /// Squared length of the neck's outline by the area of the wall beyond it, [-].
    static double cost(const std::optional<SacPart>& part) {
        if (!part) return std::numeric_limits<double>::infinity();
        return part->neck_perimeter * part->neck_perimeter / part->wall_area;
    }

    static std::vector<Plane> around(const SacPart& part, const Vec3& across, double step,
                                     double radius) {
        const Vec3& n = part.neck.normal;
        const Vec3 u = (across - across.dot(n) * n).normalized(), v = n.cross(u);
        std::vector<Plane> planes;
        for (const double offset : {-kOffset, kOffset})
            planes.push_back({part.neck_centroid + offset * step * radius * n, n});
        for (int k = 0; k < 8; ++k) {
            const double turn = k * std::numbers::pi / 4.0, tilt = kTilt * step;
            const Vec3 side = std::cos(turn) * u + std::sin(turn) * v;
            const Vec3 tilted = std::cos(tilt) * n + std::sin(tilt) * side;
            for (const double offset : {0.0, 0.5 * kOffset, -0.5 * kOffset})
                planes.push_back({part.neck_centroid + offset * step * radius * n, tilted});
        }
        return planes;
    }

    const Surface& surface_;
    VertexId dome_;
    const std::vector<std::uint8_t>& foreign_;
};

}  // namespace

SacAtNeck propose_neck(const Surface& surface, const Vec3& dome, const Progress& progress) {
    const NamedBranch branch = branch_at_tip(surface, dome, progress);
    const BranchRoot root = branch_root(*branch.graph, branch.tip);
    const VertexId tip = nearest_vertex(surface, dome);
    const auto foreign = foreign_vertices(surface, branch);
    const NeckSearch search(surface, tip, foreign);
    std::optional<SacPart> first;
    if (const auto guess = first_guess(surface, root, tip, foreign)) first = search.first(*guess);
    if (!first) throw DiagnosedFailure({.code = "no-neck", .place = dome});
    const Positions& line = root.parents.front().points();
    SacAtNeck neck{.sac = search.best(std::move(*first), line.back() - line.front())};
    neck.parent_diameter = parent_diameter(root.parents, neck.sac.neck_centroid);
    return neck;
}

SacAtNeck sac_beyond(const Surface& surface, const SacNeck& neck, const Progress& progress) {
    const NamedBranch branch = branch_at_tip(surface, neck.dome, progress);
    const auto dome = dome_vertex(surface, neck);
    std::optional<SacPart> sac;
    if (dome) sac = sac_above(surface, neck.plane, *dome, foreign_vertices(surface, branch));
    if (!sac)
        throw DiagnosedFailure({.code = "plane-is-no-neck",
                                .place = neck.plane.point,
                                .words = {{"dome", place_text(neck.dome)}}});
    const BranchRoot root = branch_root(*branch.graph, branch.tip);
    return {.sac = std::move(*sac),
            .parent_diameter = parent_diameter(root.parents, neck.plane.point)};
}

}  // namespace vesselbench
