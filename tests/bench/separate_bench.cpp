// Separates vessels that touch in phantoms whose truth is known, and prints what became of each as
// one JSON line: bench_separate FIRST LAST; with a slab at the contact instead:
// bench_separate stamp FIRST LAST. With VESSELBENCH_DUMP=FOLDER, the surfaces before and after are
// written there.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <set>
#include <string>

#include <nlohmann/json.hpp>

#include "geometry/formats/surface_file.h"
#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/self_intersections.h"
#include "meshing/stamp/contact.h"
#include "meshing/stamp/separate.h"
#include "meshing/stamp/stamp.h"
#include "tests/bench/touching_phantoms.h"

using namespace vesselbench;
using namespace vesselbench::bench;

namespace {

using Json = nlohmann::ordered_json;

struct ByPlace {
    bool operator()(const Vec3& a, const Vec3& b) const {
        return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
    }
};

void dump(const TouchingPhantom& phantom, const Surface& surface, const char* when) {
    if (const char* folder = std::getenv("VESSELBENCH_DUMP"))
        write_surface(surface, std::string(folder) + "/" + std::to_string(phantom.seed) + when);
}

using Places = std::set<Vec3, ByPlace>;

Places places_of(const Surface& surface) {
    return {surface.points().begin(), surface.points().end()};
}

/// What a result is, whoever made it.
Json facts(const TouchingPhantom& phantom, const Surface& before, const Surface& after) {
    const Connectivity was = connectivity(*before.topology), is = connectivity(*after.topology);
    const Places old = places_of(before);
    double error = 0.0;
    for (const Vec3& p : after.points())
        if (!old.contains(p)) error = std::max(error, phantom.error(p) / phantom.voxel);
    return {{"sound", is.closed && is.manifold && is.oriented && self_intersections(after).empty()},
            {"components", {was.components, is.components}},
            {"genus", {was.genus.value_or(-1), is.genus.value_or(-1)}},
            {"right", is.components == (phantom.ring ? 1U : 2U) && is.genus.value_or(-1) == 0},
            {"error_voxels", error}};
}

Json stamped(const TouchingPhantom& phantom, const Surface& before) {
    const SurfaceDistance places(before);
    const auto contact = contact_at(before, places, phantom.place(before));
    if (!contact) return {{"refused", "no-contact"}};
    const double thickness = 0.25 * contact->width;
    const Stamped after = stamp(before, places,
                                box_body({.centre = contact->centre,
                                          .direction = contact->direction,
                                          .along = contact->along,
                                          .thickness = thickness,
                                          .length = 1.3 * contact->length + thickness,
                                          .width = 1.3 * contact->width + thickness}),
                                {.mode = StampMode::Subtract, .blend = 0.25 * thickness});
    return facts(phantom, before, after.surface);
}

/// Whether what lies outside the stated ball is as it was.
bool keeps_bits(const Surface& before, const Separated& after) {
    const Places places = places_of(after.surface);
    return std::ranges::none_of(before.points(), [&](const Vec3& p) {
        return (p - after.report.centre).norm() > after.report.influence && !places.contains(p);
    });
}

Json separated(const TouchingPhantom& phantom, const Surface& before) {
    const SurfaceDistance places(before);
    const Separated after =
        separate(before, places, {.at = phantom.place(before), .gap = phantom.voxel});
    dump(phantom, after.surface, "_after.ply");
    Json line = facts(phantom, before, after.surface);
    line["bits_kept"] = keeps_bits(before, after);
    line["gap_voxels"] = after.report.gap / phantom.voxel;
    line["found_waist"] = after.report.waist;
    line["farthest_voxels"] = after.report.farthest / phantom.voxel;
    line["influence_mm"] = after.report.influence;
    return line;
}

Json line_of(unsigned seed, const TouchingPhantom& phantom, bool by_stamp) {
    const Surface before = phantom.surface();
    dump(phantom, before, "_before.ply");
    const double waist = phantom.waist(before);
    Json line = {{"seed", seed},
                 {"waist", waist},
                 {"diameters", phantom.length / (2.0 * phantom.thinner)},
                 {"ring", phantom.ring},
                 {"triangles", before.triangle_count()}};
    if (waist == 0.0) return line;
    const std::clock_t start = std::clock();
    try {
        line.update(by_stamp ? stamped(phantom, before) : separated(phantom, before));
    } catch (const DiagnosedFailure& failure) {
        line["refused"] = failure.diagnostics().front().code;
        for (const auto& [name, value] : failure.diagnostics().front().figures) line[name] = value;
    } catch (const std::exception& failure) {
        line["error"] = failure.what();
    }
    line["cpu_seconds"] = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    return line;
}

}  // namespace

int main(int count, char** arguments) {
    const bool by_stamp = count == 4 && std::string(arguments[1]) == "stamp";
    if (count != (by_stamp ? 4 : 3))
        return std::fputs("bench_separate [stamp] FIRST LAST\n", stderr), 2;
    const int first = std::atoi(arguments[count - 2]), last = std::atoi(arguments[count - 1]);
    for (int seed = first; seed <= last; ++seed) {
        const TouchingPhantom phantom(static_cast<std::uint64_t>(seed));
        std::puts(line_of(static_cast<unsigned>(seed), phantom, by_stamp).dump().c_str());
        std::fflush(stdout);
    }
}
