#include "workbench/case/measure_json.h"

#include <cmath>
#include <numbers>
#include <string>

#include <nlohmann/json.hpp>

#include "workbench/case/json_fields.h"
#include "workbench/case/point_json.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

Json or_null(const std::optional<double>& number) {
    return number ? Json(*number) : Json();
}

std::optional<double> number_in(JsonFields& fields, const char* key) {
    const Json* number = fields.child(key);
    if (number == nullptr || !number->is_number()) return std::nullopt;
    return number->get<double>();
}

}  // namespace

double diameter_of_area(double area) {
    return 2.0 * std::sqrt(area / std::numbers::pi);
}

Json patch_json(const PatchMeasures& patch, Keys keys) {
    const auto key = [&](const char* name, const char* unit) {
        return std::string(name) + (keys == Keys::WithUnits ? unit : "");
    };
    return {{"name", patch.name},
            {"kind", to_string(patch.kind)},
            {"triangles", patch.triangles},
            {key("area", "_mm2"), patch.area},
            {key("centroid", "_mm"), point_json(patch.centroid)},
            {"normal", point_json(patch.normal)},
            {key("flatness", "_mm"), patch.flatness},
            {key("diameter", "_mm"), diameter_of_area(patch.area)}};
}

Json measure_json(const SurfaceMeasures& measures) {
    const Connectivity& connectivity = measures.connectivity;
    const Bounds& box = measures.bounds;
    Json json = {{"vertices", measures.vertices},
                 {"triangles", measures.triangles},
                 {"components", connectivity.components},
                 {"boundary_loops", connectivity.boundary_loops},
                 {"closed", connectivity.closed},
                 {"manifold", connectivity.manifold},
                 {"oriented", connectivity.oriented},
                 {"self_intersections", measures.self_intersections},
                 {"genus", connectivity.genus ? Json(*connectivity.genus) : Json()},
                 {"area", measures.area},
                 {"volume", measures.volume},
                 {"bounds", Json::array({box.min.x(), box.min.y(), box.min.z(), box.max.x(),
                                         box.max.y(), box.max.z()})}};
    json["edge_length"] = {{"min", measures.edge_length.min},
                           {"mean", measures.edge_length.mean},
                           {"max", measures.edge_length.max}};
    json.update(triangle_shape_json({measures.equiangle_skewness, measures.radius_ratio}));
    json["normal_curvature_deg"] = measures.normal_curvature_deg;
    json["mean_curvature"] = {{"integral", measures.mean_curvature_integral},
                              {"integral_abs", measures.mean_curvature_integral_abs}};
    json["patches"] = Json::array();
    for (const PatchMeasures& patch : measures.patches)
        json["patches"].push_back(patch_json(patch, Keys::Plain));
    return json;
}

Json triangle_shape_json(const TriangleShape& shape) {
    const Spread &skewness = shape.equiangle_skewness, &ratio = shape.radius_ratio;
    return {{"equiangle_skewness", {{"mean", skewness.mean}, {"max", skewness.max}}},
            {"radius_ratio", {{"min", ratio.min}, {"mean", ratio.mean}}}};
}

Json extent_json(double volume, double area) {
    return {{"volume_mm3", volume}, {"area_mm2", area}};
}

Json distance_json(double mean, double largest, std::optional<double> percentile_95) {
    Json json = {{"mean_mm", mean}};
    if (percentile_95) json["percentile_95_mm"] = *percentile_95;
    json["largest_mm"] = largest;
    return json;
}

Json change_json(const SurfaceChange& change) {
    return {{"volume_before_mm3", or_null(change.volume_before)},
            {"volume_after_mm3", or_null(change.volume_after)},
            {"largest_deviation_mm", or_null(change.largest_deviation)},
            {"mean_deviation_mm", or_null(change.mean_deviation)},
            {"triangles_before", change.triangles_before},
            {"triangles_after", change.triangles_after},
            {"moved_vertices", change.moved_vertices}};
}

SurfaceChange change_from(const Json& json) {
    JsonFields fields(json, "change");
    return {.volume_before = number_in(fields, "volume_before_mm3"),
            .volume_after = number_in(fields, "volume_after_mm3"),
            .largest_deviation = number_in(fields, "largest_deviation_mm"),
            .mean_deviation = number_in(fields, "mean_deviation_mm"),
            .triangles_before = fields.required<std::size_t>("triangles_before"),
            .triangles_after = fields.required<std::size_t>("triangles_after"),
            .moved_vertices = fields.required<std::size_t>("moved_vertices")};
}

Json volume_quality_json(const VolumeQuality& q) {
    Json json = {{"points", q.points},
                 {"cells", q.cells},
                 {"volume_mm3", q.volume},
                 {"smallest_cell_mm3", q.smallest_cell},
                 {"mean_edge_mm", q.mean_edge},
                 {"smallest_dihedral_deg", q.smallest_dihedral},
                 {"mean_smallest_dihedral_deg", q.mean_smallest_dihedral},
                 {"largest_dihedral_deg", q.largest_dihedral},
                 {"cells_below_10_deg", q.cells_below_10_deg},
                 {"mean_non_orthogonality_deg", q.mean_non_orthogonality},
                 {"largest_non_orthogonality_deg", q.largest_non_orthogonality},
                 {"faces_over_70_deg", q.faces_over_70_deg},
                 {"faces", q.faces},
                 {"largest_skewness", q.largest_skewness},
                 {"largest_aspect_ratio", q.largest_aspect_ratio},
                 {"mean_volume_ratio", q.mean_volume_ratio},
                 {"largest_volume_ratio", q.largest_volume_ratio}};
    if (q.prisms == 0) return json;
    json["prisms"] = q.prisms;
    json["smallest_scaled_jacobian"] = q.smallest_scaled_jacobian;
    return json;
}

Json reference_json(const ReferenceComparison& comparison) {
    Json json = {{"hausdorff", comparison.hausdorff},
                 {"mean_distance", comparison.mean_distance},
                 {"hausdorff_to_reference", comparison.hausdorff_to_reference},
                 {"mean_to_reference", comparison.mean_to_reference},
                 {"volume_change_percent", comparison.volume_change_percent}};
    if (comparison.local_error)
        json["local_error"] = {{"mean", comparison.local_error->mean},
                               {"max", comparison.local_error->largest}};
    return json;
}

}  // namespace vesselbench
