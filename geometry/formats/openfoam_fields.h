#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "geometry/kernel/surface.h"

namespace vesselbench {

/// The faces of a patch of an OpenFOAM case with the fields on them, in OpenFOAM's own units.
/// Faces with more than three corners become several triangles with the same values.
struct FoamPatchFields {
    Positions points;                                    ///< [mm], of this patch alone
    std::vector<Triangle> triangles;                     ///< outward, in the order of the faces
    std::map<std::string, std::vector<double>> scalars;  ///< by field, each #T
    std::map<std::string, std::vector<Vec3>> vectors;    ///< by field, each #T
};

/// Reads a patch at one time of a case with VTK's OpenFOAM reader, which holds single precision.
/// \param folder of the case, with system/controlDict
/// \param time name of its time folder as a number
/// \throw IoError if there is no case; InvalidInput if VTK cannot read it, if it has no such patch
/// or time, or if a field is not of this mesh
[[nodiscard]] FoamPatchFields read_foam_patch(const std::filesystem::path& folder,
                                              const std::string& patch, double time);

}  // namespace vesselbench
