#include "smoothing/context/flat_areas.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <optional>

#include <emmintrin.h>
#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "geometry/kernel/large_array.h"
#include "geometry/kernel/parallel.h"

namespace vesselbench {

namespace {

constexpr std::uint32_t kNotSearched = 0xFFFFFFFF;  // number of the triangles of other patches
constexpr double kLargestSpread =
    15.0;  // of the face normals around the mean normal of a cap [deg]

double cosine(double degrees) {
    return std::cos(degrees * std::numbers::pi / 180.0);
}

/// Per triangle the number of the part or area it belongs to, from 1; 0: none.
using AreaNumbers = std::vector<std::uint32_t>;

/// Vertices none of whose triangles deviates from their normal.
struct FlatVertices {
    std::vector<std::uint8_t> flat;  ///< #V
    LargeArray<FaceNormal> normals;  ///< #V unit, at flat vertices only
};

FlatVertices find_flat_vertices(const CompressedRows& rows, const AreaNormals& faces,
                                double flat_cosine) {
    const std::size_t count = rows.offsets.size() - 1;
    FlatVertices found{std::vector<std::uint8_t>(count), LargeArray<FaceNormal>(count)};
    for_each_vertex(count, [&](std::size_t v) {
        const auto row = rows.row(v);
        Vec3 sum = Vec3::Zero();
        for (const TriangleId t : row) sum += faces[t].weighted();
        const double least = flat_cosine * sum.norm();
        bool flat = !sum.isZero();
        for (const TriangleId t : row) {  // to the end: cheaper than a jump that is mispredicted
            const FaceNormal face = faces[t];
            flat &= face.weighted().dot(sum) >= least * face.length;
        }
        found.flat[v] = flat ? 1 : 0;
        if (!flat) return;
        sum.normalize();
        found.normals[v] = {sum.x(), sum.y(), sum.z(), 1.0};
    });
    return found;
}

/// Connected flat vertices, listed by their first one. Their flags are cleared, so each is visited
/// once.
CompressedRows connected_parts(const CompressedRows& rings, std::vector<std::uint8_t>& flat) {
    CompressedRows parts{{0}, {}};
    auto& queue = parts.values;
    queue.resize(static_cast<std::size_t>(std::ranges::count(flat, 1)) + 1);  // and a last write
    std::size_t next = 0, size = 0;
    for (VertexId first = 0; first < flat.size(); ++first) {
        if (flat[first] == 0) continue;
        flat[first] = 0;
        queue[size++] = first;
        for (; next < size; ++next)
            for (const VertexId u : rings.row(queue[next])) {
                queue[size] = u;  // counts if the vertex is flat and new
                size += flat[u];
                flat[u] = 0;
            }
        parts.offsets.push_back(static_cast<std::uint32_t>(size));
    }
    queue.resize(size);
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

/// Calls visit(t) for the triangles at both vertices, ascending.
template <class Visit>
void visit_common(const CompressedRows& rows, VertexId v, VertexId u, const Visit& visit) {
    constexpr std::size_t kLanes = 8;
    const auto some = rows.row(v), others = rows.row(u);
    if (some.size() > kLanes || rows.offsets[v] + kLanes > rows.values.size()) {
        for (const TriangleId t : some)
            if (std::ranges::find(others, t) != others.end()) visit(t);
        return;
    }
    const auto* row = reinterpret_cast<const __m128i*>(some.data());
    const __m128i low = _mm_loadu_si128(row), high = _mm_loadu_si128(row + 1);
    __m128i low_common = _mm_setzero_si128(), high_common = low_common;
    for (const TriangleId t : others) {
        const __m128i all = _mm_set1_epi32(static_cast<int>(t));
        low_common = _mm_or_si128(low_common, _mm_cmpeq_epi32(low, all));
        high_common = _mm_or_si128(high_common, _mm_cmpeq_epi32(high, all));
    }
    const auto bits = [](const __m128i& lanes) {
        return static_cast<unsigned>(_mm_movemask_ps(_mm_castsi128_ps(lanes)));
    };
    unsigned common = (bits(low_common) | bits(high_common) << 4) & ((1U << some.size()) - 1);
    for (; common != 0; common &= common - 1) visit(some[std::countr_zero(common)]);
}

/// Grows the area of a planar part, which takes only triangles that are free for it.
class Growth {
public:
    explicit Growth(const Ground& ground)
        : ground_(ground), met_(ground.surface.triangle_count(), 0) {}

    /// The triangles all of whose vertices are in the part, then, unless these are too few, those
    /// that join them without an edge between.
    /// \param numbers of the triangles within parts are those of the parts
    /// \param is_free (number) -> bool: triangles beyond the part that it may take
    /// \return the area, valid until the next one; the triangles beyond the part follow the others
    template <class IsFree>
    std::span<const TriangleId> area_of(std::span<const VertexId> part, std::uint32_t number,
                                        const AreaNumbers& numbers, const IsFree& is_free) {
        number_ = number;
        find_triangles(part, numbers, is_free);
        inside_ = area_.size();
        if (inside_ >= ground_.smallest) grow(numbers, is_free);
        return area_;
    }

    /// Number of triangles of the last area that are within the part.
    [[nodiscard]] std::size_t inside() const { return inside_; }

private:
    /// The triangles within the part, and those around it. Each entry is written first and counts
    /// if it is new, which costs less than jumps that are mispredicted.
    template <class IsFree>
    void find_triangles(std::span<const VertexId> part, const AreaNumbers& numbers,
                        const IsFree& is_free) {
        std::size_t most = 1;
        for (const VertexId v : part) most += ground_.rows.row(v).size();
        area_.resize(most);
        around_.resize(most);
        std::size_t inside = 0, around = 0;
        for (const VertexId v : part)
            for (const TriangleId t : ground_.rows.row(v)) {
                const bool within = numbers[t] == number_, is_new = met_[t] != number_;
                area_[inside] = t;
                inside += within && is_new ? 1 : 0;
                around_[around] = t;
                around += !within && is_free(numbers[t]) ? 1 : 0;
                met_[t] = within ? number_ : met_[t];
            }
        area_.resize(inside);
        around_.resize(around);
    }

    /// Adds the triangles around the area that differ slightly from it (those at a flat vertex do)
    /// and not much from the whole, then continues from each of them up to an edge of the surface.
    template <class IsFree>
    void grow(const AreaNumbers& numbers, const IsFree& is_free) {
        const auto& faces = ground_.faces;
        const auto triangles = ground_.surface.triangles();
        const Vec3 normal = mean_normal(faces, area_);
        const auto add = [&](TriangleId t, const FaceNormal& face) {
            met_[t] = number_;
            if (face.weighted().dot(normal) >= ground_.spread_cosine * face.length)
                area_.push_back(t);
        };
        for (const TriangleId t : around_)
            if (met_[t] != number_) add(t, faces[t]);
        for (std::size_t next = inside_; next < area_.size(); ++next) {
            const Triangle corners = triangles[area_[next]];
            const FaceNormal from = faces[area_[next]];
            const auto in_part = [&](VertexId v) { return ground_.part_of[v] == number_; };
            for (std::size_t k = 0; k < 3; ++k) {
                const VertexId a = corners[k], b = corners[(k + 1) % 3];
                if (in_part(a) || in_part(b)) continue;  // all triangles there have been met
                visit_common(ground_.rows, a, b, [&](TriangleId t) {
                    if (met_[t] == number_ || !is_free(numbers[t])) return;
                    const FaceNormal to = faces[t];
                    const double least = ground_.flat_cosine * to.length * from.length;
                    if (to.weighted().dot(from.weighted()) >= least) add(t, to);
                });
            }
        }
    }

    const Ground& ground_;
    std::uint32_t number_ = 0;
    std::size_t inside_ = 0;
    std::vector<TriangleId> area_, around_;
    std::vector<std::uint32_t> met_;  ///< #T: the last part that took or refused the triangle
};

/// Flags the vertices of the parts that are planar and large enough, in their order. Vertices
/// outside the plane of most of a part are dropped, and the whole part if they are the majority: a
/// flat part may continue around a smoothed rim, but a gentle bend has no plane.
std::vector<std::uint8_t> in_planes(const CompressedRows& parts,
                                    const LargeArray<FaceNormal>& normals, std::size_t smallest) {
    std::vector<std::uint8_t> in_plane(parts.values.size(), 0);
    tbb::parallel_for(std::size_t{0}, parts.offsets.size() - 1, [&](std::size_t i) {
        const auto part = parts.row(i);
        Vec3 normal = Vec3::Zero();
        for (const VertexId v : part) normal += normals[v].weighted();
        normal.normalize();
        std::size_t inside = 0;
        std::uint8_t* const flags = in_plane.data() + parts.offsets[i];
        for (std::size_t j = 0; j < part.size(); ++j) {
            const bool outside = normals[part[j]].weighted().dot(normal) < spread_cosine();
            flags[j] = outside ? 0 : 1;
            inside += flags[j];
        }
        // a planar net of n vertices has fewer than 2 n triangles
        if (2 * inside < part.size() || 2 * part.size() < smallest)
            std::fill_n(flags, part.size(), std::uint8_t{0});
    });
    return in_plane;
}

std::vector<std::uint32_t> numbers_of(const CompressedRows& parts, std::size_t vertex_count) {
    std::vector<std::uint32_t> part_of(vertex_count, 0);
    for (std::size_t i = 0; i + 1 < parts.offsets.size(); ++i)
        for (const VertexId v : parts.row(i)) part_of[v] = static_cast<std::uint32_t>(i + 1);
    return part_of;
}

/// Number of the part that a triangle is within, from 1; 0: none, kNotSearched: not of the wall.
AreaNumbers numbers_within(const Surface& surface, const std::vector<std::uint32_t>& part_of) {
    std::vector<std::uint8_t> is_wall;
    for (const Patch& patch : surface.patches) is_wall.push_back(patch.kind == PatchKind::Wall);
    const auto triangles = surface.triangles();
    AreaNumbers numbers(triangles.size());
    for_each_vertex(triangles.size(), [&](std::size_t t) {
        const auto& [a, b, c] = triangles[t];
        const std::uint32_t part = part_of[a];
        const bool within = part == part_of[b] && part == part_of[c];
        numbers[t] = is_wall[(*surface.patch_labels)[t]] == 0 ? kNotSearched : within ? part : 0;
    });
    return numbers;
}

/// An area as if there were no other part; no triangles if it is too small.
struct LoneArea {
    std::vector<TriangleId> triangles;
    std::size_t inside = 0;  ///< the first triangles, which are within the part
};

std::vector<LoneArea> lone_areas(const Ground& ground, const CompressedRows& parts,
                                 const AreaNumbers& numbers) {
    std::vector<LoneArea> areas(parts.offsets.size() - 1);
    tbb::enumerable_thread_specific<Growth> growths([&] { return Growth(ground); });
    const auto is_free = [](std::uint32_t number) { return number != kNotSearched; };
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, areas.size(), 8), [&](const auto& range) {
        Growth& growth = growths.local();
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
            const auto area =
                growth.area_of(parts.row(i), static_cast<std::uint32_t>(i + 1), numbers, is_free);
            if (area.size() < ground.smallest) continue;
            areas[i] = {{area.begin(), area.end()}, growth.inside()};
        }
    });
    return areas;
}

}  // namespace

