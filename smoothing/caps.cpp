#include "smoothing/caps.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/errors.h"
#include "smoothing/filter_support.h"

namespace vesselbench {

namespace {

constexpr double kLargestSpread = 15.0;  // of the face normals around a cap's own [deg]
constexpr double kTurnsAway = 45.0;      // of the surface beyond the rim from the cap [deg]
constexpr double kRimWidth = 1.0;        // within which it must do so, in radii of the area
constexpr int kSomeRings = 3;            // or within so many rings, if the area is small
constexpr double kNearlyAll = 0.9;       // of the border vertices

double cosine(double degrees) {
    return std::cos(degrees * std::numbers::pi / 180.0);
}

/// Unit normals; 0 where a triangle is degenerate.
std::vector<Vec3> face_normals(const Surface& surface) {
    std::vector<Vec3> normals(surface.triangle_count());
    detail::for_each_vertex(normals.size(), [&](std::size_t t) {
        const Vec3 normal = area_normal(surface.points(), surface.triangles()[t]);
        const double length = normal.norm();
        const bool valid = length > 0.0 && std::isfinite(length);
        normals[t] = valid ? Vec3(normal / length) : Vec3::Zero();
    });
    return normals;
}

class CapSearch {
public:
    CapSearch(const Surface& surface, const CapParameters& parameters)
        : surface_(surface),
          rows_(surface.topology->triangles_at()),
          normals_(face_normals(surface)),
          smallest_(static_cast<std::size_t>(parameters.smallest_faces)),
          flat_cosine_(cosine(parameters.flat_angle_deg)),
          region_(surface.triangle_count(), 0),
          ring_(surface.vertex_count(), 0) {
        find_flat_faces();
    }

    std::vector<Cap> caps() {
        std::vector<Cap> found;
        for (TriangleId t = 0; t < region_.size(); ++t) {
            if (!flat_[t] || region_[t] != 0) continue;
            const std::vector<TriangleId> flat = flat_area(t);
            const std::vector<TriangleId> seed = plane_part(flat);
            if (seed.size() < smallest_ || 2 * seed.size() < flat.size()) continue;
            std::vector<TriangleId> grown = grown_area(seed, mean_normal(seed));
            const Vec3 normal = mean_normal(grown);
            if (normal.isZero() || !is_cap(grown, normal)) continue;
            std::sort(grown.begin(), grown.end());
            found.push_back(make_cap(std::move(grown), normal, false));
        }
        return found;
    }

    std::vector<Cap> patches() const {
        std::vector<Cap> found;
        for (std::size_t p = 1; p < surface_.patches.size(); ++p) {
            if (surface_.patches[p].kind == PatchKind::Wall) continue;
            std::vector<TriangleId> triangles;
            for (TriangleId t = 0; t < surface_.triangle_count(); ++t)
                if ((*surface_.patch_labels)[t] == p) triangles.push_back(t);
            if (triangles.empty()) continue;
            const Vec3 normal = mean_normal(triangles);
            found.push_back(make_cap(std::move(triangles), normal, true));
        }
        return found;
    }

private:
    /// A face is flat if none of its vertices has a face that turns away from the vertex' normal.
    void find_flat_faces() {
        const std::size_t vertices = surface_.vertex_count();
        std::vector<std::uint8_t> flat_vertex(vertices, 0);
        detail::for_each_vertex(vertices, [&](std::size_t v) {
            Vec3 sum = Vec3::Zero();
            for (const TriangleId t : rows_.row(v))
                sum += area_normal(surface_.points(), surface_.triangles()[t]);
            const double length = sum.norm();
            bool flat = length > 0.0;
            for (const TriangleId t : rows_.row(v))
                flat =
                    flat && (normals_[t].isZero() || normals_[t].dot(sum) >= flat_cosine_ * length);
            flat_vertex[v] = flat ? 1 : 0;
        });
        flat_.assign(surface_.triangle_count(), 0);
        detail::for_each_vertex(flat_.size(), [&](std::size_t t) {
            const Triangle& corners = surface_.triangles()[t];
            const bool wall = surface_.patch_of(static_cast<TriangleId>(t)).kind == PatchKind::Wall;
            flat_[t] = wall && !normals_[t].isZero() && flat_vertex[corners[0]] &&
                       flat_vertex[corners[1]] && flat_vertex[corners[2]];
        });
    }

