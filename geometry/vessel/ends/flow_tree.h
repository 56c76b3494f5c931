#pragma once

#include <cstddef>
#include <vector>

#include "geometry/vessel/centerlines/centerline_graph.h"

namespace vesselbench {

/// Median diameter of the inscribed spheres of each branch outside its furcations [mm], #branches:
/// the vessel's along its course, not that of its end.
[[nodiscard]] std::vector<double> course_diameters(const CenterlineGraph& graph);

/// How little a tree looks as if its blood entered at a tip [-], 0: perfectly so. Blood leaves the
/// tip along the shortest ways; at each furcation, the sums of cubes of the vessels before and
/// behind it are equal by Murray's law, and the squared logarithm of their ratio counts.
/// Source: Murray, "The physiological principle of minimum work", PNAS 12, 1926.
/// \param diameters of the branches (course_diameters) [mm]; 0: no blood flows there
/// \param tip node of the graph
[[nodiscard]] double root_cost(const CenterlineGraph& graph, const std::vector<double>& diameters,
                               std::size_t tip);

}  // namespace vesselbench
