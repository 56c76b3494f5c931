#include "gpu/render/drawing_arrays.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "geometry/kernel/edges.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/parallel.h"
#include "geometry/kernel/solid_surface.h"
#include "gpu/render/bounding_sphere.h"

namespace vesselbench {

namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint8_t kColours = 4, kSplit = 4;
constexpr std::uint16_t kLargestLabel = 16383;  // 14 bits of a tag

std::uint16_t tag_of(std::uint16_t label, std::uint8_t colour) {
    return static_cast<std::uint16_t>(4 * std::min(label, kLargestLabel) + colour);
}

/// Corner colours of vertices so that neighbours differ, in order; kSplit where neighbours
/// use all four.
std::vector<std::uint8_t> corner_colours(const Topology& topology) {
    std::vector<std::uint8_t> colours(topology.vertex_count(), kSplit);
    const CompressedRows& rings = topology.rings();
    for (std::size_t v = 0; v < colours.size(); ++v) {
        unsigned used = 0;
        for (const VertexId u : rings.row(v)) used |= 1U << colours[u];
        std::uint8_t colour = 0;
        while (colour < kColours && (used >> colour & 1U) != 0) ++colour;
        colours[v] = colour;
    }
    return colours;
}

/// Splits vertices into copies, in the order of the triangles.
class Splitter {
public:
    explicit Splitter(const Surface& surface)
        : surface_(surface),
          colours_(corner_colours(*surface.topology)),
          tags_(surface.vertex_count(), 0),
          last_extra_(surface.vertex_count(), kNone),
          used_(surface.vertex_count(), 0) {}

    [[nodiscard]] DrawingLayout layout() {
        DrawingLayout layout;
        layout.triangles.resize(surface_.triangle_count());
        for (TriangleId t = 0; t < layout.triangles.size(); ++t)
            layout.triangles[t] = split(surface_.triangles()[t], (*surface_.patch_labels)[t]);
        sort_extras(layout);
        layout.solid = is_solid_surface(surface_);
        layout.topology = surface_.topology;
        layout.patch_labels = surface_.patch_labels;
        return layout;
    }

private:
    struct Extra {
        VertexId vertex;
        std::uint16_t tag;
        std::uint32_t previous;  ///< extra of the same vertex, or kNone
    };

    Triangle split(const Triangle& triangle, std::uint16_t label) {
        std::array<std::uint8_t, 3> colours{};
        unsigned taken = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            colours[k] = colours_[triangle[k]];
            if (colours[k] != kSplit) taken |= 1U << colours[k];
        }
        for (std::size_t k = 0; k < 3; ++k)
            if (colours[k] == kSplit) {
                colours[k] = free_colour(triangle[k], label, taken);
                taken |= 1U << colours[k];
            }
        return {copy_of(triangle[0], tag_of(label, colours[0])),
                copy_of(triangle[1], tag_of(label, colours[1])),
                copy_of(triangle[2], tag_of(label, colours[2]))};
    }

    /// A colour that is not taken, of a copy that exists if possible.
    std::uint8_t free_colour(VertexId v, std::uint16_t label, unsigned taken) const {
        std::uint8_t first = kColours;
        for (std::uint8_t colour = 0; colour < kColours; ++colour) {
            if ((taken >> colour & 1U) != 0) continue;
            first = std::min(first, colour);
            if (found(v, tag_of(label, colour)) != kNone) return colour;
        }
        return first;
    }

    [[nodiscard]] std::uint32_t found(VertexId v, std::uint16_t tag) const {
        if (used_[v] == 0) return kNone;
        if (tags_[v] == tag) return v;
        for (std::uint32_t e = last_extra_[v]; e != kNone; e = extras_[e].previous)
            if (extras_[e].tag == tag) return static_cast<std::uint32_t>(tags_.size()) + e;
        return kNone;
    }

    std::uint32_t copy_of(VertexId v, std::uint16_t tag) {
        if (used_[v] == 0) {
            used_[v] = 1;
            tags_[v] = tag;
            return v;
        }
        const std::uint32_t known = found(v, tag);
        if (known != kNone) return known;
        const auto extra = static_cast<std::uint32_t>(extras_.size());
        extras_.push_back({v, tag, last_extra_[v]});
        last_extra_[v] = extra;
        return static_cast<std::uint32_t>(tags_.size()) + extra;
    }

    void sort_extras(DrawingLayout& layout) {
        const auto count = static_cast<std::uint32_t>(tags_.size());
        std::vector<std::uint32_t> order(extras_.size()), place(extras_.size());
        std::iota(order.begin(), order.end(), 0U);
        std::ranges::stable_sort(order, {}, [&](std::uint32_t e) { return extras_[e].vertex; });
        layout.tags = std::move(tags_);
        for (std::uint32_t i = 0; i < order.size(); ++i) {
            place[order[i]] = i;
            layout.extras.push_back(extras_[order[i]].vertex);
            layout.tags.push_back(extras_[order[i]].tag);
        }
        for (Triangle& triangle : layout.triangles)
            for (VertexId& corner : triangle)
                if (corner >= count) corner = count + place[corner - count];
    }

    const Surface& surface_;
    std::vector<std::uint8_t> colours_;
    std::vector<std::uint16_t> tags_;
    std::vector<Extra> extras_;
    std::vector<std::uint32_t> last_extra_;
    std::vector<std::uint8_t> used_;
};

