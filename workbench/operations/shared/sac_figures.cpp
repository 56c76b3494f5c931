#include "workbench/operations/shared/sac_figures.h"

#include <string>

#include <nlohmann/json.hpp>

#include "geometry/kernel/diagnosed_error.h"
#include "geometry/kernel/measure.h"
#include "geometry/vessel/sac/sac_regions.h"
#include "workbench/case/point_json.h"
#include "workbench/operations/table.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

/// A key with its unit where they have one.
class KeyWriter {
public:
    explicit KeyWriter(Keys keys) : with_units_(keys == Keys::WithUnits) {}

    [[nodiscard]] std::string operator()(const char* name, const char* unit) const {
        return std::string(name) + (with_units_ ? unit : "");
    }

private:
    bool with_units_;
};

void add_measures(Json& table, const SacMeasures& m, const KeyWriter& key) {
    table.update(Json{{key("dome_area", "_mm2"), m.dome_area},
                      {key("neck_area", "_mm2"), m.neck_area},
                      {key("volume", "_mm3"), m.volume},
                      {key("neck_diameter", "_mm"), m.neck_diameter},
                      {key("neck_width", "_mm"), m.neck_width},
                      {key("neck_hydraulic_diameter", "_mm"), m.neck_hydraulic},
                      {key("height", "_mm"), m.height},
                      {key("length", "_mm"), m.length},
                      {key("width", "_mm"), m.width},
                      {key("diameter", "_mm"), m.diameter},
                      {"aspect_ratio", m.aspect_ratio},
                      {"size_ratio", m.size_ratio},
                      {"bottleneck_factor", m.bottleneck_factor},
                      {"bulge_location", m.bulge_location},
                      {"undulation", m.undulation},
                      {"ellipticity", m.ellipticity},
                      {"nonsphericity", m.nonsphericity},
                      {key("parent_diameter", "_mm"), m.parent_diameter}});
}

Json regions_json(const SacRegions& regions, const Surface& surface, const KeyWriter& key) {
    Json list = Json::array();
    for (const SacRegion region : {SacRegion::Sac, SacRegion::Parent, SacRegion::Daughters}) {
        double area = 0.0;
        std::size_t triangles = 0;
        for (TriangleId t = 0; t < surface.triangle_count(); ++t)
            if (regions.triangles[t] == region) {
                area += triangle_area(surface.points(), surface.triangles()[t]);
                ++triangles;
            }
        if (triangles > 0)
            list.push_back({{"region", to_string(region)},
                            {"triangles", triangles},
                            {key("area", "_mm2"), area}});
    }
    return list;
}

Json vessels_json(const std::vector<NeckVessel>& vessels, const KeyWriter& key) {
    Json list = Json::array();
    for (const NeckVessel& vessel : vessels)
        list.push_back(
            {{"region", to_string(vessel.region)}, {key("diameter", "_mm"), vessel.diameter}});
    return list;
}

}  // namespace

MarkedNeck neck_in(const Arguments& arguments) {
    SacNeck neck{arguments.point("dome"),
                 {arguments.point("at"), arguments.point("normal").normalized()}};
    if (!neck.plane.normal.allFinite() || neck.plane.normal.isZero())
        throw DiagnosedUsage(
            {.code = "neck-without-direction", .remedies = {{.arguments = {{"normal", ""}}}}});
    if (neck.plane.distance(neck.dome) < 0.0) neck.plane.normal = -neck.plane.normal;
    return {neck, arguments.real("reach"), arguments.flag("accept_doubt")};
}

std::optional<MarkedNeck> marked_neck(const std::string& operation, const Arguments& resolved) {
    const Operation* known = known_operation(operation);
    if (known == nullptr || parameter_of(*known, Meaning::Neck) == nullptr) return std::nullopt;
    try {
        return neck_in(resolved);
    } catch (const UsageError&) {  // of a project from elsewhere
        return std::nullopt;
    }
}

Diagnostic neck_in_doubt(const MarkedNeck& marked, const SacMeasures& measures) {
    return {.code = "neck-in-doubt",
            .place = marked.neck.plane.point,
            .words = {{"why", why_neck_in_doubt(measures)}},
            .remedies = {{.arguments = {{"at", ""}, {"normal", ""}}},
                         {.arguments = {{"accept_doubt", "true"}}}}};
}

SacFigures sac_figures(const Surface& surface, const MarkedNeck& marked, Keys keys,
                       const Progress& progress) {
    const KeyWriter key(keys);
    const SacAtNeck sac = sac_beyond(surface, marked.neck, progress.part(0.0, 0.5));
    SacFigures figures{.measures = measure_sac(sac.sac, sac.parent_diameter)};
    figures.in_doubt = neck_in_doubt(figures.measures) && !marked.accept_doubt;
    Json& table = figures.table;
    table = {{"in_doubt", figures.in_doubt},
             {key("dome", "_mm"), point_json(marked.neck.dome)},
             {key("neck", "_mm"), point_json(sac.sac.neck_centroid)},
             {"normal", point_json(marked.neck.plane.normal)}};
    if (figures.in_doubt) return figures;
    add_measures(table, figures.measures, key);
    const SacRegions regions =
        sac_regions(surface, marked.neck, {.reach = marked.reach}, progress.part(0.5, 1.0));
    table["vessels"] = vessels_json(regions.vessels, key);
    table["regions"] = regions_json(regions, surface, key);
    return figures;
}

}  // namespace vesselbench
