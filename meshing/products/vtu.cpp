#include "meshing/products/vtu.h"

#include "geometry/formats/vtk_mesh.h"
#include "geometry/kernel/errors.h"
#include "geometry/kernel/whole_file.h"

namespace vesselbench {

void write_vtu(const VolumeMesh& mesh, const std::string& path, const Progress& progress,
               const std::string& provenance) {
    if (mesh.tetrahedra.empty()) throw InvalidInput("VTU: the volume mesh has no cells");
    VtkMesh grid{.points = mesh.points, .provenance = provenance};
    LoopProgress rows(progress.part(0.0, 0.5), mesh.tetrahedra.size() + mesh.boundary.size(),
                      writing_text(path));
    for (const Tetrahedron& cell : mesh.tetrahedra) {
        rows.step();
        add_cell(grid, cell, 0);
    }
    for (std::size_t t = 0; t < mesh.boundary.size(); ++t) {
        rows.step();
        add_cell(grid, mesh.boundary[t], mesh.boundary_patches[t] + 1);
    }
    grid.types.assign(mesh.tetrahedra.size(), kVtkTetrahedron);
    grid.types.resize(grid.regions.size(), kVtkTriangle);
    for (const Patch& patch : mesh.patches) grid.patch_names.push_back(patch.name);
    write_vtk_unstructured_grid(grid, path, progress.part(0.5, 1.0));
}

}  // namespace vesselbench