std::array<std::int16_t, 3> packed(const Vec3& normal) {
    const double length = normal.norm();
    if (!(length > 0.0)) return {0, 0, 32767};
    const Vec3 scaled = normal * (32767.0 / length);
    std::array<std::int16_t, 3> result{};
    for (int i = 0; i < 3; ++i)
        result[static_cast<std::size_t>(i)] = static_cast<std::int16_t>(std::lround(scaled[i]));
    return result;
}

/// A vertex as its patch's copies show it.
DrawnVertex drawn_vertex(const DrawingArrays& drawing, const Positions& positions, VertexId v,
                         std::uint16_t tag) {
    const Surface& surface = drawing.surface;
    Vec3 normal = Vec3::Zero();
    for (const TriangleId t : surface.topology->triangles_at().row(v))
        if (std::min((*surface.patch_labels)[t], kLargestLabel) == tag / 4)
            normal += area_normal(positions, surface.triangles()[t]);
    const Eigen::Vector3f place = (positions[v] - drawing.bounds.centre).cast<float>();
    return {{place.x(), place.y(), place.z()}, packed(normal), tag};
}

bool fits(const DrawingLayout& layout, const Surface& surface) {
    return layout.topology == surface.topology && layout.patch_labels == surface.patch_labels;
}

/// The moved vertices and all corners of their triangles, ascending. Marks in place of sorting:
/// a dab comes to each vertex some seven times.
std::vector<VertexId> affected_by(const Topology& topology, std::span<const VertexId> moved) {
    constexpr std::size_t kBits = 64;
    std::vector<std::uint64_t> marks(topology.vertex_count() / kBits + 1, 0);
    const auto mark = [&](VertexId v) { marks[v / kBits] |= std::uint64_t{1} << v % kBits; };
    for (const VertexId v : moved) {
        mark(v);
        for (const VertexId u : topology.rings().row(v)) mark(u);
    }
    std::vector<VertexId> affected;
    affected.reserve(2 * moved.size());
    for (std::size_t i = 0; i < marks.size(); ++i)
        for (std::uint64_t left = marks[i]; left != 0; left &= left - 1)
            affected.push_back(
                static_cast<VertexId>(i * kBits + static_cast<unsigned>(std::countr_zero(left))));
    return affected;
}

}  // namespace

std::array<std::size_t, 2> DrawingLayout::extras_of(VertexId v) const {
    const auto [first, last] = std::equal_range(extras.begin(), extras.end(), v);
    return {static_cast<std::size_t>(first - extras.begin()),
            static_cast<std::size_t>(last - extras.begin())};
}

VertexId original_of(const DrawingArrays& drawing, std::size_t drawn) {
    return drawing.layout->original_of(drawn);
}

std::vector<std::uint32_t> drawn_copies(const DrawingLayout& layout, std::size_t vertex_count,
                                        std::span<const VertexId> vertices) {
    std::vector<std::uint32_t> copies(vertices.begin(), vertices.end());
    for (const VertexId v : vertices) {
        const auto [first, last] = layout.extras_of(v);
        for (std::size_t e = first; e < last; ++e)
            copies.push_back(static_cast<std::uint32_t>(vertex_count + e));
    }
    std::ranges::sort(copies);
    return copies;
}

DrawingArrays prepare_drawing(const Surface& surface, std::shared_ptr<const DrawingLayout> known) {
    if (surface.empty()) throw InvalidInput("there is no surface to draw");
    DrawingArrays drawing{surface, nullptr, {}, sphere_around(surface.points())};
    drawing.layout = known && fits(*known, surface)
                         ? std::move(known)
                         : std::make_shared<const DrawingLayout>(Splitter(surface).layout());
    drawing.vertices.resize(drawing.layout->tags.size());
    static_cast<void>(surface.topology->triangles_at());
    for_each_vertex(drawing.vertices.size(), [&](std::size_t i) {
        drawing.vertices[i] = drawn_vertex(drawing, surface.points(), original_of(drawing, i),
                                           drawing.layout->tags[i]);
    });
    return drawing;
}

std::vector<std::uint32_t> move_vertices(DrawingArrays& drawing, const Positions& positions,
                                         std::span<const VertexId> moved) {
    const Surface& surface = drawing.surface;
    std::vector<std::uint32_t> changed = drawn_copies(*drawing.layout, surface.vertex_count(),
                                                      affected_by(*surface.topology, moved));
    for (const std::uint32_t i : changed)
        drawing.vertices[i] =
            drawn_vertex(drawing, positions, original_of(drawing, i), drawing.layout->tags[i]);
    for (const VertexId v : moved)
        drawing.bounds.radius =
            std::max(drawing.bounds.radius, (positions[v] - drawing.bounds.centre).norm());
    return changed;
}

std::vector<std::array<std::uint32_t, 2>> unique_edges(const Topology& topology) {
    std::vector<std::array<std::uint32_t, 2>> edges;
    edges.reserve(topology.triangle_count() * 3 / 2);
    for (VertexId v = 0; v < topology.vertex_count(); ++v)
        for (const VertexId u : topology.rings().row(v))
            if (v < u) edges.push_back({v, u});
    return edges;
}

}  // namespace vesselbench
