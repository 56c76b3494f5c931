#include "meshing/products/product_formats.h"

#include "meshing/products/cgns.h"
#include "meshing/products/fluent.h"
#include "meshing/products/gmsh.h"
#include "meshing/products/openfoam_case.h"
#include "meshing/products/threemf.h"
#include "meshing/products/vtu.h"

namespace vesselbench {

const std::vector<SurfaceFormat>& product_surface_formats() {
    using enum FormatKind;
    static const std::vector<SurfaceFormat> rows = {
        {{.name = "3MF",
          .kind = Surface,
          .suffixes = {".3mf"},
          .content = "a solid for printing; the surface must be closed"},
         nullptr,
         write_3mf}};
    return rows;
}

const std::vector<VolumeFormat>& volume_formats() {
    using enum FormatKind;
    static const std::vector<VolumeFormat> rows = {
        {{.name = "VTU",
          .kind = VolumeMesh,
          .suffixes = {".vtu"},
          .content = "double precision, with boundary triangles and patches"},
         nullptr,
         write_vtu},
        {{.name = "CGNS",
          .kind = VolumeMesh,
          .suffixes = {".cgns"},
          .content = "in HDF5, with a family and a boundary condition per patch",
          .unit = "m"},
         nullptr,
         write_cgns},
        {{.name = "Fluent",
          .kind = VolumeMesh,
          .suffixes = {".fluent.msh", ".cas"},
          .content = "text, with a zone per patch: walls, velocity inlets and pressure outlets",
          .unit = "m"},
         nullptr,
         write_fluent},
        {{.name = "Gmsh",
          .kind = VolumeMesh,
          .suffixes = {".msh"},
          .content = "MSH 2.2 text, with patches as physical surfaces"},
         nullptr,
         [](const vesselbench::VolumeMesh& mesh, const std::string& path, const Progress& progress,
            const std::string&) { write_msh(mesh, path, progress); }}};
    return rows;
}

const std::vector<CaseFormat>& case_formats() {
    static const std::vector<CaseFormat> rows = {{{.name = "OpenFOAM",
                                                   .kind = FormatKind::VolumeMesh,
                                                   .content = "a case for simpleFoam or pimpleFoam",
                                                   .unit = "m",
                                                   .folder = "for an OpenFOAM case"},
                                                  write_openfoam_case}};
    return rows;
}

}  // namespace vesselbench
