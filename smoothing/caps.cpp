#include "smoothing/caps.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/errors.h"
#include "smoothing/cap_border.h"
#include "smoothing/filter_support.h"

namespace vesselbench {

namespace {

constexpr std::uint32_t kNotSearched = 0xFFFFFFFF;  // number of the triangles of other patches
constexpr double kLargestSpread = 15.0;             // of the face normals around a cap's own [deg]

double cosine(double degrees) {
    return std::cos(degrees * std::numbers::pi / 180.0);
}

/// Length of a vector; 0 where it is not finite.
double length_of(const Vec3& v) {
    const double length = v.norm();
    return std::isfinite(length) ? length : 0.0;
}

/// A cap of ascending triangles.
Cap make_cap(const Surface& surface, std::vector<TriangleId> triangles, const Vec3& normal,
             bool from_patch) {
    Cap cap{std::move(triangles), {}, {}, normal, from_patch};
    std::vector<VertexId> corners;
    corners.reserve(3 * cap.triangles.size());
    for (const TriangleId t : cap.triangles)
        corners.insert(corners.end(), surface.triangles()[t].begin(), surface.triangles()[t].end());
    std::sort(corners.begin(), corners.end());
    const Topology& topology = *surface.topology;
    for (std::size_t i = 0, end = 0; i < corners.size(); i = end) {
        const VertexId v = corners[i];
        while (end < corners.size() && corners[end] == v) ++end;
        cap.vertices.push_back(v);
        if (end - i < topology.triangles_at().row(v).size() || topology.boundary_vertices()[v] != 0)
            cap.rim.push_back(v);
    }
    return cap;
}

/// Normal of a triangle.
struct FaceNormal {
    Vec3 weighted = Vec3::Zero();  ///< as long as twice the area [mm^2]
    double length = 0.0;           ///< of it; 0: degenerate
};

class CapSearch {
public:
    CapSearch(const Surface& surface, const CapParameters& parameters)
        : surface_(surface),
          rows_(surface.topology->triangles_at()),
          smallest_(static_cast<std::size_t>(parameters.smallest_faces)),
          flat_cosine_(cosine(parameters.flat_angle_deg)),
          spread_cosine_(cosine(kLargestSpread)),
          border_(surface),
          in_part_(surface.vertex_count(), 0) {
        find_normals();
    }

    std::vector<Cap> run() {
        std::vector<Cap> found;
        for (VertexId v = 0; v < flat_.size(); ++v) {
            if (flat_[v] == 0) continue;
            collect_flat_part(v);
            // a plane net of n vertices has fewer than 2 n triangles
            if (2 * part_.size() < smallest_ || !keep_plane() || !collect_area()) continue;
            std::vector<TriangleId> area = area_;
            const Vec3 normal = mean_normal(area);
            if (!border_.encloses_cap(areas_, area, normal)) continue;
            std::sort(area.begin(), area.end());
            found.push_back(make_cap(surface_, std::move(area), normal, false));
        }
        return found;
    }

    std::vector<Cap> patches() const {
        if (std::ranges::all_of(surface_.patches,
                                [](const Patch& patch) { return patch.kind == PatchKind::Wall; }))
            return {};
        std::vector<std::vector<TriangleId>> triangles(surface_.patches.size());
        for (TriangleId t = 0; t < surface_.triangle_count(); ++t)
            if (!is_wall(t)) triangles[(*surface_.patch_labels)[t]].push_back(t);
        std::vector<Cap> found;
        for (auto& patch : triangles) {
            if (patch.empty()) continue;
            const Vec3 normal = mean_normal(patch);
            found.push_back(make_cap(surface_, std::move(patch), normal, true));
        }
        return found;
    }

private:
    bool is_wall(TriangleId t) const { return surface_.patch_of(t).kind == PatchKind::Wall; }

    /// Normals of triangles and vertices, and which vertices are flat: none of their triangles
    /// turns away from their normal.
    void find_normals() {
        faces_.resize(surface_.triangle_count());
        areas_.resize(surface_.triangle_count());
        detail::for_each_vertex(faces_.size(), [&](std::size_t t) {
            const Vec3 normal = area_normal(surface_.points(), surface_.triangles()[t]);
            const double length = length_of(normal);
            if (length > 0.0) faces_[t] = {normal, length};
            areas_[t] = is_wall(static_cast<TriangleId>(t)) ? 0 : kNotSearched;
        });
        at_vertices_.resize(surface_.vertex_count());
        flat_.resize(surface_.vertex_count());
        detail::for_each_vertex(flat_.size(), [&](std::size_t v) {
            const auto row = rows_.row(v);
            Vec3 sum = Vec3::Zero();
            for (const TriangleId t : row) sum += faces_[t].weighted;
            const double least = flat_cosine_ * sum.norm();
            const bool flat =
                !sum.isZero() && std::all_of(row.begin(), row.end(), [&](TriangleId t) {
                    return faces_[t].weighted.dot(sum) >= least * faces_[t].length;
                });
            flat_[v] = flat ? 1 : 0;
            if (flat) at_vertices_[v] = sum.normalized();
        });
    }

