#include "geometry/vessel/repair/slivers.h"

#include <algorithm>
#include <array>

#include "geometry/editing/editable_surface.h"
#include "geometry/vessel/repair/soup.h"

namespace vesselbench {

namespace {

constexpr int kMostPasses = 20;
constexpr int kMostRounds = 5;  ///< the mean edge grows a little each time

/// A normal turned beyond this cosine [-] spoils the surface; triangles that are slivers themselves
/// are ignored.
constexpr double kLeastCosine = 0.2;

struct Shape {
    double shortest = 0.0, height = 0.0;  ///< [mm]
    int short_side = 0, long_side = 0;    ///< side k runs from corner k to k + 1
};

using Corners = std::array<Vec3, 3>;

Vec3 normal_of(const Corners& c) {
    return (c[1] - c[0]).cross(c[2] - c[0]);
}

Shape shape_of(const Corners& corners) {
    Shape shape;
    double length[3];
    for (int k = 0; k < 3; ++k) length[k] = (corners[(k + 1) % 3] - corners[k]).norm();
    shape.short_side = static_cast<int>(std::min_element(length, length + 3) - length);
    shape.long_side = static_cast<int>(std::max_element(length, length + 3) - length);
    shape.shortest = length[shape.short_side];
    const double longest = length[shape.long_side];
    if (longest > 0.0) shape.height = normal_of(corners).norm() / longest;
    return shape;
}

/// Works on a surface that is already manifold; the half-edges give a vertex's triangles and
/// neighbours.
class SliverRemover {
public:
    SliverRemover(EditableSurface& surface, double smallest, RepairReport& report)
        : surface_(surface), smallest_(smallest), report_(report) {}

    bool run() {
        bool any = false;
        for (int pass = 0; pass < kMostPasses; ++pass) {
            bool changed = false;
            for (const TriangleId t : find_bad())
                if (!surface_.is_removed(t)) changed = mend(t) || changed;
            any = any || changed;
            if (!changed) break;
        }
        return any;
    }

private:
    [[nodiscard]] Shape shape_of(const Triangle& t) const {
        return vesselbench::shape_of(corners_of(t));
    }

    [[nodiscard]] Corners corners_of(const Triangle& t) const {
        return {surface_.point(t[0]), surface_.point(t[1]), surface_.point(t[2])};
    }

    [[nodiscard]] bool is_sliver(const Triangle& t) const { return shape_of(t).height < smallest_; }

    [[nodiscard]] std::vector<TriangleId> find_bad() const {
        std::vector<TriangleId> bad;
        for (TriangleId t = 0; t < surface_.triangle_count(); ++t)
            if (!surface_.is_removed(t) && is_sliver(surface_.triangle(t))) bad.push_back(t);
        return bad;
    }

    bool mend(TriangleId t) {
        const Triangle corners = surface_.triangle(t);
        const Shape shape = shape_of(corners);
        if (shape.height >= smallest_) return false;
        if (shape.shortest < smallest_) {
            const VertexId a = corners[shape.short_side], b = corners[(shape.short_side + 1) % 3];
            if (collapse(a, b)) return true;
        }
        return flip(t, shape.long_side);
    }

    /// 0: inside a patch; 1: between two patches; 2: where three meet; 3: on an open rim.
    [[nodiscard]] int rank(VertexId v) const {
        if (surface_.on_rim(v)) return 3;
        std::vector<std::uint16_t> labels;
        for (const TriangleId t : surface_.triangles_at(v)) labels.push_back(surface_.label(t));
        std::sort(labels.begin(), labels.end());
        labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
        return std::min<int>(static_cast<int>(labels.size()) - 1, 2);
    }

    /// Merges the vertex of lower rank into the other one.
    bool collapse(VertexId a, VertexId b) {
        const int rank_a = rank(a), rank_b = rank(b);
        const bool keep_a = rank_a > rank_b || (rank_a == rank_b && a < b);
        const VertexId keep = keep_a ? a : b, gone = keep_a ? b : a;
        if (!may_collapse(keep, gone) || !surface_.collapse(gone, keep)) return false;
        ++report_.collapsed_edges;
        report_.places.push_back({RepairKind::ShortEdge, surface_.point(keep), 0.0});
        return true;
    }

