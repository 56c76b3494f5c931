#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "geometry/kernel/progress.h"
#include "geometry/kernel/surface.h"

namespace vesselbench {

/// A mesh as stored in VTK's XML files.
struct VtkMesh {
    const Positions& points;         ///< [mm]
    std::vector<long long> corners;  ///< of all cells, one after the other
    std::vector<long long>
        offsets;  ///< of each cell's first corner; the last is the number of corners
    std::vector<std::uint8_t> types;    ///< VTK's number of each cell's type; empty: all triangles
    std::vector<std::int32_t> regions;  ///< per cell, the array CellEntityIds
    std::vector<std::string> patch_names;  ///< of regions 1, 2..., the field array PatchNames
    std::map<std::string, std::shared_ptr<const std::vector<double>>> attributes;  ///< per point
    /// Per cell; of as many components as the numbers of values and cells say.
    std::map<std::string, std::shared_ptr<const std::vector<double>>> cell_values = {};
    std::string provenance;  ///< of the model, the field array Provenance; empty: none
};

inline constexpr std::uint8_t kVtkTriangle = 5, kVtkQuadrangle = 9, kVtkTetrahedron = 10,
                              kVtkWedge = 13;

/// Adds a cell. \param region its entry of CellEntityIds
template <class Corners>
void add_cell(VtkMesh& mesh, const Corners& corners, std::int32_t region) {
    if (mesh.offsets.empty()) mesh.offsets.push_back(0);
    mesh.corners.insert(mesh.corners.end(), corners.begin(), corners.end());
    mesh.offsets.push_back(static_cast<long long>(mesh.corners.size()));
    mesh.regions.push_back(region);
}

/// Writes PolyData with VTK, in double precision, as appended raw data; the same mesh gives the
/// same bytes. \throw IoError, Cancelled
void write_vtk_poly_data(const VtkMesh& mesh, const std::string& path,
                         const Progress& progress = {});

/// The same as UnstructuredGrid. \throw IoError, Cancelled
void write_vtk_unstructured_grid(const VtkMesh& mesh, const std::string& path,
                                 const Progress& progress = {});

}  // namespace vesselbench
