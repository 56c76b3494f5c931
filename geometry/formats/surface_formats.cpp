#include "geometry/formats/surface_formats.h"

#include "geometry/formats/legacy_vtk.h"
#include "geometry/formats/obj.h"
#include "geometry/formats/off.h"
#include "geometry/formats/ply.h"
#include "geometry/formats/stl.h"
#include "geometry/formats/vtp.h"
#include "geometry/formats/vtu.h"

namespace vesselbench {

const std::vector<SurfaceFormat>& surface_formats() {
    using enum FormatKind;
    static const std::vector<SurfaceFormat> rows = {
        {{.name = "STL",
          .kind = Surface,
          .suffixes = {".stl"},
          .content = "triangles in single precision"},
         read_stl,
         write_stl},
        {{.name = "PLY",
          .kind = Surface,
          .suffixes = {".ply"},
          .content = "double precision, with patches and attributes"},
         read_ply,
         write_ply},
        {{.name = "OBJ",
          .kind = Surface,
          .suffixes = {".obj"},
          .content = "text, with a group per patch"},
         read_obj,
         write_obj},
        {{.name = "OFF", .kind = Surface, .suffixes = {".off"}, .content = "text, shape only"},
         read_off,
         write_off},
        {{.name = "VTP",
          .kind = Surface,
          .suffixes = {".vtp"},
          .content = "double precision, with patches and attributes"},
         read_vtp,
         write_vtp},
        {{.name = "VTU",
          .kind = Surface,
          .suffixes = {".vtu"},
          .content = "surface of an unstructured grid"},
         read_vtu_surface},
        {{.name = "VTK",
          .kind = Surface,
          .suffixes = {".vtk"},
          .content = "legacy poly data or unstructured grid",
          .sniff = is_legacy_surface},
         read_legacy_vtk}};
    return rows;
}

}  // namespace vesselbench
