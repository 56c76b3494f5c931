#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "geometry/formats/pending_files.h"
#include "meshing/products/cfd_parameters.h"
#include "workbench/case/scene.h"

namespace vesselbench {

/// Takes the "openfoam.parameter=value" texts out of a list, checked against flow_parameters().
/// \throw UsageError as checked_arguments
[[nodiscard]] CfdParameters take_flow_parameters(std::vector<std::string>& texts);

/// Writes surface.vtp, surface.stl and the product's files: for "cfd" volume.vtu, volume.msh and
/// openfoam/, for "rp" print.stl and print.3mf.
/// \return their names
/// \throw InvalidInput if the scene has no volume mesh for cfd, IoError
[[nodiscard]] std::vector<std::string> write_products(PendingFiles& files,
                                                      const std::filesystem::path& folder,
                                                      const Scene& scene,
                                                      const std::string& purpose,
                                                      const CfdParameters& flow);

/// \throw UsageError that lists the suffixes unless export_scene can write such a file
void check_export_name(const std::filesystem::path& file);

/// Writes one file by its suffix (.stl .ply .obj .off .vtp .vtu .msh .3mf), or, without a suffix,
/// an OpenFOAM case.
/// \throw UsageError that lists the suffixes for another one
void export_scene(PendingFiles& files, const std::filesystem::path& file, const Scene& scene,
                  const CfdParameters& flow);

}  // namespace vesselbench