    /// Calls visit(other) for the triangles that share an edge with t.
    template <class Visit>
    void visit_neighbours(TriangleId t, const Visit& visit) const {
        const Triangle& corners = surface_.triangles()[t];
        for (int k = 0; k < 3; ++k)
            for (const TriangleId other : rows_.row(corners[k])) {
                if (other == t) continue;
                const Triangle& o = surface_.triangles()[other];
                const VertexId b = corners[(k + 1) % 3];
                if (o[0] == b || o[1] == b || o[2] == b) visit(other);
            }
    }

    std::vector<TriangleId> flat_area(TriangleId first) {
        std::vector<TriangleId> area{first};
        region_[first] = ++regions_;
        for (std::size_t i = 0; i < area.size(); ++i)
            visit_neighbours(area[i], [&](TriangleId other) {
                if (!flat_[other] || region_[other] != 0) return;
                region_[other] = regions_;
                area.push_back(other);
            });
        return area;
    }

    /// The area and what joins it without an edge between: faces that differ slightly from the one
    /// they join, and not much from the whole.
    std::vector<TriangleId> grown_area(std::vector<TriangleId> area, const Vec3& normal) {
        for (std::size_t i = 0; i < area.size(); ++i)
            visit_neighbours(area[i], [&](TriangleId other) {
                if (region_[other] != 0 || surface_.patch_of(other).kind != PatchKind::Wall) return;
                const bool degenerate = normals_[other].isZero();
                const bool joins = normals_[other].dot(normals_[area[i]]) >= flat_cosine_ &&
                                   normals_[other].dot(normal) >= cosine(kLargestSpread);
                if (!joins && !degenerate) return;
                region_[other] = region_[area.front()];
                area.push_back(other);
            });
        return area;
    }

    Vec3 mean_normal(const std::vector<TriangleId>& area) const {
        Vec3 sum = Vec3::Zero();
        for (const TriangleId t : area)
            sum += area_normal(surface_.points(), surface_.triangles()[t]);
        return sum.norm() > 0.0 ? Vec3(sum.normalized()) : Vec3::Zero();
    }

    void leave(TriangleId t) {
        region_[t] = 0;
        flat_[t] = 0;  // looked at once is enough
    }

    /// What lies in the plane of most of a flat area, which may go on around a smoothed rim.
    std::vector<TriangleId> plane_part(const std::vector<TriangleId>& area) {
        const Vec3 normal = mean_normal(area);
        std::vector<TriangleId> part;
        for (const TriangleId t : area)
            if (normals_[t].dot(normal) >= cosine(kLargestSpread))
                part.push_back(t);
            else
                leave(t);
        return part;
    }

    bool inside(VertexId v, std::uint32_t region) const {
        for (const TriangleId t : rows_.row(v))
            if (region_[t] == region) return true;
        return false;
    }

    /// Algorithm 1: the surface leaves the area to one side at all border vertices; and it does so
    /// for good.
    bool is_cap(const std::vector<TriangleId>& area, const Vec3& normal) {
        const std::uint32_t region = region_[area.front()];
        std::vector<VertexId> border;
        int orientation = 0;
        double doubled_area = 0.0;
        for (const TriangleId t : area) {
            doubled_area += area_normal(surface_.points(), surface_.triangles()[t]).norm();
            for (const VertexId v : surface_.triangles()[t]) {
                if (ring_[v] == region) continue;
                ring_[v] = region;
                const auto row = rows_.row(v);
                if (std::all_of(row.begin(), row.end(),
                                [&](TriangleId at) { return region_[at] == region; }))
                    continue;
                border.push_back(v);
                const int side = side_beyond(v, region, normal);
                if (side == 0) continue;  // in the plane: neither up nor down
                if (orientation != 0 && side != orientation) return false;
                orientation = side;
            }
        }
        const double radius = std::sqrt(0.5 * doubled_area / std::numbers::pi);
        return orientation != 0 && turns_away(border, radius, region, normal);
    }

    /// Sign of the largest distance along the normal to the neighbours outside of the area.
    int side_beyond(VertexId v, std::uint32_t region, const Vec3& normal) const {
        double farthest = 0.0, reach = 0.0;
        for (const VertexId u : surface_.topology->rings().row(v)) {
            if (inside(u, region)) continue;
            const Vec3 edge = surface_.points()[u] - surface_.points()[v];
            const double along = edge.dot(normal);
            reach = std::max(reach, edge.norm());
            if (std::abs(along) > std::abs(farthest)) farthest = along;
        }
        return std::abs(farthest) <= 1e-3 * reach ? 0 : farthest > 0.0 ? 1 : -1;
    }

