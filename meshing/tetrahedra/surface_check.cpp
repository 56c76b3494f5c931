#include "meshing/tetrahedra/surface_check.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/kernel/edges.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/self_intersections.h"
#include "geometry/kernel/wording.h"

namespace vesselbench {

namespace {

using Kind = SurfaceProblem::Kind;

constexpr std::size_t kNamedPlaces = 3;
// A triangle whose height is below this fraction of its longest edge has an angle below 0.6
// degrees: the cells on it cannot become good ones.
constexpr double kSliverHeight = 0.01;
// Below this fraction the triangle has no usable normal in double precision.
constexpr double kDegenerateHeight = 1e-9;

/// The code of a defect, and the operations that mend it.
struct Description {
    const char* code;
    std::vector<const char*> remedies;
};

Description description_of(Kind kind) {
    switch (kind) {
        case Kind::NotFinite:
            return {"surface-not-finite", {}};
        case Kind::Degenerate:
            return {"surface-degenerate", {"repair"}};
        case Kind::Duplicate:
            return {"surface-duplicate", {"repair"}};
        case Kind::Gap:
            return {"surface-gap", {"clip-opening", "fill-hole", "repair"}};
        case Kind::NonManifoldEdge:
            return {"surface-edge-not-manifold", {"repair"}};
        case Kind::NonManifoldVertex:
            return {"surface-vertex-not-manifold", {"repair"}};
        case Kind::Orientation:
            return {"surface-orientation", {"repair"}};
        case Kind::InsideOut:
            return {"surface-inside-out", {"repair"}};
        case Kind::SeveralParts:
            return {"surface-in-parts", {"keep-component"}};
        case Kind::Sliver:
            return {"surface-sliver", {"remesh"}};
        case Kind::SelfIntersection:
            break;
    }
    return {"surface-crosses-itself", {"repair"}};
}

class Finder {
public:
    explicit Finder(const Surface& surface) : surface_(surface) {}

    void add(Kind kind, std::vector<TriangleId> triangles, Positions places) {
        if (places.empty()) return;
        std::sort(triangles.begin(), triangles.end());
        triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
        const std::size_t count = places.size();
        places.resize(std::min(count, kNamedPlaces));
        problems.push_back({kind, count, std::move(places), std::move(triangles)});
    }

    [[nodiscard]] Vec3 centre(TriangleId t) const {
        const auto& [a, b, c] = surface_.triangles()[t];
        return (surface_.points()[a] + surface_.points()[b] + surface_.points()[c]) / 3.0;
    }

    [[nodiscard]] Vec3 middle(const std::array<VertexId, 2>& edge) const {
        return 0.5 * (surface_.points()[edge[0]] + surface_.points()[edge[1]]);
    }

    void find_not_finite();
    void find_duplicates();
    void find_flat();
    void find_gaps();
    void find_defects();
    void find_parts();
    void find_inside_out();
    void find_intersections(const Progress& progress);

