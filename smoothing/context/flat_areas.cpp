#include "smoothing/context/flat_areas.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "geometry/kernel/parallel.h"

namespace vesselbench {

namespace {

constexpr std::uint32_t kNotSearched = 0xFFFFFFFF;  // number of the triangles of other patches
constexpr double kLargestSpread =
    15.0;  // of the face normals around the mean normal of a cap [deg]

double cosine(double degrees) {
    return std::cos(degrees * std::numbers::pi / 180.0);
}

/// Vertices none of whose triangles deviates from their normal.
struct FlatVertices {
    std::vector<std::uint8_t> flat;  ///< #V
    std::vector<Vec3> normals;       ///< #V unit, at flat vertices
};

FlatVertices find_flat_vertices(const CompressedRows& rows, const AreaNormals& faces,
                                double flat_cosine) {
    const std::size_t count = rows.offsets.size() - 1;
    FlatVertices found{std::vector<std::uint8_t>(count), std::vector<Vec3>(count)};
    for_each_vertex(count, [&](std::size_t v) {
        const auto row = rows.row(v);
        Vec3 sum = Vec3::Zero();
        for (const TriangleId t : row) sum += faces[t].weighted;
        const double least = flat_cosine * sum.norm();
        const bool flat = !sum.isZero() && std::all_of(row.begin(), row.end(), [&](TriangleId t) {
            const FaceNormal face = faces[t];
            return face.weighted.dot(sum) >= least * face.length();
        });
        found.flat[v] = flat ? 1 : 0;
        if (flat) found.normals[v] = sum.normalized();
    });
    return found;
}

/// Connected flat vertices, listed by their first one. Their flags are cleared, so each is visited
/// once.
CompressedRows connected_parts(const CompressedRows& rings, std::vector<std::uint8_t>& flat) {
    CompressedRows parts{{0}, {}};
    auto& queue = parts.values;
    for (VertexId first = 0; first < flat.size(); ++first) {
        if (flat[first] == 0) continue;
        flat[first] = 0;
        std::size_t next = queue.size();
        queue.push_back(first);
        for (; next < queue.size(); ++next)
            for (const VertexId u : rings.row(queue[next])) {
                if (flat[u] == 0) continue;
                flat[u] = 0;
                queue.push_back(u);
            }
        parts.offsets.push_back(static_cast<std::uint32_t>(queue.size()));
    }
    return parts;
}

/// The input for growing areas; constant meanwhile.
struct Ground {
    const Surface& surface;
    const CompressedRows& rows;
    const AreaNormals& faces;
    std::size_t smallest;
    double flat_cosine, spread_cosine;
    std::vector<std::uint32_t> part_of;  ///< #V: number of the planar part, from 1; 0: none
};

/// Grows the areas of planar parts; no area takes a triangle that already has a number.
class Growth {
public:
    Growth(const Ground& ground, AreaNumbers& numbers) : ground_(ground), numbers_(numbers) {}

    /// The triangles all of whose vertices are in the part and then, unless these are too few,
    /// those that join them without an edge between. They get the part's number.
    std::vector<TriangleId> area_of(std::span<const VertexId> part, std::uint32_t number) {
        area_.clear();
        around_.clear();
        number_ = number;
        for (const VertexId v : part)
            for (const TriangleId t : ground_.rows.row(v)) take_or_keep_for_later(t);
        if (area_.size() >= ground_.smallest) grow();
        return area_;
    }

private:
    void take(TriangleId t) {
        numbers_[t] = number_;
        area_.push_back(t);
    }

    void take_or_keep_for_later(TriangleId t) {
        if (numbers_[t] != 0) return;
        const auto& [a, b, c] = ground_.surface.triangles()[t];
        const auto& part = ground_.part_of;
        if (part[a] == number_ && part[b] == number_ && part[c] == number_)
            take(t);
        else
            around_.push_back(t);
    }

    /// Calls visit(other) for the triangles without a number that share an edge with t.
    template <class Visit>
    void visit_free_neighbours(TriangleId t, const Visit& visit) const {
        const auto triangles = ground_.surface.triangles();
        const Triangle& corners = triangles[t];
        for (int k = 0; k < 3; ++k)
            for (const TriangleId other : ground_.rows.row(corners[k])) {
                if (numbers_[other] != 0) continue;
                const Triangle& o = triangles[other];
                const VertexId b = corners[(k + 1) % 3];
                if (o[0] == b || o[1] == b || o[2] == b) visit(other);
            }
    }

    /// Adds the triangles around the area that differ slightly from it (those at a flat vertex do)
    /// and not much from the whole, then continues from each of them up to an edge of the surface.
    void grow() {
        const auto& faces = ground_.faces;
        const Vec3 normal = mean_normal(faces, area_);
        const auto add = [&](TriangleId t) {
            const FaceNormal face = faces[t];
            if (face.weighted.dot(normal) >= ground_.spread_cosine * face.length()) take(t);
        };
        std::size_t next = area_.size();
        for (const TriangleId t : around_)
            if (numbers_[t] == 0) add(t);
        for (; next < area_.size(); ++next) {
            const FaceNormal from = faces[area_[next]];
            visit_free_neighbours(area_[next], [&](TriangleId t) {
                const FaceNormal to = faces[t];
                const double least = ground_.flat_cosine * to.length() * from.length();
                if (to.weighted.dot(from.weighted) >= least) add(t);
            });
        }
    }