    /// Follows the surface outward from every border vertex, ring by ring, until it has turned away
    /// from the area's normal.
    bool turns_away(const std::vector<VertexId>& border, double radius, std::uint32_t region,
                    const Vec3& normal) const {
        std::size_t turned = 0;
        for (const VertexId start : border) {
            VertexId at = start, before = start;
            Vec3 outward = Vec3::Zero();
            double way = 0.0;
            for (int ring = 0; ring <= kSomeRings || way <= kRimWidth * radius; ++ring) {
                if (steep_at(at, normal)) {
                    ++turned;
                    break;
                }
                before = at;
                at = next_outward(at, region, normal, outward);
                if (at == before) break;
                way += (surface_.points()[at] - surface_.points()[before]).norm();
            }
        }
        return static_cast<double>(turned) >= kNearlyAll * static_cast<double>(border.size());
    }

    bool steep_at(VertexId v, const Vec3& normal) const {
        for (const TriangleId t : rows_.row(v))
            if (!normals_[t].isZero() && normals_[t].dot(normal) < cosine(kTurnsAway)) return true;
        return false;
    }

    /// The neighbour farthest along the way away from the area, in the plane; at the border itself
    /// the way is the mean direction to the neighbours outside.
    VertexId next_outward(VertexId v, std::uint32_t region, const Vec3& normal,
                          Vec3& outward) const {
        const auto in_plane = [&](VertexId u) {
            const Vec3 edge = surface_.points()[u] - surface_.points()[v];
            return Vec3(edge - edge.dot(normal) * normal);
        };
        if (outward.isZero())
            for (const VertexId u : surface_.topology->rings().row(v))
                if (!inside(u, region)) outward += in_plane(u);
        VertexId best = v;
        double farthest = 0.0;
        for (const VertexId u : surface_.topology->rings().row(v)) {
            const double along = in_plane(u).dot(outward);
            if (along <= farthest || inside(u, region)) continue;
            farthest = along;
            best = u;
        }
        return best;
    }

    Cap make_cap(std::vector<TriangleId> triangles, const Vec3& normal, bool from_patch) const {
        Cap cap{std::move(triangles), {}, normal, from_patch};
        for (const TriangleId t : cap.triangles)
            cap.vertices.insert(cap.vertices.end(), surface_.triangles()[t].begin(),
                                surface_.triangles()[t].end());
        std::sort(cap.vertices.begin(), cap.vertices.end());
        cap.vertices.erase(std::unique(cap.vertices.begin(), cap.vertices.end()),
                           cap.vertices.end());
        return cap;
    }

    const Surface& surface_;
    const CompressedRows& rows_;
    std::vector<Vec3> normals_;
    std::size_t smallest_;
    double flat_cosine_;
    std::vector<std::uint8_t> flat_;     ///< #T
    std::vector<std::uint32_t> region_;  ///< #T; 0: none
    std::vector<std::uint32_t> ring_;    ///< #V: the region that has looked at the vertex last
    std::uint32_t regions_ = 0;
};

}  // namespace

std::vector<Cap> find_caps(const Surface& surface, const CapParameters& parameters) {
    detail::require_range("flat_angle_deg", parameters.flat_angle_deg, 0.0, 45.0);
    if (parameters.smallest_faces < 1)
        throw InvalidInput("smallest_faces = " + std::to_string(parameters.smallest_faces) +
                           " must be 1 or more");
    if (surface.empty()) return {};
    CapSearch search(surface, parameters);
    std::vector<Cap> caps = search.patches();
    for (Cap& cap : search.caps()) caps.push_back(std::move(cap));
    std::stable_sort(caps.begin(), caps.end(), [](const Cap& a, const Cap& b) {
        return a.triangles.front() < b.triangles.front();
    });
    return caps;
}

std::vector<std::uint8_t> cap_vertices(const std::vector<Cap>& caps, std::size_t vertex_count) {
    std::vector<std::uint8_t> flags(vertex_count, 0);
    for (const Cap& cap : caps)
        for (const VertexId v : cap.vertices) flags[v] = 1;
    return flags;
}

}  // namespace vesselbench
