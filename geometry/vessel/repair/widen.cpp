#include "geometry/vessel/repair/widen.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <tbb/parallel_for.h>

#include "geometry/kernel/argument_checks.h"
#include "geometry/kernel/disjoint_sets.h"
#include "geometry/kernel/lumen_width.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/shortest_paths.h"
#include "geometry/kernel/surface_distance.h"

namespace vesselbench {

namespace {

constexpr int kPasses = 12;
constexpr double kWideEnough = 0.98;  ///< of the width: the rest would take many passes
constexpr double kFade = 0.25;        ///< slope with which the displacement ends [-]

/// Vertices that may move: of the wall, away from caps and open rims.
std::vector<std::uint8_t> movable_vertices(const Surface& surface) {
    std::vector<std::uint8_t> movable(surface.vertex_count(), 1);
    for (TriangleId t = 0; t < surface.triangle_count(); ++t)
        if (surface.patch_of(t).kind != PatchKind::Wall)
            for (const VertexId v : surface.triangles()[t]) movable[v] = 0;
    for (const auto& loop : surface.topology->boundary_loops())
        for (const VertexId v : loop) movable[v] = 0;
    return movable;
}

class Widening {
public:
    Widening(const Surface& surface, double width)
        : surface_(surface), width_(width), movable_(movable_vertices(surface)) {}

    /// Width of the lumen at every vertex that may move and where it is below the wanted one; 0
    /// elsewhere. #V [mm]
    [[nodiscard]] std::vector<double> narrow_widths(const Surface& at,
                                                    const Progress& cancel) const {
        const SurfaceDistance wall(at);
        const Positions normals = vertex_normals(at);
        std::vector<double> widths(movable_.size(), 0.0);
        tbb::parallel_for(std::size_t{0}, widths.size(), [&](std::size_t v) {
            if (!movable_[v]) return;
            cancel.check_cancelled();
            widths[v] = narrow_width(wall, at.points()[v], -normals[v]);
        });
        return widths;
    }

    /// How far each vertex has to move outward: half of what is missing, fading out around. #V [mm]
    [[nodiscard]] std::vector<double> pushes(const std::vector<double>& widths) const {
        const double most = 0.5 * width_;
        std::vector<double> left(widths.size(), most);  // a push is what is missing of the most
        ShortestPaths paths(left);
        for (VertexId v = 0; v < widths.size(); ++v)
            if (widths[v] > 0.0) paths.lower(v, 0.5 * widths[v]);
        const CompressedRows& rings = surface_.topology->rings();
        const Positions& points = surface_.points();
        while (const auto at = paths.next())
            for (const VertexId u : rings.row(at->vertex))
                paths.lower(u, at->distance + kFade * (points[u] - points[at->vertex]).norm());
        for (std::size_t v = 0; v < left.size(); ++v) left[v] = movable_[v] ? most - left[v] : 0.0;
        return left;
    }

    /// Neighbouring narrow vertices are one place.
    [[nodiscard]] std::vector<NarrowPlace> places(const std::vector<double>& widths) const {
        std::vector<NarrowPlace> places;
        for (const VertexId v : narrowest_of_each(widths))
            places.push_back({surface_.points()[v], widths[v]});
        std::ranges::stable_sort(places, {}, &NarrowPlace::width);
        return places;
    }

private:
    /// 0: the lumen is wide enough.
    [[nodiscard]] double narrow_width(const SurfaceDistance& wall, const Vec3& at,
                                      const Vec3& inward) const {
        const double skin = 1e-6 * width_;
        if (inward.squaredNorm() == 0.0) return 0.0;
        const auto opposite = wall.first_hit(at + skin * inward, inward, width_);
        // The corner between wall and cap is no narrow lumen.
        if (!opposite || surface_.patch_of(opposite->triangle).kind != PatchKind::Wall) return 0.0;
        // Where a thread widens, slanted rays are long; where its wall is slanted, the straight
        // one.
        const double straight = opposite->distance + skin;
        const double across =
            std::min(straight, lumen_width(wall, at, inward, 8.0 * width_).value_or(straight));
        return across < kWideEnough * width_ ? across : 0.0;
    }

    [[nodiscard]] std::vector<VertexId> narrowest_of_each(const std::vector<double>& widths) const {
        DisjointSets sets(widths.size());
        const CompressedRows& rings = surface_.topology->rings();
        for (VertexId v = 0; v < widths.size(); ++v)
            if (widths[v] > 0.0)
                for (const VertexId u : rings.row(v))
                    if (widths[u] > 0.0) sets.join(u, v);
        std::vector<std::optional<VertexId>> narrowest(widths.size());
        for (VertexId v = 0; v < widths.size(); ++v) {
            if (widths[v] <= 0.0) continue;
            auto& best = narrowest[sets.root(v)];
            if (!best || widths[v] < widths[*best]) best = v;
        }
        std::vector<VertexId> result;
        for (const auto& best : narrowest)
            if (best) result.push_back(*best);
        return result;
    }

    const Surface& surface_;
    double width_;
    std::vector<std::uint8_t> movable_;
};

bool any_narrow(const std::vector<double>& widths) {
    return std::ranges::any_of(widths, [](double width) { return width > 0.0; });
}

void check_width(const Surface& surface, double width) {
    require_positive("width", width);
    require_in_proportion("width", width, surface, 1.0);
}

}  // namespace

std::vector<NarrowPlace> narrow_places(const Surface& surface, double width,
                                       const Progress& progress) {
    check_width(surface, width);
    const Widening widening(surface, width);
    return widening.places(widening.narrow_widths(surface, progress));
}

Positions widen(const Surface& surface, double width, const Progress& progress) {
    check_width(surface, width);
    const Widening widening(surface, width);
    Surface now = surface;
    std::vector<double> widths = widening.narrow_widths(surface, progress);
    std::vector<double> pushed(widths.size(), 0.0);  // never more than a thread of no width needs
    for (int pass = 0; pass < kPasses && any_narrow(widths); ++pass) {
        progress.report(static_cast<double>(pass) / kPasses, "widening");
        const std::vector<double> pushes = widening.pushes(widths);
        const Positions normals = vertex_normals(now);
        Positions moved = now.points();
        for (std::size_t v = 0; v < moved.size(); ++v) {
            const double push = std::min(pushes[v], 0.5 * width - pushed[v]);
            moved[v] += push * normals[v];
            pushed[v] += push;
        }
        now = now.with_positions(std::move(moved));
        widths = widening.narrow_widths(now, progress);
    }
    return now.points();
}

}  // namespace vesselbench
