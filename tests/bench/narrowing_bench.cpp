// Narrowings of random vessel trees with known lumens: found, judged by the image, and corrected.
// Run by scripts/repairs_narrowing.py; prints one JSON object a line.
//   bench_narrowing dip|stenosis|clean FIRST LAST [baseline]
// FIRST and LAST are seeds; baseline measures what there is without correct-narrowing.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "geometry/kernel/stopwatch.h"
#include "geometry/vessel/centerlines/centerlines.h"
#include "geometry/vessel/narrowing/correct_narrowing.h"
#include "geometry/vessel/narrowing/image_evidence.h"
#include "geometry/vessel/narrowing/narrowing.h"
#include "geometry/vessel/repair/widen.h"
#include "tests/bench/narrowing_phantoms.h"

namespace vesselbench::bench {

namespace {

using Json = nlohmann::ordered_json;

const Narrowing* found_at(const std::vector<Narrowing>& all, const PlantedNarrowing& planted) {
    for (const Narrowing& narrowing : all)
        if ((narrowing.place - planted.centre).norm() < planted.reach + 0.5 * planted.radius)
            return &narrowing;
    return nullptr;
}

Json evidence_json(const NarrowingPhantom& phantom, const Surface& raw,
                   const CenterlineGraph& graph, const Narrowing& narrowing) {
    const auto rings = wall_rings(raw, graph, narrowing.branch);
    const auto evidence = image_evidence(phantom.image, rings, narrowing);
    if (!evidence) return nullptr;
    return {{"verdict", to_string(evidence->verdict)},
            {"core_contrast", evidence->core_contrast},
            {"integral", evidence->integral},
            {"edge", (evidence->edge_radius - narrowing.found_radius) / narrowing.depth()},
            {"lumen", (evidence->lumen_radius - narrowing.found_radius) / narrowing.depth()},
            {"lumen_contrast", evidence->lumen_contrast},
            {"misfit_falls", evidence->misfit_falls},
            {"misfit_agrees", evidence->misfit_agrees}};
}

Json corrected_json(const NarrowingPhantom& phantom, const Surface& raw,
                    const CenterlineGraph& graph, const Narrowing& narrowing,
                    const PlantedNarrowing& planted) {
    Json json;
    json["raw_error_mm"] = phantom.radius_error(raw, planted);
    try {
        const auto rings = wall_rings(raw, graph, narrowing.branch);
        const CorrectedNarrowing corrected = correct_narrowing(raw, graph, rings, narrowing);
        json["corrected_error_mm"] = phantom.radius_error(corrected.surface, planted);
        json["moved"] = corrected.moved;
        json["outside_moved"] = phantom.moved_outside(raw, corrected.surface, planted);
    } catch (const std::exception& error) {
        json["refused"] = error.what();
    }
    return json;
}

Json planted_json(const NarrowingPhantom& phantom, const Surface& raw, const CenterlineGraph& graph,
                  const std::vector<Narrowing>& found, const PlantedNarrowing& planted) {
    const double share = phantom.share(raw, planted);
    Json json{{"radius_voxels", planted.radius / phantom.voxel},
              {"share", share},
              {"depth_voxels", share * planted.radius / phantom.voxel},
              {"reach_diameters", 0.5 * planted.reach / planted.radius}};
    const Narrowing* narrowing = found_at(found, planted);
    json["found"] = narrowing != nullptr;
    if (narrowing == nullptr) return json;
    json["found_share"] = narrowing->share();
    json["certainty"] = narrowing->certainty;
    json["image"] = evidence_json(phantom, raw, graph, *narrowing);
    json["correction"] = corrected_json(phantom, raw, graph, *narrowing, planted);
    return json;
}

/// Of each place: how narrow local levels leave it, and whether `widen` would call it narrow.
Json baseline(PhantomFault fault, std::uint64_t seed) {
    const NarrowingPhantom phantom(fault, seed);
    const Surface raw = phantom.surface(), local = phantom.local_surface();
    const auto called = narrow_places(raw, 0.5 * phantom.voxel);
    Json json{{"seed", seed}, {"fault", to_string(fault)}, {"places", Json::array()}};
    for (const PlantedNarrowing& planted : phantom.planted) {
        const double share = phantom.share(raw, planted);
        json["places"].push_back(
            {{"share", share},
             {"depth_voxels", share * planted.radius / phantom.voxel},
             {"local_share", phantom.share(local, planted)},
             {"raw_error_mm", phantom.radius_error(raw, planted)},
             {"local_error_mm", phantom.radius_error(local, planted)},
             {"called", std::ranges::any_of(called, [&](const NarrowPlace& place) {
                  return (place.place - planted.centre).norm() < planted.reach + planted.radius;
              })}});
    }
    return json;
}

Json measured(PhantomFault fault, std::uint64_t seed) {
    const Stopwatch watch;
    const NarrowingPhantom phantom(fault, seed);
    const Surface raw = phantom.surface();
    const double made = watch.seconds();
    const auto graph = centerlines_of(raw);
    const Stopwatch search;
    const auto found = find_narrowings(raw, *graph, {.resolution = phantom.voxel});
    Json json{{"seed", seed},
              {"fault", to_string(fault)},
              {"voxels", phantom.image.voxel_count()},
              {"triangles", raw.triangle_count()},
              {"branches", graph->branches.size()},
              {"made_s", made},
              {"find_s", search.seconds()}};
    json["planted"] = Json::array();
    json["others"] = Json::array();
    for (const PlantedNarrowing& planted : phantom.planted)
        json["planted"].push_back(planted_json(phantom, raw, *graph, found, planted));
    for (const Narrowing& narrowing : found) {
        const bool known = std::ranges::any_of(phantom.planted, [&](const PlantedNarrowing& p) {
            return found_at({narrowing}, p) != nullptr;
        });
        if (!known)
            json["others"].push_back(
                {{"share", narrowing.share()},
                 {"certainty", narrowing.certainty},
                 {"radius_mm", narrowing.expected_radius},
                 {"length_mm", narrowing.to - narrowing.from},
                 {"place", {narrowing.place.x(), narrowing.place.y(), narrowing.place.z()}}});
    }
    return json;
}

int run(const std::string& fault, std::uint64_t first, std::uint64_t last, bool before) {
    for (std::uint64_t seed = first; seed <= last; ++seed) {
        Json json{{"seed", seed}, {"fault", fault}};
        try {
            const PhantomFault kind = fault_from(fault);
            json = before ? baseline(kind, seed) : measured(kind, seed);
        } catch (const std::exception& error) {
            json["error"] = error.what();
        }
        std::printf("%s\n", json.dump().c_str());
        std::fflush(stdout);
    }
    return 0;
}

}  // namespace

}  // namespace vesselbench::bench

int main(int argc, char** argv) {
    const bool baseline = argc == 5 && std::string(argv[4]) == "baseline";
    if (argc != 4 && !baseline) {
        std::fprintf(stderr, "bench_narrowing dip|stenosis|clean FIRST LAST [baseline]\n");
        return 2;
    }
    return vesselbench::bench::run(argv[1], std::strtoull(argv[2], nullptr, 10),
                                   std::strtoull(argv[3], nullptr, 10), baseline);
}