    [[nodiscard]] bool may_collapse(VertexId keep, VertexId gone) const {
        if (surface_.ring(keep).size() <= 3 || surface_.ring(gone).size() <= 3) return false;
        for (const TriangleId t : surface_.triangles_at(gone)) {
            const Triangle before = surface_.triangle(t);
            if (std::find(before.begin(), before.end(), keep) != before.end()) continue;
            Triangle after = before;
            for (VertexId& v : after)
                if (v == gone) v = keep;
            if (!is_sliver(before) && turns_over(before, after)) return false;
        }
        return true;
    }

    [[nodiscard]] bool turns_over(const Triangle& before, const Triangle& after) const {
        const Vec3 n = normal_of(corners_of(before)), m = normal_of(corners_of(after));
        return !(n.dot(m) > kLeastCosine * n.norm() * m.norm());
    }

    /// Swaps the longest side of a cap; on an open rim the cap itself is removed.
    bool flip(TriangleId t, int long_side) {
        const Triangle cap = surface_.triangle(t);
        const VertexId a = cap[long_side], b = cap[(long_side + 1) % 3],
                       c = cap[(long_side + 2) % 3];
        const auto beyond = surface_.across(t, long_side);
        if (beyond.empty()) return remove_at_rim(t, a, b, c);
        if (beyond.size() > 1) return false;
        const Triangle wing = surface_.triangle(beyond[0]);
        VertexId d = c;
        for (const VertexId v : wing)
            if (v != a && v != b) d = v;
        const Triangle first = {c, a, d}, second = {c, d, b};
        if (!is_sliver(wing) && (turns_over(wing, first) || turns_over(wing, second))) return false;
        if (std::min(shape_of(first).height, shape_of(second).height) <=
            std::min(shape_of(cap).height, shape_of(wing).height))
            return false;
        if (!surface_.flip(t, long_side)) return false;
        surface_.set_label(t, surface_.label(beyond[0]));
        ++report_.flipped_edges;
        return true;
    }

    /// The cap a, b, c has its longest side a-b on an open rim.
    bool remove_at_rim(TriangleId t, VertexId a, VertexId b, VertexId c) {
        if (surface_.on_rim(c) || surface_.triangles_at(a).size() < 2 ||
            surface_.triangles_at(b).size() < 2)
            return false;
        surface_.remove(t);
        ++report_.degenerate_triangles;
        return true;
    }

    EditableSurface& surface_;
    double smallest_;
    RepairReport& report_;
};

bool has_sliver(const TriangleSoup& soup, double smallest) {
    return std::any_of(soup.triangles.begin(), soup.triangles.end(), [&](const Triangle& t) {
        return shape_of({soup.points[t[0]], soup.points[t[1]], soup.points[t[2]]}).height <
               smallest;
    });
}

double mean_side(const EditableSurface& surface) {
    double sum = 0.0, count = 0.0;
    for (TriangleId t = 0; t < surface.triangle_count(); ++t) {
        if (surface.is_removed(t)) continue;
        const Triangle c = surface.triangle(t);
        for (int k = 0; k < 3; ++k)
            sum += (surface.point(c[k]) - surface.point(c[(k + 1) % 3])).norm();
        count += 3.0;
    }
    return count > 0.0 ? sum / count : 0.0;
}

}  // namespace

void remove_slivers(TriangleSoup& soup, double smallest_feature, RepairReport& report) {
    if (!has_sliver(soup, smallest_feature * mean_side(soup))) return;
    EditableSurface surface(soup);
    bool changed = false;
    for (int round = 0; round < kMostRounds; ++round) {
        const double smallest = smallest_feature * mean_side(surface);
        if (!SliverRemover(surface, smallest, report).run()) break;
        changed = true;
    }
    if (changed) soup = surface.to_soup();
}

}  // namespace vesselbench
