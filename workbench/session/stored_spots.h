#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "geometry/kernel/vec3.h"

namespace vesselbench {

/// A place that a user inspects again and again, such as an artifact.
struct Spot {
    std::string name;
    Vec3 point = Vec3::Zero();           ///< [mm]
    Vec3 normal = Vec3(0.0, -1.0, 0.0);  ///< outward, unit

    bool operator==(const Spot&) const = default;
};

/// Keeps spots in a project file, which a session of this process may have open. They replace those
/// kept before; they are of the project, not of a state: undo does not change them.
/// \throw IoError if the project cannot be written
void store_spots(const std::filesystem::path& project, const std::vector<Spot>& spots);

/// The spots in a project file; none if it has none.
/// \throw IoError, InvalidInput if they cannot be read
[[nodiscard]] std::vector<Spot> stored_spots(const std::filesystem::path& project);

}  // namespace vesselbench