    const Ground& ground_;
    AreaNumbers& numbers_;
    std::uint32_t number_ = 0;
    std::vector<TriangleId> area_, around_;
};

/// Flags the vertices of the parts that are planar and large enough. Vertices outside the plane of
/// most of a part are dropped, and the whole part if they are the majority: a flat part may
/// continue around a smoothed rim, but a gentle bend has no plane.
std::vector<std::uint8_t> in_planes(const CompressedRows& parts, const std::vector<Vec3>& normals,
                                    std::size_t smallest) {
    std::vector<std::uint8_t> in_plane(normals.size(), 0);
    tbb::parallel_for(std::size_t{0}, parts.offsets.size() - 1, [&](std::size_t i) {
        const auto part = parts.row(i);
        Vec3 normal = Vec3::Zero();
        for (const VertexId v : part) normal += normals[v];
        normal.normalize();
        const auto outside = [&](VertexId v) { return normals[v].dot(normal) < spread_cosine(); };
        const auto inside =
            part.size() - static_cast<std::size_t>(std::ranges::count_if(part, outside));
        // a planar net of n vertices has fewer than 2 n triangles
        if (2 * inside < part.size() || 2 * part.size() < smallest) return;
        for (const VertexId v : part) in_plane[v] = outside(v) ? 0 : 1;
    });
    return in_plane;
}

std::vector<std::uint32_t> numbers_of(const CompressedRows& parts, std::size_t vertex_count) {
    std::vector<std::uint32_t> part_of(vertex_count, 0);
    for (std::size_t i = 0; i + 1 < parts.offsets.size(); ++i)
        for (const VertexId v : parts.row(i)) part_of[v] = static_cast<std::uint32_t>(i + 1);
    return part_of;
}

/// The area of every part as if there were no other.
std::vector<std::vector<TriangleId>> lone_areas(const Ground& ground, const CompressedRows& parts,
                                                const AreaNumbers& unsearched) {
    std::vector<std::vector<TriangleId>> areas(parts.offsets.size() - 1);
    tbb::enumerable_thread_specific<AreaNumbers> numbers(unsearched);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, areas.size(), 8), [&](const auto& range) {
        AreaNumbers& mine = numbers.local();
        Growth growth(ground, mine);
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
            areas[i] = growth.area_of(parts.row(i), static_cast<std::uint32_t>(i + 1));
            for (const TriangleId t : areas[i]) mine[t] = 0;
        }
    });
    return areas;
}

}  // namespace

AreaNormals::AreaNormals(const Surface& surface, When when) : surface_(surface) {
    if (when == When::Asked) return;
    std::vector<FaceNormal> all(surface.triangle_count());
    for_each_vertex(all.size(),
                    [&](std::size_t t) { all[t] = normal_of(static_cast<TriangleId>(t)); });
    known_ = std::move(all);
}

FaceNormal AreaNormals::normal_of(TriangleId t) const {
    const Vec3 normal = area_normal(surface_.points(), surface_.triangles()[t]);
    const double length = normal.norm();
    return length > 0.0 && std::isfinite(length) ? FaceNormal{normal} : FaceNormal{};
}

Vec3 mean_normal(const AreaNormals& faces, std::span<const TriangleId> triangles) {
    Vec3 sum = Vec3::Zero();
    for (const TriangleId t : triangles) sum += faces[t].weighted;
    return sum.normalized();
}

double spread_cosine() {
    return cosine(kLargestSpread);
}

CompressedRows plane_parts(const Surface& surface, const AreaNormals& faces,
                           const CapParameters& parameters) {
    FlatVertices vertices = find_flat_vertices(surface.topology->triangles_at(), faces,
                                               cosine(parameters.flat_angle_deg));
    const CompressedRows parts = connected_parts(surface.topology->rings(), vertices.flat);
    const auto in_plane =
        in_planes(parts, vertices.normals, static_cast<std::size_t>(parameters.smallest_faces));
    CompressedRows planes{{0}, {}};
    for (std::size_t i = 0; i + 1 < parts.offsets.size(); ++i) {
        for (const VertexId v : parts.row(i))
            if (in_plane[v] != 0) planes.values.push_back(v);
        if (planes.values.size() > planes.offsets.back())
            planes.offsets.push_back(static_cast<std::uint32_t>(planes.values.size()));
    }
    return planes;
}

FlatAreas find_flat_areas(const Surface& surface, const AreaNormals& faces,
                          const CompressedRows& parts, const CapParameters& parameters) {
    const Ground ground{surface,
                        surface.topology->triangles_at(),
                        faces,
                        static_cast<std::size_t>(parameters.smallest_faces),
                        cosine(parameters.flat_angle_deg),
                        spread_cosine(),
                        numbers_of(parts, surface.vertex_count())};

    FlatAreas found{AreaNumbers(surface.triangle_count(), 0), {}};
    for_each_vertex(found.numbers.size(), [&](std::size_t t) {
        const PatchKind kind = surface.patch_of(static_cast<TriangleId>(t)).kind;
        if (kind != PatchKind::Wall) found.numbers[t] = kNotSearched;
    });
    // Areas are made one after the other, none from a triangle that another has taken. Nearly all
    // take the same ones as if they were alone, which is computed for all of them in parallel.
    auto areas = lone_areas(ground, parts, found.numbers);
    Growth growth(ground, found.numbers);
    for (std::size_t i = 0; i < areas.size(); ++i) {
        auto& area = areas[i];
        const auto number = static_cast<std::uint32_t>(i + 1);
        const auto taken = [&](TriangleId t) { return found.numbers[t] != 0; };
        if (std::ranges::any_of(area, taken))
            area = growth.area_of(parts.row(i), number);
        else
            for (const TriangleId t : area) found.numbers[t] = number;
        if (area.size() >= ground.smallest) found.areas.push_back(std::move(area));
    }
    return found;
}

}  // namespace vesselbench
