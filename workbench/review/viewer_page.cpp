#include "workbench/review/viewer_page.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "geometry/kernel/edges.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/measure.h"
#include "geometry/kernel/surface_distance.h"
#include "geometry/kernel/surface_gap.h"
#include "workbench/case/point_json.h"
#include "workbench/case/version.h"
#include "workbench/project/utc_time.h"
#include "workbench/review/page_file.h"
#include "workbench/review/page_geometry.h"
#include "workbench/review/page_slices.h"
#include "workbench/review/review_page_bytes.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

/// More components than this are debris rather than vessels: they stay one structure.
constexpr std::size_t kMostComponents = 8;
/// Shares of the measure's range begin here; 0 is a vertex without a value.
constexpr double kFirstShare = 0.001;
constexpr const char* kShares = "shares";

struct Structure {
    std::string name;
    Surface surface;
    bool neighbour = false;
};

/// The values as shares of the scale's range, from kFirstShare to 1; 0: none.
std::vector<double> shares_of(const ShownMeasure& measure) {
    const double range = measure.scale.most - measure.scale.least;
    std::vector<double> shares;
    for (const double value : measure.values)
        shares.push_back(std::isfinite(value)
                             ? kFirstShare +
                                   (1.0 - kFirstShare) *
                                       std::clamp((value - measure.scale.least) / range, 0.0, 1.0)
                             : 0.0);
    return shares;
}

/// The surface with the measure's shares, so that parts of it keep theirs.
Surface with_shares(Surface surface, const std::optional<ShownMeasure>& measure) {
    surface.attributes.clear();
    if (measure)
        surface.attributes[kShares] =
            std::make_shared<const std::vector<double>>(shares_of(*measure));
    return surface;
}

std::vector<Structure> structures_of(const Scene& scene, const Surface& surface) {
    std::vector<Structure> structures;
    const Components components = connected_components(*surface.topology);
    if (components.count() < 2 || components.count() > kMostComponents) {
        structures.push_back({"vessel", surface});
    } else {
        for (std::size_t k = 0; k < components.count(); ++k) {
            std::vector<bool> own;
            for (const std::uint32_t component : components.of_triangle)
                own.push_back(component == k);
            structures.push_back({"", select_triangles(surface, own)});
        }
        std::ranges::stable_sort(structures, std::ranges::greater{},
                                 [](const Structure& one) { return one.surface.triangle_count(); });
        for (std::size_t k = 0; k < structures.size(); ++k)
            structures[k].name = "vessel " + std::to_string(k + 1);
    }
    for (const auto& [name, neighbour] : scene.neighbours)
        if (!neighbour.empty()) structures.push_back({name, neighbour, true});
    return structures;
}

Bounds box_of(const std::vector<Structure>& structures) {
    Positions corners;
    for (const Structure& structure : structures) {
        const Bounds box = bounds(structure.surface);
        corners.insert(corners.end(), {box.min, box.max});
    }
    return bounds(corners);
}

Json colour_json(const ShownMeasure& measure) {
    return {{"name", measure.name},       {"label", measure.label},
            {"unit", measure.unit},       {"least", measure.scale.least},
            {"most", measure.scale.most}, {"colours", legend_colours(measure.scale)},
            {"values", Json::array()}};
}

/// The smallest distance of every two structures.
Json distances_json(const std::vector<Structure>& structures, const Progress& progress) {
    Json list = Json::array();
    const std::size_t pairs = structures.size() * (structures.size() - 1) / 2;
    for (std::size_t b = 1; b < structures.size(); ++b)
        for (std::size_t a = 0; a < b; ++a) {
            progress.report(static_cast<double>(list.size()) / static_cast<double>(pairs),
                            "Measuring distances between structures");
            const SurfaceGap gap = smallest_gap(structures[a].surface, structures[b].surface);
            list.push_back({{"between", {a, b}},
                            {"from", point_json(gap.from)},
                            {"to", point_json(gap.to)},
                            {"mm", gap.distance}});
        }
    return list;
}

