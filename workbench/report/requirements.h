#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "geometry/kernel/surface.h"
#include "geometry/kernel/triangle_shape.h"
#include "workbench/case/purposes.h"

namespace vesselbench {

/// What was measured of a model to judge it; without a value: it could not be.
struct ModelFigures {
    std::optional<double> mean_lost, largest_lost;  ///< from the source's wall to the model [mm]
    Vec3 lost_place = Vec3::Zero();                 ///< of the largest [mm]
    std::optional<double> offset;                   ///< mean of the wall, outward [mm]
    std::map<std::string, double> neighbours;       ///< change of the smallest distance [mm]
    std::optional<double> voxel_diagonal;           ///< of the source image [mm]
    double sharp_edges = 0.0;                       ///< of the wall's, kSharpEdge and more [-]
    double normal_curvature = 0.0;                  ///< mean over the vertices [deg]
    std::optional<double> edges_around;             ///< 95 % of the wall's area has more [-]
    std::optional<double> sag;                      ///< 95 % of the wall's area has less [mm]
    std::optional<double> print_resolution;         ///< that the model was made for [mm]
    TriangleShape wall;
    double median_size_ratio = 1.0, percentile_99_size_ratio = 1.0, largest_size_ratio = 1.0;
};

/// An edge is sharp if its triangles' normals differ by more [deg]: from there on viewers draw a
/// crease. Source: feature_angle of PyVista's smooth shading, 30 by default.
inline constexpr double kSharpEdge = 30.0;

/// All but the distances, which need a source.
/// \throw InvalidInput if the surface has no triangle
[[nodiscard]] ModelFigures shape_figures(const Surface& model);

enum class Judgement : std::uint8_t {
    Met,
    NotMet,
    NotMeasured,
    NoLimit,   ///< none has a reason
    NotJudged  ///< of low relevance for the purpose
};

[[nodiscard]] std::string to_string(Judgement judgement);

/// A row of thesis Table 2.1 for one purpose, with what was measured.
struct Requirement {
    std::string name;
    char relevance = '-';            ///< as Purpose::relevance
    nlohmann::ordered_json figures;  ///< units in the keys; null: not measured
    std::string limit, reason;       ///< in words; empty: none
    Judgement judgement = Judgement::NoLimit;
};

/// The six requirements to surface models of thesis Table 2.1. Limits and their sources are
/// explained in docs/science/measures.md.
[[nodiscard]] std::vector<Requirement> requirements_of(const Purpose& purpose,
                                                       const ModelFigures& model);

/// As the list "requirements" of report.json.
[[nodiscard]] nlohmann::ordered_json requirements_json(const std::vector<Requirement>& rows);

}  // namespace vesselbench
