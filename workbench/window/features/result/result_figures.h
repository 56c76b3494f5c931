#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "geometry/kernel/progress.h"
#include "workbench/case/scene.h"

namespace vesselbench {

/// What a model is, in the figures that its result card compares.
struct ResultFigures {
    double volume = 0.0;                   ///< of the surface [mm^3]
    std::size_t triangles = 0, cells = 0;  ///< cells: tetrahedra
    std::size_t inlets = 0, outlets = 0, cuts = 0;
    double mean_triangle = 0.0;            ///< mean radius ratio of the wall's triangles [-]
    double worst_triangle = 0.0;           ///< their smallest one [-]
    std::optional<double> smallest_angle;  ///< between the faces of a cell [deg]; none: no cells
};

/// For any thread.
/// \return none if the scene has no surface
/// \throw Cancelled
[[nodiscard]] std::optional<ResultFigures> result_figures(const Scene& scene,
                                                          const Progress& progress);

/// A row of the card.
struct ResultRow {
    std::string name, before, after;  ///< before: empty if it is not known
};

/// "Volume", "1,230 mm³", "1,210 mm³" ... \param before none: there was no model
[[nodiscard]] std::vector<ResultRow> result_rows(const std::optional<ResultFigures>& before,
                                                 const ResultFigures& after);

}  // namespace vesselbench