double spread_cosine() {
    return cosine(kLargestSpread);
}

CompressedRows plane_parts(const AreaNormals& faces, const CapParameters& parameters) {
    const Topology& topology = *faces.surface().topology;
    FlatVertices vertices =
        find_flat_vertices(topology.triangles_at(), faces, cosine(parameters.flat_angle_deg));
    const CompressedRows parts = connected_parts(topology.rings(), vertices.flat);
    const auto in_plane =
        in_planes(parts, vertices.normals, static_cast<std::size_t>(parameters.smallest_faces));
    CompressedRows planes{{0}, {}};
    planes.values.reserve(parts.values.size());
    for (std::size_t i = 0; i + 1 < parts.offsets.size(); ++i) {
        for (std::uint32_t at = parts.offsets[i]; at < parts.offsets[i + 1]; ++at)
            if (in_plane[at] != 0) planes.values.push_back(parts.values[at]);
        if (planes.values.size() > planes.offsets.back())
            planes.offsets.push_back(static_cast<std::uint32_t>(planes.values.size()));
    }
    return planes;
}

std::vector<std::vector<TriangleId>> find_flat_areas(const AreaNormals& faces,
                                                     const CompressedRows& parts,
                                                     const CapParameters& parameters) {
    const Surface& surface = faces.surface();
    const Ground ground{surface,
                        surface.topology->triangles_at(),
                        faces,
                        static_cast<std::size_t>(parameters.smallest_faces),
                        cosine(parameters.flat_angle_deg),
                        spread_cosine(),
                        numbers_of(parts, surface.vertex_count())};
    AreaNumbers numbers = numbers_within(surface, ground.part_of);
    // Areas are made one after the other, none from a triangle that another has taken. Nearly all
    // take the same ones as if they were alone, which is computed for all of them in parallel.
    // Triangles within a later part are free until its turn, though they have its number already.
    auto areas = lone_areas(ground, parts, numbers);
    std::optional<Growth> growth;
    std::vector<std::uint8_t> robbed(areas.size(), 0);
    std::vector<std::vector<TriangleId>> found;
    for (std::size_t i = 0; i < areas.size(); ++i) {
        auto& [area, inside] = areas[i];
        const auto number = static_cast<std::uint32_t>(i + 1);
        const auto is_free = [number](std::uint32_t other) {
            return other == 0 || (other > number && other != kNotSearched);
        };
        const auto taken = [&](TriangleId t) { return !is_free(numbers[t]); };
        if (area.empty()) continue;
        if (robbed[i] != 0 || std::any_of(area.begin() + inside, area.end(), taken)) {
            if (!growth) growth.emplace(ground);
            const auto rest = growth->area_of(parts.row(i), number, numbers, is_free);
            area.assign(rest.begin(), rest.end());
            inside = growth->inside();
        }
        for (std::size_t j = inside; j < area.size(); ++j) {
            std::uint32_t& owner = numbers[area[j]];
            if (owner != 0) robbed[owner - 1] = 1;
            owner = number;
        }
        if (area.size() >= ground.smallest) found.push_back(std::move(area));
    }
    return found;
}

}  // namespace vesselbench
