// Times a dab of a brush on a large surface as the window draws it: the stroke's step, the new
// scene, the search for what changed, and the upload of the moved vertices. Prints a row each, as
// CPU time of the thread and as ratio to the 10 ms that a dab may take.
//   bench_dab [TRIANGLES]     default: 1000000

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <numbers>
#include <vector>

#include <time.h>

#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "gpu/context.h"
#include "gpu/render/drawn_surface.h"
#include "workbench/operations/brush/dabs.h"
#include "workbench/operations/table.h"
#include "workbench/session/surface_change.h"
#include "workbench/window/case/live_stroke.h"

namespace vesselbench::bench {

namespace {

constexpr double kGoal = 10.0;      // [ms]
constexpr double kVertices = 5000;  // that a dab moves at most
constexpr int kDabs = 40;

double cpu_milliseconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

/// Times of one part of the work.
struct Part {
    const char* name;
    std::vector<double> times = {};  // [ms]

    void time(const std::function<void()>& work) {
        const double start = cpu_milliseconds();
        work();
        times.push_back(cpu_milliseconds() - start);
    }

    [[nodiscard]] double median() const {
        std::vector<double> sorted = times;
        std::ranges::sort(sorted);
        return sorted.at(sorted.size() / 2);
    }
};

/// An open tube of 4 mm radius and 30 mm length with about so many triangles of equal sides.
Surface tube(double triangles) {
    constexpr double kRadius = 4.0, kLength = 30.0;
    const double round = 2.0 * std::numbers::pi * kRadius;
    const auto around = static_cast<VertexId>(std::sqrt(triangles / 2.0 * round / kLength));
    const auto along = static_cast<VertexId>(triangles / 2.0 / around);
    Positions points;
    std::vector<Triangle> list;
    for (VertexId j = 0; j <= along; ++j)
        for (VertexId i = 0; i < around; ++i) {
            const double angle = 2.0 * std::numbers::pi * i / around;
            points.emplace_back(kRadius * std::cos(angle), kRadius * std::sin(angle),
                                kLength * j / along);
            if (j == along) continue;
            const VertexId a = j * around + i, b = j * around + (i + 1) % around;
            list.push_back({a, b, b + around});
            list.push_back({a, b + around, a + around});
        }
    return make_surface(std::move(points), std::move(list));
}

Records dab_at(double z, double radius) {
    const Dab dab{.anchor = {.point = {0, -4, z}, .normal = {0, -1, 0}, .radius = 4},
                  .radius = radius,
                  .strength = 0.5,
                  .falloff = 1.0};
    return listed({&dab, 1});
}

void print(const Part& part) {
    std::printf("  %-44s %7.2f ms\n", part.name, part.median());
}

void run(double triangles) {
    const OffscreenContext context;
    Scene scene;
    scene.surface = tube(triangles);
    const Surface& surface = *scene.surface;
    DrawnSurface drawn(prepare_drawing(surface));
    const double share = kVertices / static_cast<double>(surface.vertex_count());
    const double radius = 0.95 * std::sqrt(share * area(surface) / std::numbers::pi);
    Progress progress;
    const Operation& brush = find_operation("brush-inflate");
    const auto live = brush.start(scene, checked_arguments(brush, {}), progress);
    Part step{"stroke's step"}, next{"new scene"}, search{"search for what changed"},
        upload{"normals and upload"};
    std::size_t moved = 0;
    for (int dab = 0; dab < kDabs; ++dab) {
        SceneMove move{.before = live->scene()};
        const Arguments more = {{"dabs", dab_at(10.0 + 0.25 * dab * radius, radius)}};
        step.time([&] { live->add(more, progress); });
        next.time([&] { move.after = live->scene(); });
        search.time([&] {
            move.changed = changed_vertices(surface_of(move.before), surface_of(move.after));
        });
        upload.time([&] { drawn.move(surface_of(move.after).points(), move.changed); });
        moved = std::max(moved, move.changed.size());
    }
    std::printf("a dab that moves up to %zu vertices of %zu triangles\n", moved,
                surface.triangle_count());
    double sum = 0.0;
    for (const Part* part : {&step, &next, &search, &upload}) {
        print(*part);
        sum += part->median();
    }
    std::printf("  %-44s %7.2f ms   ratio to %g ms: %.2f\n", "together", sum, kGoal, sum / kGoal);
}

}  // namespace

}  // namespace vesselbench::bench

int main(int count, char** words) {
    try {
        vesselbench::bench::run(count > 1 ? std::atof(words[1]) : 1e6);
    } catch (const vesselbench::GpuUnavailable& error) {
        std::printf("dab skipped: %s\n", error.what());
    }
    return 0;
}
