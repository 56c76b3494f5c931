#include "geometry/vessel/repair/slivers.h"

#include <algorithm>
#include <optional>

namespace vesselbench {

namespace {

constexpr int kMostPasses = 20;

/// A turned normal beyond this cosine [-] spoils the surface; triangles that are slivers themselves
/// have no say.
constexpr double kLeastCosine = 0.2;

struct Shape {
    double shortest = 0.0, height = 0.0;  ///< [mm]
    int short_side = 0, long_side = 0;    ///< side k runs from corner k to k + 1
};

class SliverRemover {
public:
    SliverRemover(RepairMesh& mesh, double smallest, RepairReport& report)
        : mesh_(mesh), smallest_(smallest), report_(report) {}

    bool run() {
        bool any = false;
        for (int pass = 0; pass < kMostPasses; ++pass) {
            const std::vector<TriangleId> bad = find_bad();
            if (bad.empty()) break;
            if (pass == 0) prepare();
            bool changed = false;
            for (const TriangleId t : bad)
                if (!dead_[t]) changed = mend(t) || changed;
            any = any || changed;
            if (!changed) break;
        }
        if (any) mesh_.remove_triangles(dead_);
        return any;
    }

private:
    [[nodiscard]] Shape shape_of(const Triangle& t) const {
        Shape shape;
        double length[3];
        for (int k = 0; k < 3; ++k)
            length[k] = (mesh_.points[t[(k + 1) % 3]] - mesh_.points[t[k]]).norm();
        shape.short_side = static_cast<int>(std::min_element(length, length + 3) - length);
        shape.long_side = static_cast<int>(std::max_element(length, length + 3) - length);
        shape.shortest = length[shape.short_side];
        const double longest = length[shape.long_side];
        if (longest > 0.0) shape.height = area_normal(mesh_.points, t).norm() / longest;
        return shape;
    }

    [[nodiscard]] bool is_sliver(const Triangle& t) const { return shape_of(t).height < smallest_; }

    [[nodiscard]] std::vector<TriangleId> find_bad() const {
        std::vector<TriangleId> bad;
        for (TriangleId t = 0; t < mesh_.triangles.size(); ++t)
            if ((dead_.empty() || !dead_[t]) && is_sliver(mesh_.triangles[t])) bad.push_back(t);
        return bad;
    }

    void prepare() {
        dead_.assign(mesh_.triangles.size(), 0);
        at_.resize(mesh_.points.size());
        for (TriangleId t = 0; t < mesh_.triangles.size(); ++t)
            for (const VertexId v : mesh_.triangles[t]) at_[v].push_back(t);
    }

    bool mend(TriangleId t) {
        const Shape shape = shape_of(mesh_.triangles[t]);
        if (shape.height >= smallest_) return false;
        const Triangle& corners = mesh_.triangles[t];
        if (shape.shortest < smallest_) {
            const VertexId a = corners[shape.short_side], b = corners[(shape.short_side + 1) % 3];
            if (collapse(a, b)) return true;
        }
        return flip(t, shape.long_side);
    }

    [[nodiscard]] std::vector<TriangleId> triangles_on(VertexId a, VertexId b) const {
        std::vector<TriangleId> found;
        for (const TriangleId t : at_[a])
            for (const VertexId v : mesh_.triangles[t])
                if (v == b) found.push_back(t);
        return found;
    }

    [[nodiscard]] std::vector<VertexId> ring(VertexId v) const {
        std::vector<VertexId> around;
        for (const TriangleId t : at_[v])
            for (const VertexId u : mesh_.triangles[t])
                if (u != v) around.push_back(u);
        std::sort(around.begin(), around.end());
        around.erase(std::unique(around.begin(), around.end()), around.end());
        return around;
    }

    [[nodiscard]] bool on_rim(VertexId v) const { return ring(v).size() != at_[v].size(); }

    /// 0: inside of a patch; 1: between two patches; 2: where three meet; 3: on an open rim.
    [[nodiscard]] int rank(VertexId v) const {
        if (on_rim(v)) return 3;
        std::vector<std::uint16_t> labels;
        for (const TriangleId t : at_[v]) labels.push_back(mesh_.labels[t]);
        std::sort(labels.begin(), labels.end());
        labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
        return std::min<int>(static_cast<int>(labels.size()) - 1, 2);
    }

