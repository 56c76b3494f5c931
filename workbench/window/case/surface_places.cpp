#include "workbench/window/case/surface_places.h"

#include <algorithm>

#include "geometry/kernel/errors.h"
#include "geometry/vessel/centerlines/branch_queries.h"
#include "geometry/vessel/centerlines/centerlines.h"
#include "geometry/vessel/centerlines/tip_name.h"
#include "workbench/case/measure_json.h"
#include "workbench/window/case/readable.h"

namespace vesselbench {

namespace {

/// A click within this many radii of a vessel end means the end.
constexpr double kReach = 2.0;

std::vector<NamedPlace> tips_of(const Surface& surface, const Progress& progress) {
    const auto graph = centerlines_of(surface, {}, progress);
    std::vector<NamedPlace> tips;
    for (const std::size_t tip : tips_by_radius(*graph)) {
        tips.push_back({.point = graph->nodes[tip].position,
                        .name = tip_name(*graph, tip),
                        .reach = kReach * tip_radius(*graph, tip)});
    }
    return tips;
}

double reach_of(const PatchMeasures& opening) {
    return kReach * diameter_of_area(opening.area) / 2;
}

}  // namespace

SurfacePlaces places_of(const Surface& surface, bool tips, const Progress& progress) {
    SurfacePlaces places{.openings = measure_patches(surface)};
    std::erase_if(places.openings,
                  [](const PatchMeasures& patch) { return patch.kind == PatchKind::Wall; });
    if (!tips) return places;
    try {
        places.tips = tips_of(surface, progress);
    } catch (const Cancelled&) {
        throw;
    } catch (const std::exception& error) {
        places.problem = error.what();
    }
    return places;
}

std::string opening_text(const PatchMeasures& opening) {
    return opening.name + ": diameter " + readable_number(diameter_of_area(opening.area)) +
           " mm, area " + readable_number(opening.area) + " mm\u00B2";
}

std::vector<NamedPlace> openings_and_tips(const SurfacePlaces& places) {
    std::vector<NamedPlace> all;
    for (const PatchMeasures& opening : places.openings)
        all.push_back({opening.centroid, opening_text(opening), reach_of(opening)});
    const std::vector<NamedPlace> open = all;
    for (const NamedPlace& tip : places.tips)
        if (std::ranges::none_of(open, [&](const NamedPlace& opening) {
                return (opening.point - tip.point).norm() < opening.reach;
            }))
            all.push_back(tip);
    return all;
}

const PatchMeasures* opening_of(const SurfacePlaces& places, std::size_t label) {
    const auto found = std::ranges::find(places.openings, label, &PatchMeasures::row);
    return found == places.openings.end() ? nullptr : &*found;
}

std::optional<PickSpot> pick_spot(const std::vector<NamedPlace>& offered,
                                  const std::optional<Vec3>& hit, std::optional<std::size_t> near) {
    if (near) return PickSpot{offered.at(*near).point, near};
    if (!hit) return std::nullopt;
    PickSpot spot{*hit, std::nullopt};
    double least = 1.0;  // of the distance in reaches
    for (std::size_t i = 0; i < offered.size(); ++i) {
        const double share = (offered[i].point - *hit).norm() / offered[i].reach;
        if (share >= least) continue;
        least = share;
        spot = {offered[i].point, i};
    }
    return spot;
}

}  // namespace vesselbench
