#include "workbench/report/requirements.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "geometry/kernel/statistics.h"
#include "geometry/kernel/vertex_normals.h"
#include "geometry/kernel/wall_edges.h"
#include "geometry/kernel/wording.h"
#include "workbench/case/measure_json.h"
#include "workbench/case/point_json.h"

namespace vesselbench {

namespace {

using Json = nlohmann::ordered_json;

/// Crotches of furcations are sharp in sound models.
constexpr double kMostSharpEdges = 0.01;
/// A regular polygon of so many edges has 95.5 % of its circle's area.
constexpr double kLeastEdgesAround = 12.0;
/// "Below 0.8 for a good grid" (Pointwise User Manual, equiangle skewness).
constexpr double kLargestSkewness = 0.8;
/// "Growth factors should be smaller than 1.3" (Ansys CFX Reference Guide 6.3.3).
constexpr double kUsualSizeRatio = 1.3;
/// The lower end of the expansion ratios, 2 to 5, that the Ansys ICEM CFD manual (35.2.1) allows.
constexpr double kLargestSizeRatio = 2.0;

double share_above(const std::vector<double>& values, double limit) {
    const auto above = std::ranges::count_if(values, [&](double value) { return value > limit; });
    return values.empty() ? 0.0 : static_cast<double>(above) / static_cast<double>(values.size());
}

std::optional<double> part_of(std::vector<double> values, double share) {
    if (values.empty()) return std::nullopt;
    return percentile(values, share);
}

std::optional<double> part_of_area(const std::vector<double>& values,
                                   const std::vector<double>& areas, double share) {
    if (values.empty()) return std::nullopt;
    return weighted_percentile(values, areas, share);
}

/// \param met none: there is no limit
void judge(Requirement& row, std::optional<bool> met) {
    if (row.figures.is_null())
        row.judgement = Judgement::NotMeasured;
    else if (row.relevance == '-')
        row.judgement = Judgement::NotJudged;
    else if (met)
        row.judgement = *met ? Judgement::Met : Judgement::NotMet;
}

/// How far a vertex may move within its voxel's cell [mm].
std::optional<double> within_voxel(const ModelFigures& model) {
    if (!model.voxel_diagonal) return std::nullopt;
    return 0.5 * *model.voxel_diagonal;
}

std::string voxel_reason() {
    return "half the diagonal of the image's voxel: no vertex leaves its voxel's cell (thesis "
           "3.3.4, node position constraint)";
}

void judge_small_features(Requirement& row, const ModelFigures& model) {
    if (!model.largest_lost) return judge(row, {});
    row.figures = {{"largest_mm", *model.largest_lost},
                   {"mean_mm", model.mean_lost.value_or(0.0)},
                   {"place_mm", point_json(model.lost_place)}};
    const auto limit = within_voxel(model);
    if (!limit) return judge(row, {});
    row.limit =
        "largest distance from the source to the model at most " + formatted(*limit, "%.3g mm");
    row.reason = voxel_reason();
    judge(row, *model.largest_lost <= *limit);
}

void judge_relations(Requirement& row, const ModelFigures& model) {
    if (model.offset) row.figures["mean_offset_mm"] = *model.offset;
    double largest = 0.0;
    for (const auto& [name, change] : model.neighbours) {
        row.figures["change_to_neighbours_mm"][name] = change;
        largest = std::max(largest, std::abs(change));
    }
    const auto limit = within_voxel(model);
    if (model.neighbours.empty() || !limit) return judge(row, {});
    row.limit =
        "smallest distance to each neighbour changed by at most " + formatted(*limit, "%.3g mm");
    row.reason = voxel_reason();
    judge(row, largest <= *limit);
}

void judge_smoothness(Requirement& row, const ModelFigures& model) {
    row.figures = {{"sharp_edges_percent", 100.0 * model.sharp_edges},
                   {"normal_curvature_deg", model.normal_curvature}};
    row.limit = "at most " + formatted(100.0 * kMostSharpEdges) + " % of the wall's edges over " +
                formatted(kSharpEdge) + " deg";
    row.reason =
        "viewers draw such edges as creases (feature angle of PyVista); the share, for the "
        "crotches of furcations, is this program's own";
    judge(row, model.sharp_edges <= kMostSharpEdges);
}

void judge_resolution(Requirement& row, const Purpose& purpose, const ModelFigures& model) {
    if (!model.edges_around || !model.sag) return judge(row, {});
    row.figures = {{"edges_around", *model.edges_around}, {"sag_mm", *model.sag}};
    if (purpose.simulates_flow) {
        row.limit =
            "at least " + formatted(kLeastEdgesAround) + " edges around 95 % of the wall's area";
        row.reason = "a regular polygon of 12 edges has 95.5 % of its circle's area";
        return judge(row, *model.edges_around >= kLeastEdgesAround);
    }
    if (!model.print_resolution) return judge(row, {});
    row.limit =
        "sag of 95 % of the wall's area at most " + formatted(*model.print_resolution, "%.3g mm");
    row.reason = "print_resolution that the surface was remeshed for";
    judge(row, *model.sag <= *model.print_resolution);
}

void judge_quality(Requirement& row, const ModelFigures& model) {
    row.figures = triangle_shape_json(model.wall);
    row.limit = "largest equiangle skewness of the wall below " + formatted(kLargestSkewness);
    row.reason = "\"for a good grid\", Pointwise User Manual, equiangle skewness";
    judge(row, model.wall.equiangle_skewness.max < kLargestSkewness);
}

void judge_homogeneity(Requirement& row, const ModelFigures& model) {
    row.figures = {{"median_size_ratio", model.median_size_ratio},
                   {"percentile_99_size_ratio", model.percentile_99_size_ratio},
                   {"largest_size_ratio", model.largest_size_ratio}};
    row.limit = "size ratio of neighbouring triangles below " + formatted(kUsualSizeRatio) +
                " (median), at most " + formatted(kLargestSizeRatio) + " for 99 %";
    row.reason =
        "growth factor, Ansys CFX Reference Guide 6.3.3; expansion ratio, Ansys ICEM CFD "
        "User's Manual 35.2.1";
    judge(row, model.median_size_ratio < kUsualSizeRatio &&
                   model.percentile_99_size_ratio <= kLargestSizeRatio);
}

}  // namespace

ModelFigures shape_figures(const Surface& model) {
    const WallEdges edges = wall_edges(model);
    const WallResolution wall = wall_resolution(model, distance_to(model));
    ModelFigures figures{.sharp_edges = share_above(edges.angles, kSharpEdge),
                         .normal_curvature = mean(normal_curvature(model)),
                         .edges_around = part_of_area(wall.edges_around, wall.areas, 0.05),
                         .sag = part_of_area(wall.sags, wall.areas, 0.95),
                         .wall = wall_shape(model)};
    figures.median_size_ratio = part_of(edges.size_ratios, 0.5).value_or(1.0);
    figures.percentile_99_size_ratio = part_of(edges.size_ratios, 0.99).value_or(1.0);
    figures.largest_size_ratio = part_of(edges.size_ratios, 1.0).value_or(1.0);
    return figures;
}

std::string to_string(Judgement judgement) {
    switch (judgement) {
        case Judgement::Met:
            return "met";
        case Judgement::NotMet:
            return "not met";
        case Judgement::NotMeasured:
            return "not measured";
        case Judgement::NotJudged:
            return "not judged: of low relevance";
        case Judgement::NoLimit:
            break;
    }
    return "no limit stated";
}

std::vector<Requirement> requirements_of(const Purpose& purpose, const ModelFigures& model) {
    std::vector<Requirement> rows;
    for (const char* name : {"small features", "spatial relations", "smoothness", "high resolution",
                             "high triangle quality", "triangle size homogeneity"})
        rows.push_back({.name = name, .relevance = purpose.relevance.at(rows.size())});
    judge_small_features(rows[0], model);
    judge_relations(rows[1], model);
    judge_smoothness(rows[2], model);
    judge_resolution(rows[3], purpose, model);
    judge_quality(rows[4], model);
    judge_homogeneity(rows[5], model);
    return rows;
}

Json requirements_json(const std::vector<Requirement>& rows) {
    Json list = Json::array();
    for (const Requirement& row : rows)
        list.push_back({{"requirement", row.name},
                        {"relevance", std::string(1, row.relevance)},
                        {"figures", row.figures},
                        {"limit", row.limit},
                        {"reason", row.reason},
                        {"judgement", to_string(row.judgement)}});
    return list;
}

}  // namespace vesselbench
