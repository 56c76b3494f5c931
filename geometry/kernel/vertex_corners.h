#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "geometry/kernel/triangles.h"

namespace vesselbench {

/// Vertices [first, last).
struct VertexRange {
    VertexId first, last;

    [[nodiscard]] bool has(VertexId v) const { return v - first < last - first; }
};

/// One range of vertices per thread.
[[nodiscard]] std::vector<VertexRange> vertex_shares(std::size_t vertex_count);

/// The corners of triangles, visited by vertex: each thread handles its share of the vertices. The
/// range of vertices of every few thousand triangles is stored: in a surface generated front by
/// front it is small, so a thread skips most triangles outside its share.
class VertexCorners {
public:
    explicit VertexCorners(std::span<const Triangle> triangles);

    /// Calls visit(v, next, previous, triangle) for the corners at the wanted vertices, in the
    /// order of the triangles; before each few thousand of these, calls prepare(one past the last
    /// wanted vertex among their corners).
    template <class Prepare, class Visit>
    void visit_at(const VertexRange& wanted, const Prepare& prepare, const Visit& visit) const {
        for (std::size_t i = 0; i < ranges_.size(); ++i) {
            const VertexRange& range = ranges_[i];
            if (range.last <= wanted.first || range.first >= wanted.last) continue;
            prepare(std::min(range.last, wanted.last));
            if (range.first >= wanted.first && range.last <= wanted.last)
                visit_part(i, visit);
            else
                visit_part(i, [&](VertexId v, VertexId next, VertexId previous, TriangleId t) {
                    if (wanted.has(v)) visit(v, next, previous, t);
                });
        }
    }

    template <class Visit>
    void visit_at(const VertexRange& wanted, const Visit& visit) const {
        visit_at(
            wanted, [](VertexId) {}, visit);
    }

private:
    static constexpr std::size_t kPart = 4096;  ///< triangles

    template <class Visit>
    void visit_part(std::size_t i, const Visit& visit) const {
        const std::size_t end = std::min(triangles_.size(), (i + 1) * kPart);
        for (std::size_t t = i * kPart; t < end; ++t) {
            const auto& [a, b, c] = triangles_[t];
            const auto id = static_cast<TriangleId>(t);
            visit(a, b, c, id);
            visit(b, c, a, id);
            visit(c, a, b, id);
        }
    }

    std::span<const Triangle> triangles_;
    std::vector<VertexRange> ranges_;
};

}  // namespace vesselbench
