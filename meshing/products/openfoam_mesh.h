#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "geometry/kernel/progress.h"
#include "meshing/tetrahedra/quality.h"
#include "meshing/tetrahedra/volume_mesh.h"

namespace vesselbench {

/// A patch as listed in polyMesh/boundary.
struct FoamPatch {
    std::string name;
    PatchKind kind = PatchKind::Wall;
    std::size_t first_face = 0;
    std::size_t faces = 0;
    std::size_t index = 0;  ///< in VolumeMesh::patches
};

/// The name of a patch in the case: OpenFOAM reads a word that begins with a digit, '-' or '.' as a
/// number.
[[nodiscard]] std::string foam_word(const std::string& name);

/// The header of every OpenFOAM file.
[[nodiscard]] std::string foam_header(const std::string& kind, const std::string& location,
                                      const std::string& object, const std::string& note = {});

/// The patches with faces, in the order of the faces. \param faces of `mesh_faces`
[[nodiscard]] std::vector<FoamPatch> foam_patches(const VolumeMesh& mesh,
                                                  const std::vector<MeshFace>& faces);

/// Writes points [m], faces, owner, neighbour and boundary into an existing folder, in OpenFOAM's
/// upper triangular order.
/// \param faces of `mesh_faces`
/// \throw IoError if a file cannot be written, Cancelled
void write_poly_mesh(const std::filesystem::path& folder, const VolumeMesh& mesh,
                     const std::vector<MeshFace>& faces, const Progress& progress = {});

}  // namespace vesselbench