/// The middle of the surface, or its point nearest to it if that lies outside; and how far all of
/// the surface reaches from there along the axes [mm].
std::pair<Vec3, double> place_and_reach(const Surface& surface) {
    constexpr double kRoom = 1.1;  // around the surface
    const Bounds box = bounds(surface);
    const SurfaceDistance distance = distance_to(surface);
    const Vec3 middle = box.centre();
    const Vec3 place = distance.inside(middle) ? middle : distance.closest_point(middle).point;
    return {place, kRoom * (place - box.min).cwiseMax(box.max - place).maxCoeff()};
}

/// \return the slices' blobs; empty: there is no image
std::map<std::string, std::string> add_slices(const Scene& scene, Json& manifest) {
    if (!scene.image) return {};
    const auto [place, reach] = place_and_reach(*scene.surface);
    PageSlices slices(*scene.image);
    manifest["slices"] = slices.add("model", place, reach);
    manifest["slices_place"] = point_json(place);
    return slices.blobs();
}

Json manifest_of(const ViewerContents& contents, const Scene& scene) {
    return {{"format", "vesselbench-viewer"},
            {"version", 1},
            {"program", version()},
            {"written", utc_now()},
            {"title", contents.title},
            {"text", contents.text},
            {"purpose", contents.purpose},
            {"units", "mm"},
            {"source", {{"patient", scene.image.has_value()}}},
            {"holds", {"surface"}}};
}

/// Adds the structures' surfaces, and the measure where they have it.
void add_structures(const std::vector<Structure>& structures, const ViewerContents& contents,
                    PageGeometry& geometry, Json& manifest, const Progress& progress) {
    if (contents.colour) {
        manifest["colour"] = colour_json(*contents.colour);
        manifest["holds"].push_back("vertex measure");
    }
    Json list = Json::array();
    for (const Structure& structure : structures) {
        progress.report(static_cast<double>(list.size()) / static_cast<double>(structures.size()),
                        "Packing structures");
        const PageGeometry::State state = geometry.add(structure.surface);
        list.push_back({{"name", structure.name},
                        {"kind", structure.neighbour ? "neighbour" : "vessel"},
                        {"state", state.number}});
        if (!contents.colour || structure.neighbour) continue;
        const Json values = geometry.add_values(state, *structure.surface.attributes.at(kShares));
        manifest["colour"]["values"].push_back(
            {{"state", state.number}, {"blob", values["blob"]}, {"max", values["max_mm"]}});
    }
    if (structures.back().neighbour) manifest["holds"].push_back("neighbours");
    manifest["structures"] = list;
}

}  // namespace

std::string viewer_page(const Scene& scene, const ViewerContents& contents,
                        const Progress& progress) {
    require_page(viewer_page_bytes());
    progress.report(0.0, "Packing structures");
    if (contents.colour && contents.colour->values.size() != surface_of(scene).vertex_count())
        throw InvalidInput(
            "the page's measure has another number of values than the surface has "
            "vertices");
    const std::vector<Structure> structures =
        structures_of(scene, with_shares(surface_of(scene), contents.colour));
    PageGeometry geometry(box_of(structures));
    Json manifest = manifest_of(contents, scene);
    if (!contents.provenance.empty()) manifest["provenance"] = contents.provenance;
    add_structures(structures, contents, geometry, manifest, progress.part(0.0, 0.3));
    manifest["distances"] = distances_json(structures, progress.part(0.3, 0.6));
    std::map<std::string, std::string> blobs;
    if (contents.slices) blobs = add_slices(scene, manifest);
    if (!blobs.empty()) manifest["holds"].push_back("image slices");
    progress.report(0.6, "Packing structures");
    blobs.merge(geometry.blobs());
    manifest.update(geometry.json());
    return filled_page(viewer_page_bytes(), manifest, blobs);
}

}  // namespace vesselbench
