#include "meshing/stamp/contact_arms.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include <Eigen/Eigenvalues>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/measure.h"

namespace vesselbench {

namespace {

constexpr double kGrowth = 1.12;      ///< of the ball, from one attempt to the next [-]
constexpr double kFirst = 3.0;        ///< radius of the first ball [mean edges]
constexpr double kFarthest = 14.0;    ///< radius of the last ball [radii of the widest arm]
constexpr double kPoking = 1.25;      ///< what leaves the ball up to this is taken in [radii]
constexpr double kRoundest = 0.55;    ///< least ratio of a section's extents [-]
constexpr double kFullest = 0.75;     ///< least area of a section, of its ellipse's [-]
constexpr double kFlattest = 0.45;    ///< largest spread along the vessel of a rim [radii]
constexpr double kBand = 1.2;         ///< wall beside a rim that has its direction [radii]
constexpr std::size_t kMostRims = 9;  ///< a ball with more is too large

/// The triangles connected with `seed` among those marked.
std::vector<std::uint8_t> piece_at(const Surface& surface, const std::vector<std::uint8_t>& marked,
                                   TriangleId seed) {
    std::vector<std::uint8_t> piece(marked.size(), 0);
    std::vector<TriangleId> found = {seed};
    piece[seed] = 1;
    for (std::size_t i = 0; i < found.size(); ++i)
        for (const VertexId v : surface.triangles()[found[i]])
            for (const TriangleId t : surface.topology->triangles_at().row(v))
                if (marked[t] && !piece[t]) {
                    piece[t] = 1;
                    found.push_back(t);
                }
    return piece;
}

/// Adds the pieces of the rest that hardly leave the ball: dents of it, not vessels.
void take_in_pokes(const Surface& surface, const Vec3& centre, double reach,
                   const std::vector<TriangleId>& around, std::vector<std::uint8_t>& piece) {
    std::vector<std::uint8_t> near(piece.size(), 0), seen = piece;
    for (const TriangleId t : around) near[t] = 1;
    for (const TriangleId first : around) {
        if (seen[first]) continue;
        std::vector<TriangleId> poke = {first};
        seen[first] = 1;
        bool leaves = false, touches = false;
        for (std::size_t i = 0; i < poke.size(); ++i) {
            if (surface.patch_of(poke[i]).kind != PatchKind::Wall) leaves = true;
            for (const VertexId v : surface.triangles()[poke[i]]) {
                if ((surface.points()[v] - centre).norm() > reach) leaves = true;
                for (const TriangleId t : surface.topology->triangles_at().row(v)) {
                    touches |= piece[t] == 1;
                    if (seen[t]) continue;
                    seen[t] = 1;
                    if (near[t])
                        poke.push_back(t);
                    else
                        leaves = true;
                }
            }
        }
        if (!leaves && touches)
            for (const TriangleId t : poke) piece[t] = 1;
    }
}

/// Direction across the normals of the wall near a rim: the vessel's axis there.
Vec3 axis_near(const Surface& part, const Vec3& centre, double within) {
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (const Triangle& t : part.triangles()) {
        if ((part.points()[t[0]] - centre).norm() > within) continue;
        const Vec3 normal = area_normal(part.points(), t);
        if (normal.norm() > 0.0) spread += normal * normal.transpose() / normal.norm();
    }
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(0);
}

/// None if the rim is no whole section of one vessel.
std::optional<ContactArm> arm_at(const Surface& part, const std::vector<VertexId>& rim,
                                 const Vec3& middle) {
    ContactArm arm{.rim = rim};
    double length = 0.0;
    const auto at = [&](std::size_t i) { return part.points()[rim[i % rim.size()]]; };
    for (std::size_t i = 0; i < rim.size(); ++i) {
        const double step = (at(i + 1) - at(i)).norm();
        arm.centre += 0.5 * step * (at(i) + at(i + 1));
        length += step;
    }
    arm.centre /= length;
    Vec3 area = Vec3::Zero();
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (std::size_t i = 0; i < rim.size(); ++i) {
        area += 0.5 * (at(i) - arm.centre).cross(at(i + 1) - arm.centre);
        const Vec3 out = 0.5 * (at(i) + at(i + 1)) - arm.centre;
        spread += (at(i + 1) - at(i)).norm() / length * out * out.transpose();
    }
    arm.radius = std::sqrt(area.norm() / std::numbers::pi);
    const Eigen::Vector3d extents = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread)
                                        .eigenvalues()
                                        .cwiseMax(0.0)
                                        .cwiseSqrt();
    const double ellipse = 2.0 * std::numbers::pi * extents[1] * extents[2];
    if (!(arm.radius > 0.0) || extents[0] > kFlattest * arm.radius ||
        extents[1] < kRoundest * extents[2] || area.norm() < kFullest * ellipse)
        return std::nullopt;
    arm.outward = axis_near(part, arm.centre, kBand * arm.radius);
    const Vec3 away = area.dot(arm.centre - middle) < 0.0 ? Vec3(-area) : area;
    if (arm.outward.dot(away) < 0.0) arm.outward = -arm.outward;
    arm.radius *= std::sqrt(std::clamp(arm.outward.dot(away.normalized()), 0.5, 1.0));
    return arm;
}

struct Attempt {
    ContactZone zone;
    std::size_t rims = 0;
    bool four = false;  ///< whole sections of one vessel each

