#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "geometry/formats/raw_surface.h"

namespace vesselbench {

/// Cells of an unstructured grid, as VTK's files have them.
struct GridCells {
    std::vector<std::uint8_t> types;   ///< VTK's number of each cell's type
    std::vector<std::size_t> offsets;  ///< of each cell's first corner, and the number of corners
    std::vector<VertexId> corners;     ///< of all cells, one after the other
    std::vector<int> regions;          ///< per cell, or empty

    void add(std::uint8_t type, const std::vector<VertexId>& its_corners);
};

/// Adds the surface of a grid: its triangles, quads, polygons and strips; of a grid with volume
/// cells the outer faces, with the regions of flat cells on them. Notes state it, and ignored lines
/// and points.
/// \param file for error texts
/// \param raw with its positions, to which the corners belong
/// \throw InvalidInput for cells of other types, or with another number of corners than theirs
void append_grid_surface(const GridCells& cells, const std::string& file, RawSurface& raw);

}  // namespace vesselbench
