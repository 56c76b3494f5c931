#include "meshing/stamp/contact_bridge.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/kernel/diagnosed_error.h"
#include "meshing/stamp/refusal.h"

namespace vesselbench {

namespace {

constexpr double kScatter = 2.5;  ///< wall off its tube by more is no part of it [deviations]
constexpr double kLeast = 0.05;   ///< of that distance [radii]
constexpr double kMost = 0.15;    ///< of that distance [radii]

bool is_mixed(const Triangle& t, const std::vector<std::uint8_t>& own) {
    return own[t[0]] != own[t[1]] || own[t[1]] != own[t[2]];
}

/// 1 at the vertices of the bridge.
std::vector<std::uint8_t> bridge_vertices(const ContactZone& zone, const TwinTubes& twins,
                                          const std::vector<std::uint8_t>& own) {
    const Surface& part = zone.part.surface;
    std::vector<std::uint8_t> chosen(part.vertex_count(), 0);
    std::vector<VertexId> found;
    const auto choose = [&](VertexId v) {
        if (chosen[v]) return;
        chosen[v] = 1;
        found.push_back(v);
    };
    for (const Triangle& t : part.triangles())
        if (is_mixed(t, own))
            for (const VertexId v : t) choose(v);
    const auto stands_off = [&](VertexId v) {
        const Tube& tube = twins.tubes[own[v]];
        const auto [at, height] = tube.nearest_wall(part.points()[v]);
        const double radius = tube.radii()[at.segment];
        const double limit = std::clamp(kScatter * twins.noise, kLeast * radius, kMost * radius);
        return std::abs(height) > limit;
    };
    for (std::size_t i = 0; i < found.size(); ++i)
        for (const VertexId v : part.topology->rings().row(found[i]))
            if (!chosen[v] && own[v] == own[found[i]] && stands_off(v)) choose(v);
    return chosen;
}

void remove_around(const Surface& part, const std::vector<std::uint8_t>& chosen,
                   std::vector<std::uint8_t>& removed) {
    for (TriangleId t = 0; t < part.triangle_count(); ++t)
        if (std::ranges::any_of(part.triangles()[t], [&](VertexId v) { return chosen[v] == 1; }))
            removed[t] = 1;
}

/// 1 at the vertices of what is removed.
std::vector<std::uint8_t> vertices_of(const Surface& part,
                                      const std::vector<std::uint8_t>& removed) {
    std::vector<std::uint8_t> chosen(part.vertex_count(), 0);
    for (TriangleId t = 0; t < part.triangle_count(); ++t)
        if (removed[t])
            for (const VertexId v : part.triangles()[t]) chosen[v] = 1;
    return chosen;
}

/// Removes what is no longer connected with the arms. \return by vertex, the arm from which the
/// rest is reached first; none: 4
std::vector<std::uint8_t> drop_islands(const ContactZone& zone,
                                       std::vector<std::uint8_t>& removed) {
    const Surface& part = zone.part.surface;
    std::vector<std::uint8_t> from(part.vertex_count(), 4);
    std::vector<std::uint8_t> seen = removed;
    for (std::uint8_t arm = 0; arm < 4; ++arm) {
        std::vector<VertexId> found;
        for (const VertexId v : zone.arms[arm].rim)
            if (from[v] == 4) {
                from[v] = arm;
                found.push_back(v);
            }
        for (std::size_t i = 0; i < found.size(); ++i)
            for (const TriangleId t : part.topology->triangles_at().row(found[i])) {
                if (seen[t]) continue;
                seen[t] = 1;
                for (const VertexId v : part.triangles()[t])
                    if (from[v] == 4) {
                        from[v] = arm;
                        found.push_back(v);
                    }
            }
    }
    for (TriangleId t = 0; t < removed.size(); ++t)
        if (!seen[t]) removed[t] = 1;
    return from;
}

/// Removes the triangles at vertices where what remains meets in more than one fan.
void open_pinches(const Surface& part, std::vector<std::uint8_t>& removed) {
    for (bool pinched = true; pinched;) {
        pinched = false;
        std::vector<int> rim_edges(part.vertex_count(), 0);
        for (TriangleId t = 0; t < part.triangle_count(); ++t) {
            if (removed[t]) continue;
            const Triangle& corners = part.triangles()[t];
            for (int k = 0; k < 3; ++k) {
                const VertexId a = corners[k], b = corners[(k + 1) % 3];
                const bool bare = std::ranges::none_of(
                    part.topology->triangles_at().row(a), [&](TriangleId other) {
                        return other != t && !removed[other] &&
                               std::ranges::find(part.triangles()[other], b) !=
                                   part.triangles()[other].end();
                    });
                if (bare) ++rim_edges[a], ++rim_edges[b];
            }
        }
        for (VertexId v = 0; v < rim_edges.size(); ++v)
            if (rim_edges[v] > 2) {
                pinched = true;
                for (const TriangleId t : part.topology->triangles_at().row(v)) removed[t] = 1;
            }
    }
}

/// \throw DiagnosedFailure unless each vessel's arms are connected with each other alone
void complete(const ContactZone& zone, const TwinTubes& twins, ContactBridge& bridge) {
    const Surface& part = zone.part.surface;
    open_pinches(part, bridge.removed);
    const std::vector<std::uint8_t> from = drop_islands(zone, bridge.removed);
    const std::vector<std::uint8_t> gone = vertices_of(part, bridge.removed);
    for (const ContactArm& arm : zone.arms)
        for (const VertexId v : arm.rim)
            if (gone[v]) refuse_parting(part.points()[v]);
    std::array<std::uint8_t, 4> root{};
    for (std::uint8_t arm = 0; arm < 4; ++arm) root[arm] = from[zone.arms[arm].rim.front()];
    const auto& arms = twins.arms;
    if (root[arms[0][0]] != root[arms[0][1]] || root[arms[1][0]] != root[arms[1][1]] ||
        root[arms[0][0]] == root[arms[1][0]])
        refuse_parting(bridge.centre);
    for (std::uint8_t vessel = 0; vessel < 2; ++vessel)
        if (bridge.own[zone.arms[arms[vessel][0]].rim.front()] != vessel)
            refuse_parting(bridge.centre);
}

/// Extent of the bridge's middle line along and across the vessels.
void measure(const ContactZone& zone, const TwinTubes& twins, ContactBridge& bridge) {
    const Surface& part = zone.part.surface;
    Positions seam;
    for (const Triangle& t : part.triangles())
        if (is_mixed(t, bridge.own))
            seam.push_back((part.points()[t[0]] + part.points()[t[1]] + part.points()[t[2]]) / 3.0);
    if (seam.empty()) refuse_parting(zone.centre);
    for (const Vec3& p : seam) bridge.centre += p / static_cast<double>(seam.size());
    std::array<Vec3, 2> along;
    std::array<Vec3, 2> middle;
    for (std::size_t k = 0; k < 2; ++k) {
        const Tube& tube = twins.tubes[k];
        const AxisPlace at = tube.nearest_wall(bridge.centre).first;
        const Vec3& from = tube.points()[at.segment];
        const Vec3 step = tube.points()[at.segment + 1] - from;
        along[k] = step.normalized();
        middle[k] = from + at.t * step;
        bridge.radii[k] = tube.radius(at);
    }
    if (along[0].dot(along[1]) < 0.0) along[1] = -along[1];
    const Vec3 axis = (along[0] + along[1]).normalized();
    const Vec3 side = axis.cross(middle[1] - middle[0]).normalized();
    double low = 0.0, high = 0.0;
    for (const Vec3& p : seam) {
        low = std::min(low, (p - bridge.centre).dot(axis));
        high = std::max(high, (p - bridge.centre).dot(axis));
    }
    bridge.length = high - low;
    // A bent contact is as wide as where it is widest, not as its box.
    constexpr double kSlices = 8;
    for (int slice = 0; slice < kSlices; ++slice) {
        const double from = low + bridge.length * slice / kSlices;
        const double to = from + std::max(bridge.length / kSlices, 0.0);
        double left = std::numeric_limits<double>::infinity(), right = -left;
        for (const Vec3& p : seam) {
            const double s = (p - bridge.centre).dot(axis);
            if (s < from || s > to) continue;
            left = std::min(left, (p - bridge.centre).dot(side));
            right = std::max(right, (p - bridge.centre).dot(side));
        }
        bridge.width = std::max(bridge.width, right - left);
    }
}

}  // namespace

ContactBridge contact_bridge(const ContactZone& zone, const TwinTubes& twins) {
    const Surface& part = zone.part.surface;
    ContactBridge bridge;
    for (const Vec3& p : part.points())
        bridge.own.push_back(twins.tubes[0].height(p) <= twins.tubes[1].height(p) ? 0 : 1);
    bridge.removed.assign(part.triangle_count(), 0);
    measure(zone, twins, bridge);
    remove_around(part, bridge_vertices(zone, twins, bridge.own), bridge.removed);
    complete(zone, twins, bridge);
    return bridge;
}

void widen_bridge(const ContactZone& zone, const TwinTubes& twins, ContactBridge& bridge) {
    remove_around(zone.part.surface, vertices_of(zone.part.surface, bridge.removed),
                  bridge.removed);
    complete(zone, twins, bridge);
}

}  // namespace vesselbench