    [[nodiscard]] double widest() const {
        double widest = 0.0;
        for (const ContactArm& arm : zone.arms) widest = std::max(widest, arm.radius);
        return widest;
    }
};

Attempt attempt(const Surface& surface, const SurfaceDistance& places, const Vec3& centre,
                double reach) {
    Attempt made;
    made.zone.centre = centre;
    made.zone.reach = reach;
    std::vector<std::uint8_t> marked(surface.triangle_count(), 0);
    for (const TriangleId t : places.triangles_within(centre, reach))
        marked[t] = surface.patch_of(t).kind == PatchKind::Wall ? 1 : 0;
    const TriangleId seed = places.closest_point(centre).triangle;
    if (!marked[seed]) return made;
    std::vector<std::uint8_t> piece = piece_at(surface, marked, seed);
    take_in_pokes(surface, centre, kPoking * reach,
                  places.triangles_within(centre, kPoking * reach), piece);
    close_fans(surface, piece);
    made.zone.part = part_of(surface, piece);
    made.zone.marked = std::move(piece);
    const Connectivity part = connectivity(*made.zone.part.surface.topology);
    if (!part.manifold || !part.oriented) return made;  // its rims are no loops
    const auto rims = made.zone.part.surface.topology->boundary_loops();
    made.rims = rims.size();
    if (rims.size() != made.zone.arms.size()) return made;
    made.four = true;
    for (std::size_t i = 0; i < rims.size() && made.four; ++i) {
        auto arm = arm_at(made.zone.part.surface, rims[i], centre);
        made.four = arm.has_value();
        if (arm) made.zone.arms[i] = std::move(*arm);
    }
    return made;
}

}  // namespace

ContactZone contact_zone(const Surface& surface, const SurfaceDistance& places, const Vec3& centre,
                         double beyond, const Progress& cancel) {
    const double largest = bounds(surface).diagonal();
    std::size_t most = 0;
    double reach = kFirst * mean_edge_length(surface);
    for (; reach < largest; reach *= kGrowth) {
        cancel.check_cancelled();
        Attempt first = attempt(surface, places, centre, reach);
        most = std::max(most, first.rims);
        if (first.rims > kMostRims) break;
        if (!first.four) continue;
        if (reach > kFarthest * first.widest()) break;
        for (const double share : {1.0, 0.5, 0.25}) {
            Attempt wider =
                attempt(surface, places, centre, reach + share * beyond * first.widest());
            if (wider.four) return std::move(wider.zone);
        }
        return std::move(first.zone);
    }
    throw DiagnosedFailure({.code = "contact-without-arms",
                            .operation = "separate",
                            .place = centre,
                            .figures = {{"arms", static_cast<double>(most)}},
                            .remedies = {{.arguments = {{"at", ""}}}, {.operation = "stamp"}}});
}

}  // namespace vesselbench