    /// part_: the connected flat vertices around one, which are flat no longer: once looked at is
    /// enough.
    void collect_flat_part(VertexId first) {
        const CompressedRows& rings = surface_.topology->rings();
        part_.assign(1, first);
        flat_[first] = 0;
        for (std::size_t i = 0; i < part_.size(); ++i)
            for (const VertexId u : rings.row(part_[i])) {
                if (flat_[u] == 0) continue;
                flat_[u] = 0;
                part_.push_back(u);
            }
    }

    /// Drops what lies outside the plane of most of the part; false if most of it does: a flat part
    /// may go on around a smoothed rim, but a gentle bend has no plane.
    bool keep_plane() {
        Vec3 normal = Vec3::Zero();
        for (const VertexId v : part_) normal += at_vertices_[v];
        normal.normalize();
        const std::size_t all = part_.size();
        std::erase_if(part_,
                      [&](VertexId v) { return at_vertices_[v].dot(normal) < spread_cosine_; });
        return 2 * part_.size() >= all;
    }

    /// area_: the triangles all of whose vertices are in the part, and then those that join them
    /// without an edge between; false if the former are too few.
    bool collect_area() {
        area_.clear();
        around_.clear();
        ++number_;
        for (const VertexId v : part_) in_part_[v] = number_;
        for (const VertexId v : part_)
            for (const TriangleId t : rows_.row(v)) {
                if (areas_[t] != 0) continue;
                const auto& [a, b, c] = surface_.triangles()[t];
                if (in_part_[a] != number_ || in_part_[b] != number_ || in_part_[c] != number_) {
                    around_.push_back(t);
                } else {
                    areas_[t] = number_;
                    area_.push_back(t);
                }
            }
        if (area_.size() < smallest_) return false;
        grow();
        return true;
    }

    /// Calls visit(other) for the triangles without an area that share an edge with t.
    template <class Visit>
    void visit_free_neighbours(TriangleId t, const Visit& visit) {
        const Triangle& corners = surface_.triangles()[t];
        for (int k = 0; k < 3; ++k) {
            const auto row = rows_.row(corners[k]);
            const VertexId b = corners[(k + 1) % 3];
            if (beside_.size() < row.size()) beside_.resize(row.size());
            std::size_t count = 0;  // chosen without branches, which nothing could predict
            for (const TriangleId other : row) {
                const Triangle& o = surface_.triangles()[other];
                const bool shares = (o[0] == b) | (o[1] == b) | (o[2] == b);
                beside_[count] = other;
                count += static_cast<std::size_t>(shares & (areas_[other] == 0));
            }
            for (std::size_t i = 0; i < count; ++i)
                if (areas_[beside_[i]] == 0) visit(beside_[i]);
        }
    }

    /// Adds the triangles around the area that differ slightly from it (those at a flat vertex do)
    /// and not much from the whole, and so on from each of them up to an edge of the surface.
    void grow() {
        const Vec3 normal = mean_normal(area_);
        const auto add = [&](TriangleId t) {
            if (faces_[t].weighted.dot(normal) < spread_cosine_ * faces_[t].length) return;
            areas_[t] = number_;
            area_.push_back(t);
        };
        std::size_t next = area_.size();
        for (const TriangleId t : around_)
            if (areas_[t] == 0) add(t);
        for (; next < area_.size(); ++next) {
            const TriangleId from = area_[next];
            visit_free_neighbours(from, [&](TriangleId to) {
                const double least = flat_cosine_ * faces_[to].length * faces_[from].length;
                if (faces_[to].weighted.dot(faces_[from].weighted) >= least) add(to);
            });
        }
    }

    Vec3 mean_normal(const std::vector<TriangleId>& area) const {
        Vec3 sum = Vec3::Zero();
        for (const TriangleId t : area) sum += faces_[t].weighted;
        return sum.normalized();
    }

    const Surface& surface_;
    const CompressedRows& rows_;
    std::size_t smallest_;
    double flat_cosine_, spread_cosine_;
    detail::CapBorder border_;
    std::vector<FaceNormal> faces_;  ///< #T
    std::vector<Vec3> at_vertices_;  ///< #V unit, at flat vertices
    std::vector<std::uint8_t> flat_;
    detail::AreaNumbers areas_;
    std::vector<std::uint32_t> in_part_;  ///< #V: the latest part a vertex was in
    std::uint32_t number_ = 0;            ///< of the latest part and its area
    std::vector<VertexId> part_;
    std::vector<TriangleId> area_, around_;
    std::vector<TriangleId> beside_;  ///< room for the triangles on an edge
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
    for (Cap& cap : search.run()) caps.push_back(std::move(cap));
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
