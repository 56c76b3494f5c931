// Stamps tools at random places of random vessels, and prints what became of each as one JSON line:
// bench_stamp placements FIRST LAST; or times stamps on a surface of 100,000 triangles: bench_stamp
// times.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <numbers>
#include <random>
#include <set>
#include <string>

#include <nlohmann/json.hpp>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/self_intersections.h"
#include "meshing/remeshing/remesh.h"
#include "meshing/stamp/contact.h"
#include "meshing/stamp/stamp.h"
#include "tests/support/touching_vessels.h"

using namespace vesselbench;
using namespace vesselbench::test;

namespace {

using Json = nlohmann::ordered_json;
using Random = std::mt19937;

double between(Random& random, double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
}

Vec3 direction(Random& random) {
    std::normal_distribution<double> normal;
    return Vec3(normal(random), normal(random), normal(random)).normalized();
}

/// Two vessels that cross beside each other, and a bridge between them.
struct Vessels {
    double radius = 2.0, bridge = 1.0;  ///< [mm]
    Surface surface;
    Vec3 on_bridge = Vec3::Zero();  ///< [mm]
};

Vessels vessels(Random& random, double cell) {
    Vessels made;
    made.radius = between(random, 1.5, 2.5);
    const double other = between(random, 0.6, 1.0) * made.radius;
    made.bridge = between(random, 0.2, 0.6) * other;
    const double gap = between(random, 0.2, 0.8), angle = between(random, 0.3, 1.5);
    const double low = -0.5 * gap - made.radius, high = 0.5 * gap + other;
    const Vec3 across(9.0 * std::cos(angle), 9.0 * std::sin(angle), 0.0);
    const Vec3 bent(between(random, -1.0, 1.0), between(random, -1.0, 1.0), 0.0);
    made.surface = solid_of(
        [&](const Vec3& p) {
            const Vec3 q = p - 0.02 * p.squaredNorm() * bent * 0.2;
            return std::min({capsule(q, {-9, 0, low}, {9, 0, low}, made.radius),
                             capsule(q, Vec3(-across.x(), -across.y(), high),
                                     Vec3(across.x(), across.y(), high), other),
                             capsule(q, {0, 0, 0.5 * low}, {0, 0, 0.5 * high}, made.bridge)});
        },
        Eigen::AlignedBox3d(Vec3(-13, -13, -7), Vec3(13, 13, 7)), cell);
    made.on_bridge = Vec3(made.bridge, 0, 0);
    return made;
}

struct Placement {
    std::string kind;
    ToolBody tool;
    StampParameters parameters;
};

/// A tool at a random place of the wall, cut into it by a random depth.
Placement random_placement(Random& random, const Vessels& vessels) {
    const Surface& surface = vessels.surface;
    std::uniform_int_distribution<std::size_t> pick(0, surface.triangle_count() - 1);
    const Triangle& t = surface.triangles()[pick(random)];
    const Vec3 at = surface.points()[t[0]];
    const Vec3 out = area_normal(surface.points(), t).normalized();
    const Vec3 leaning = (out + 0.8 * direction(random)).normalized();
    const double size = between(random, 0.3, 0.9) * vessels.radius;
    const Vec3 centre = at + between(random, -0.4, 0.4) * size * out;
    Placement placed;
    placed.parameters = {
        .mode = between(random, 0.0, 1.0) < 0.5 ? StampMode::Subtract : StampMode::Add,
        .blend = between(random, 0.0, 0.5) * size};
    const double kind = between(random, 0.0, 3.0);
    if (kind < 1.0) {
        placed.kind = "box";
        placed.tool = box_body({.centre = centre,
                                .direction = leaning,
                                .along = out.unitOrthogonal(),
                                .thickness = between(random, 0.5, 1.5) * size,
                                .length = between(random, 0.7, 2.0) * size,
                                .width = between(random, 0.7, 2.0) * size});
    } else if (kind < 2.0) {
        placed.kind = "capsule";
        placed.tool = capsule_body({.centre = centre,
                                    .direction = leaning,
                                    .length = between(random, 0.0, 2.0) * size,
                                    .radius = 0.5 * size});
    } else {
        placed.kind = "polygon";
        const Vec3 along = out.cross(direction(random)).normalized();
        const Positions path = {centre - 1.5 * size * along, centre + 0.2 * size * out,
                                centre + 1.5 * size * (along + 0.3 * out.cross(along))};
        placed.tool = swept_body({.path = path,
                                  .sides = std::uniform_int_distribution<std::size_t>(3, 8)(random),
                                  .radius = 0.4 * size});
    }
    return placed;
}

/// The vessels have no waist at the bridge, as far as it can be seen.
struct NoContact {};

Placement separation(const Vessels& vessels) {
    const auto contact =
        contact_at(vessels.surface, SurfaceDistance(vessels.surface), vessels.on_bridge);
    if (!contact) throw NoContact();
    const double thickness = 0.5 * contact->width;
    return {"separation",
            box_body({.centre = contact->centre,
                      .direction = contact->direction,
                      .along = contact->along,
                      .thickness = thickness,
                      .length = 1.3 * contact->length + thickness,
                      .width = 1.3 * contact->width + thickness}),
            {.mode = StampMode::Subtract, .blend = 0.25 * thickness}};
}

struct ByPlace {
    bool operator()(const Vec3& a, const Vec3& b) const {
        return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
    }
};

bool keeps_bits(const Surface& before, const Stamped& after, const ToolBody& tool) {
    const std::set<Vec3, ByPlace> places(after.surface.points().begin(),
                                         after.surface.points().end());
    const SurfaceDistance body(tool.surface);
    return std::ranges::none_of(before.points(), [&](const Vec3& p) {
        return body.signed_distance(p) > after.report.influence && !places.contains(p);
    });
}

Json outcome_of(const Vessels& vessels, const Placement& placed) {
    Json line = {{"kind", placed.kind},
                 {"mode", placed.parameters.mode == StampMode::Add ? "add" : "subtract"},
                 {"triangles", vessels.surface.triangle_count()}};
    const SurfaceDistance places(vessels.surface);
    const std::clock_t start = std::clock();
    try {
        const Stamped after = stamp(vessels.surface, places, placed.tool, placed.parameters);
        line["cpu_seconds"] = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
        const Connectivity parts = connectivity(*after.surface.topology);
        line["sound"] = parts.closed && parts.manifold && parts.oriented &&
                        self_intersections(after.surface).empty();
        line["bits_kept"] = keeps_bits(vessels.surface, after, placed.tool);
        line["components"] = {after.report.components_before, after.report.components_after};
        line["genus"] = {after.report.genus_before, after.report.genus_after};
        line["volume_change_mm3"] = after.report.volume_change;
    } catch (const DiagnosedFailure& failure) {
        line["refused"] = failure.diagnostics().front().code;
    } catch (const std::exception& failure) {
        line["error"] = failure.what();
    }
    return line;
}

void print_placements(unsigned first, unsigned last) {
    for (unsigned seed = first; seed <= last; ++seed) {
        Random random(seed);
        Vessels made = vessels(random, 0.3);
        if (seed % 2 == 0) made.surface = remesh(made.surface, {.edge = 0.4}).surface;
        Json line = {{"seed", seed}};
        try {
            line.update(
                outcome_of(made, seed % 4 < 2 ? separation(made) : random_placement(random, made)));
        } catch (const NoContact&) {
            line["refused"] = "no-contact";
        }
        std::puts(line.dump().c_str());
        std::fflush(stdout);
    }
}

void print_times() {
    for (unsigned seed = 1; seed <= 5; ++seed) {
        Random random(seed);
        const Vessels made = vessels(random, 0.13);
        for (const Placement& placed : {separation(made), random_placement(random, made)})
            std::puts(outcome_of(made, placed).dump().c_str());
        std::fflush(stdout);
    }
}

}  // namespace

int main(int count, char** arguments) {
    const std::string what = count > 1 ? arguments[1] : "";
    if (what == "placements" && count == 4)
        print_placements(static_cast<unsigned>(std::atoi(arguments[2])),
                         static_cast<unsigned>(std::atoi(arguments[3])));
    else if (what == "times")
        print_times();
    else
        return std::fputs("bench_stamp placements FIRST LAST | bench_stamp times\n", stderr), 2;
}
