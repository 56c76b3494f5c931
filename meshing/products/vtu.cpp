#include "meshing/products/vtu.h"

#include "geometry/formats/vtk_mesh.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/whole_file.h"

namespace vesselbench {

void write_vtu(const VolumeMesh& mesh, const std::string& path, const Progress& progress,
               const std::string& provenance) {
    if (mesh.tetrahedra.empty()) throw InvalidInput("VTU: the volume mesh has no cells");
    VtkMesh grid{.points = mesh.points, .provenance = provenance};
    LoopProgress rows(progress.part(0.0, 0.5),
                      mesh.cell_count() + mesh.boundary.size() + mesh.boundary_sides.size(),
                      writing_text(path));
    const auto add = [&](const auto& corners, std::int32_t region) {
        rows.step();
        add_cell(grid, corners, region);
    };
    for (const Tetrahedron& cell : mesh.tetrahedra) add(cell, 0);
    grid.types.assign(grid.regions.size(), kVtkTetrahedron);
    for (const Prism& cell : mesh.prisms) add(cell, 0);
    grid.types.resize(grid.regions.size(), kVtkWedge);
    for (std::size_t t = 0; t < mesh.boundary.size(); ++t)
        add(mesh.boundary[t], mesh.boundary_patches[t] + 1);
    grid.types.resize(grid.regions.size(), kVtkTriangle);
    for (std::size_t t = 0; t < mesh.boundary_sides.size(); ++t)
        add(mesh.boundary_sides[t], mesh.side_patches[t] + 1);
    grid.types.resize(grid.regions.size(), kVtkQuadrangle);
    for (const Patch& patch : mesh.patches) grid.patch_names.push_back(patch.name);
    write_vtk_unstructured_grid(grid, path, progress.part(0.5, 1.0));
}

}  // namespace vesselbench