    std::vector<SurfaceProblem> problems;

private:
    const Surface& surface_;
};

void Finder::find_not_finite() {
    Positions places;
    for (const Vec3& p : surface_.points())
        if (!p.allFinite()) places.push_back(p);
    add(Kind::NotFinite, {}, std::move(places));
}

void Finder::find_duplicates() {
    std::vector<std::pair<Triangle, TriangleId>> keys;
    for (TriangleId t = 0; t < surface_.triangle_count(); ++t) {
        Triangle key = surface_.triangles()[t];
        std::sort(key.begin(), key.end());
        keys.emplace_back(key, t);
    }
    std::sort(keys.begin(), keys.end());
    std::vector<TriangleId> triangles;
    Positions places;
    for (std::size_t i = 1; i < keys.size(); ++i)
        if (keys[i].first == keys[i - 1].first) {
            triangles.push_back(keys[i].second);
            places.push_back(centre(keys[i].second));
        }
    add(Kind::Duplicate, std::move(triangles), std::move(places));
}

// Height relative to the longest edge, by that edge's length [-].
double relative_height(const Surface& surface, TriangleId t) {
    const auto& [a, b, c] = surface.triangles()[t];
    const auto& p = surface.points();
    const double longest = std::max(
        {(p[b] - p[a]).squaredNorm(), (p[c] - p[b]).squaredNorm(), (p[a] - p[c]).squaredNorm()});
    return longest > 0.0 ? area_normal(p, surface.triangles()[t]).norm() / longest : 0.0;
}

void Finder::find_flat() {
    std::vector<TriangleId> degenerate, slivers;
    Positions degenerate_places, sliver_places;
    for (TriangleId t = 0; t < surface_.triangle_count(); ++t) {
        const double height = relative_height(surface_, t);
        if (height >= kSliverHeight) continue;
        (height < kDegenerateHeight ? degenerate : slivers).push_back(t);
        (height < kDegenerateHeight ? degenerate_places : sliver_places).push_back(centre(t));
    }
    add(Kind::Degenerate, std::move(degenerate), std::move(degenerate_places));
    add(Kind::Sliver, std::move(slivers), std::move(sliver_places));
}

void Finder::find_gaps() {
    const EdgeTable table = edge_table(*surface_.topology);
    std::vector<TriangleId> triangles;
    Positions places;
    for (std::size_t e = 0; e < table.edges.size(); ++e) {
        if (table.half_edges.row(e).size() != 1) continue;
        triangles.push_back(table.half_edges.row(e)[0] / 3);
        places.push_back(middle(table.edges[e]));
    }
    add(Kind::Gap, triangles, places);
}

void Finder::find_defects() {
    const ManifoldDefects defects = manifold_defects(*surface_.topology);
    Positions edges, vertices, turned;
    for (const auto& edge : defects.edges) edges.push_back(middle(edge));
    for (const auto& edge : defects.inconsistent_edges) turned.push_back(middle(edge));
    for (const VertexId v : defects.vertices) vertices.push_back(surface_.points()[v]);
    add(Kind::NonManifoldEdge, {}, edges);
    add(Kind::NonManifoldVertex, {}, vertices);
    add(Kind::Orientation, {}, turned);
}

void Finder::find_parts() {
    const Components components = connected_components(*surface_.topology);
    if (components.count() < 2) return;
    Positions places;
    for (TriangleId t = 0; t < surface_.triangle_count(); ++t)
        if (components.of_triangle[t] == places.size()) places.push_back(centre(t));
    add(Kind::SeveralParts, {}, places);
}

void Finder::find_inside_out() {
    const bool orientable = std::none_of(problems.begin(), problems.end(), [](const auto& p) {
        return p.kind == Kind::Gap || p.kind == Kind::Orientation;
    });
    if (orientable && volume(surface_) <= 0.0) add(Kind::InsideOut, {}, {centre(0)});
}

void Finder::find_intersections(const Progress& progress) {
    std::vector<TriangleId> triangles;
    Positions places;
    for (const auto& [s, t] : self_intersections(surface_, progress)) {
        triangles.insert(triangles.end(), {s, t});
        places.push_back(0.5 * (centre(s) + centre(t)));
    }
    add(Kind::SelfIntersection, triangles, places);
}

}  // namespace

Diagnostic diagnostic_of(const SurfaceProblem& problem) {
    std::string places;
    for (const Vec3& place : problem.places)
        places += (places.empty() ? "" : ", ") + coordinates_text(place);
    places += problem.count > problem.places.size() ? " ... mm" : " mm";
    const Description known = description_of(problem.kind);
    Diagnostic diagnostic{.code = known.code,
                          .figures = {{"count", static_cast<double>(problem.count)}},
                          .words = {{"places", places}}};
    if (!problem.places.empty()) diagnostic.place = problem.places.front();
    for (const char* operation : known.remedies)
        diagnostic.remedies.push_back({.operation = operation});
    return diagnostic;
}

std::vector<SurfaceProblem> surface_problems(const Surface& surface, const Progress& progress) {
    Finder finder(surface);
    finder.find_not_finite();
    if (surface.empty() || !finder.problems.empty()) return finder.problems;
    finder.find_gaps();
    finder.find_defects();
    finder.find_duplicates();
    finder.find_flat();
    finder.find_parts();
    finder.find_inside_out();
    finder.find_intersections(progress);
    std::stable_sort(finder.problems.begin(), finder.problems.end(),
                     [](const auto& l, const auto& r) { return l.kind < r.kind; });
    return finder.problems;
}

bool is_obstacle(const SurfaceProblem& problem) {
    return problem.kind != Kind::Sliver;
}

}  // namespace vesselbench
