// Times our trees against CGAL's AABB tree and, if its header is installed, nanoflann: building,
// and finding the nearest triangle or vertex of points near the surface, on one thread. Prints how
// many answers differ from ours: at edges and corners, where several are equally near.

#include <algorithm>
#include <cstdio>
#include <memory>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>
#if __has_include(<nanoflann.hpp>)
#include <nanoflann.hpp>
#define HAS_NANOFLANN
#endif

#include "geometry/kernel/measure.h"
#include "geometry/kernel/stopwatch.h"
#include "geometry/kernel/surface_distance.h"
#include "smoothing/context/point_grid.h"
#include "smoothing/context/point_tree.h"
#include "tests/bench/organ.h"

namespace vesselbench::bench {

namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using CgalTree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;
using Answers = std::vector<std::uint32_t>;

constexpr int kRepeats = 5;
constexpr std::size_t kQueries = 200'000;

/// The shortest of several repeats, because the machine is shared.
struct Times {
    double build = 1e300, search = 1e300;  ///< [s]
};

/// \param build makes a tree  \param search answers all queries with it
template <class Build, class Search>
std::pair<Times, Answers> timed(const Build& build, const Search& search) {
    Times best;
    Answers answers;
    for (int repeat = 0; repeat < kRepeats; ++repeat) {
        const Stopwatch building;
        const auto tree = build();
        best.build = std::min(best.build, building.seconds());
        const Stopwatch searching;
        answers = search(*tree);
        best.search = std::min(best.search, searching.seconds());
    }
    return {best, std::move(answers)};
}

void row(const char* name, const std::pair<Times, Answers>& found, const Answers& ours) {
    std::size_t others = 0;
    for (std::size_t i = 0; i < ours.size(); ++i) others += found.second[i] != ours[i];
    std::printf("  %-34s build %7.3f s   %zu queries %7.3f s   %zu other answers\n", name,
                found.first.build, ours.size(), found.first.search, others);
    std::fflush(stdout);
}

/// Vertices of the surface, moved by up to half an edge: typical queries of smoothing and
/// remeshing.
Positions queries_near(const Surface& surface) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> shift(-0.5, 0.5);
    const double edge = mean_edge_length(surface);
    Positions queries(kQueries);
    for (Vec3& query : queries)
        query = surface.points()[random() % surface.vertex_count()] +
                edge * Vec3(shift(random), shift(random), shift(random));
    return queries;
}

/// Every answer of find(point).
template <class Find>
Answers answers(const Positions& queries, const Find& find) {
    Answers found(queries.size());
    for (std::size_t i = 0; i < queries.size(); ++i) found[i] = find(queries[i]);
    return found;
}

void compare_triangle_trees(const Surface& surface, const Positions& queries) {
    const auto ours = timed(
        [&] { return std::make_unique<SurfaceDistance>(surface); },
        [&](const SurfaceDistance& tree) {
            return answers(queries, [&](const Vec3& p) { return tree.closest_point(p).triangle; });
        });
    row("SurfaceDistance", ours, ours.second);
    const auto point = [](const Vec3& p) { return Kernel::Point_3(p.x(), p.y(), p.z()); };
    Triangles triangles;
    for (const auto& [a, b, c] : surface.triangles())
        triangles.emplace_back(point(surface.points()[a]), point(surface.points()[b]),
                               point(surface.points()[c]));
    const auto build = [&] {
        auto tree = std::make_unique<CgalTree>(triangles.cbegin(), triangles.cend());
        tree->build();
        tree->accelerate_distance_queries();
        return tree;
    };
    const auto find = [&](const CgalTree& tree) {
        return answers(queries, [&](const Vec3& p) {
            return static_cast<std::uint32_t>(tree.closest_point_and_primitive(point(p)).second -
                                              triangles.cbegin());
        });
    };
    row("CGAL AABB_tree", timed(build, find), ours.second);
}

#ifdef HAS_NANOFLANN
struct Cloud {
    const Positions& points;

    [[nodiscard]] std::size_t kdtree_get_point_count() const { return points.size(); }

    [[nodiscard]] double kdtree_get_pt(std::size_t i, std::size_t axis) const {
        return points[i][static_cast<Eigen::Index>(axis)];
    }

    template <class Box>
    bool kdtree_get_bbox(Box& /*box*/) const {
        return false;
    }
};

using Nanoflann = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Cloud>,
                                                      Cloud, 3, std::uint32_t>;

void compare_nanoflann(const Surface& surface, const Positions& queries, const Answers& ours) {
    const Cloud cloud{surface.points()};
    const auto found = timed([&] { return std::make_unique<Nanoflann>(3, cloud); },
                             [&](const Nanoflann& tree) {
                                 return answers(queries, [&](const Vec3& p) {
                                     std::uint32_t nearest = 0;
                                     double squared = 0.0;
                                     tree.knnSearch(p.data(), 1, &nearest, &squared);
                                     return nearest;
                                 });
                             });
    row("nanoflann", found, ours);
}
#else
void compare_nanoflann(const Surface&, const Positions&, const Answers&) {}
#endif

template <class Tree>
std::pair<Times, Answers> point_search(const Surface& surface, const Positions& queries) {
    std::vector<VertexId> all(surface.vertex_count());
    std::iota(all.begin(), all.end(), VertexId{0});
    const double reach = 2.0 * mean_edge_length(surface);  // a grid visits all cells within it
    return timed([&] { return std::make_unique<Tree>(surface.points(), all); },
                 [&](const Tree& tree) {
                     return answers(queries, [&](const Vec3& p) {
                         return tree.nearest(p, {.squared = reach * reach}).vertex;
                     });
                 });
}

void compare_point_trees(const Surface& surface, const Positions& queries) {
    const auto tree = point_search<PointTree>(surface, queries);
    row("PointTree", tree, tree.second);
    row("PointGrid", point_search<PointGrid>(surface, queries), tree.second);
    compare_nanoflann(surface, queries, tree.second);
}

void compare(double vertices) {
    const Surface surface = organ(vertices);
    const Positions queries = queries_near(surface);
    std::printf("%zu triangles, %zu vertices\n", surface.triangle_count(), surface.vertex_count());
    compare_triangle_trees(surface, queries);
    compare_point_trees(surface, queries);
}

}  // namespace

}  // namespace vesselbench::bench

int main() {
    vesselbench::bench::compare(125'000);
    vesselbench::bench::compare(500'000);
}
