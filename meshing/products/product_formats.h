#pragma once

#include <filesystem>
#include <vector>

#include "geometry/formats/surface_formats.h"
#include "meshing/products/cfd_parameters.h"
#include "meshing/tetrahedra/volume_mesh.h"

namespace vesselbench {

/// A writer takes the line on the model's provenance, as a SurfaceFormat's.
using VolumeFormat = FormatRow<VolumeMesh, VolumeMesh, const std::string&>;

/// A folder of files that a solver runs on.
struct CaseFormat : Format {
    void (*write)(const std::filesystem::path& folder, const VolumeMesh& mesh,
                  const CfdParameters& parameters, const Progress& progress,
                  const std::string& provenance) = nullptr;
};

/// Surface formats for printers, written only.
[[nodiscard]] const std::vector<SurfaceFormat>& product_surface_formats();

/// Formats of volume meshes, written only.
[[nodiscard]] const std::vector<VolumeFormat>& volume_formats();

/// Formats of solvers' cases.
[[nodiscard]] const std::vector<CaseFormat>& case_formats();

}  // namespace vesselbench
