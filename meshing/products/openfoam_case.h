#pragma once

#include <filesystem>
#include <string>

#include "geometry/kernel/progress.h"
#include "meshing/products/cfd_parameters.h"
#include "meshing/tetrahedra/volume_mesh.h"

namespace vesselbench {

/// Writes a complete OpenFOAM case (v1912 and similar) for simpleFoam, or for pimpleFoam if the
/// parameters have a waveform: then constant/boundaryData has the velocities at the inlets over all
/// periods, and given flows of outlets follow it. It is: constant/polyMesh in metres,
/// patches `wall` (type wall) and the openings (type patch) by their names, fields 0/U and 0/p,
/// laminar Newtonian blood, second-order schemes, residual control, decomposeParDict, and the
/// scripts Allrun and Allrun.parallel. Walls are no-slip; at the outlets p = 0 (kinematic) and
/// backflow enters at rest (inletOutlet); at the inlet the velocity is fixed, plug or parabolic,
/// with exactly the given flow. system/controlDict is that of control_dictionary(). README and
/// system/controlDict begin with the model's provenance, if it is given. An existing case in the
/// folder is replaced (its results are kept).
/// \throw InvalidInput if the mesh has no inlet or outlet; IoError if a file cannot be written, or
///        the folder contains something that is not a case; Cancelled, with some of the files
///        written
void write_openfoam_case(const std::filesystem::path& folder, const VolumeMesh& mesh,
                         const CfdParameters& parameters, const Progress& progress = {},
                         const std::string& provenance = {});

/// A file in a case's folder that says what the case is of; exports write it beside the case.
inline constexpr const char* kFlowRecordFile = "flow.json";

/// True for a folder that holds a case as write_openfoam_case() wrote it, and nothing else: no
/// results, no files of others.
[[nodiscard]] bool is_unused_openfoam_case(const std::filesystem::path& folder);

}  // namespace vesselbench