    /// Moves the vertex of lower rank into the other one.
    bool collapse(VertexId a, VertexId b) {
        const int rank_a = rank(a), rank_b = rank(b);
        const bool keep_a = rank_a > rank_b || (rank_a == rank_b && a < b);
        const VertexId keep = keep_a ? a : b, gone = keep_a ? b : a;
        const auto shared = triangles_on(a, b);
        if (!may_collapse(keep, gone, shared)) return false;
        for (const TriangleId t : shared) remove(t);
        for (const TriangleId t : at_[gone]) {
            for (VertexId& v : mesh_.triangles[t])
                if (v == gone) v = keep;
            at_[keep].push_back(t);
        }
        at_[gone].clear();
        ++report_.collapsed_edges;
        report_.places.push_back({RepairKind::ShortEdge, mesh_.points[keep], 0.0});
        return true;
    }

    [[nodiscard]] bool may_collapse(VertexId keep, VertexId gone,
                                    const std::vector<TriangleId>& shared) const {
        if (shared.empty() || shared.size() > 2) return false;
        // Link condition: the only common neighbours stand opposite of the edge.
        const auto mine = ring(keep), theirs = ring(gone);
        std::vector<VertexId> common;
        std::set_intersection(mine.begin(), mine.end(), theirs.begin(), theirs.end(),
                              std::back_inserter(common));
        if (common.size() != shared.size() || mine.size() <= 3 || theirs.size() <= 3) return false;
        const bool inner_edge = shared.size() == 2;
        if (inner_edge && on_rim(keep) && on_rim(gone)) return false;
        for (const TriangleId t : at_[gone]) {
            const Triangle& before = mesh_.triangles[t];
            if (std::find(before.begin(), before.end(), keep) != before.end()) continue;
            Triangle after = before;
            for (VertexId& v : after)
                if (v == gone) v = keep;
            if (!is_sliver(before) && turns_over(before, after)) return false;
        }
        return true;
    }

    [[nodiscard]] bool turns_over(const Triangle& before, const Triangle& after) const {
        const Vec3 n = area_normal(mesh_.points, before), m = area_normal(mesh_.points, after);
        return !(n.dot(m) > kLeastCosine * n.norm() * m.norm());
    }

    /// Swaps the longest side of a cap; on an open rim the cap itself goes.
    bool flip(TriangleId t, int long_side) {
        const Triangle cap = mesh_.triangles[t];
        const VertexId a = cap[long_side], b = cap[(long_side + 1) % 3],
                       c = cap[(long_side + 2) % 3];
        const auto shared = triangles_on(a, b);
        if (shared.size() == 1) {
            if (on_rim(c) || at_[a].size() < 2 || at_[b].size() < 2) return false;
            remove(t);
            ++report_.degenerate_triangles;
            return true;
        }
        if (shared.size() != 2) return false;
        const TriangleId other = shared[0] == t ? shared[1] : shared[0];
        const Triangle& wing = mesh_.triangles[other];
        VertexId d = c;
        for (const VertexId v : wing)
            if (v != a && v != b) d = v;
        if (d == c || !triangles_on(c, d).empty()) return false;
        const Triangle first = {c, a, d}, second = {c, d, b};
        if (!is_sliver(wing) && (turns_over(wing, first) || turns_over(wing, second))) return false;
        if (std::min(shape_of(first).height, shape_of(second).height) <=
            std::min(shape_of(cap).height, shape_of(wing).height))
            return false;
        const std::uint16_t label = mesh_.labels[other];
        remove(t);
        remove(other);
        place(t, first, label);
        place(other, second, label);
        ++report_.flipped_edges;
        return true;
    }

    void remove(TriangleId t) {
        for (const VertexId v : mesh_.triangles[t]) std::erase(at_[v], t);
        dead_[t] = 1;
    }

    void place(TriangleId t, const Triangle& triangle, std::uint16_t label) {
        mesh_.triangles[t] = triangle;
        mesh_.labels[t] = label;
        dead_[t] = 0;
        for (const VertexId v : triangle) at_[v].push_back(t);
    }

    RepairMesh& mesh_;
    double smallest_;
    RepairReport& report_;
    std::vector<std::uint8_t> dead_;
    std::vector<std::vector<TriangleId>> at_;
};

}  // namespace

bool remove_slivers(RepairMesh& mesh, double smallest, RepairReport& report) {
    return SliverRemover(mesh, smallest, report).run();
}

}  // namespace vesselbench
